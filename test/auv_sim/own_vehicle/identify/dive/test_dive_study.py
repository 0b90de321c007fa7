"""The study of divers: what is drawn, and its figures."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.own_vehicle.identify.study.identified_dives import DiveCase, JudgedDive
from auv_sim.own_vehicle.identify.study.random_divers import fastest_growth, known_diver, random_diver
from auv_sim.own_vehicle.verbs.study_figures import dive_figures

CASE = DiveCase(0, "eight_minutes_dive", "moderate")


def outcome(off: float, score: float) -> JudgedDive:
    shares, scores = (0.05,) * 10 + (0.5,) * 4, (score,) * 10 + (9.0,) * 4
    predicted = 0.01, 0.05, 0.01, 0.05
    return JudgedDive(CASE, 2.0, off, -off, off, off, 0.001, shares, scores, *predicted, *in_plane(score))


def in_plane(score: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Shares and scores of which the first 7 count as identified."""
    return (0.05,) * 7 + (0.5,) * 7, (score,) * 14


def test_figures_judge_medians_and_the_coverage_of_what_counts_as_identified() -> None:
    good, bad = outcome(0.01, 1.0), outcome(0.5, 3.0)
    rows = {row.name: row for row in dive_figures([good, good, bad], "eight_minutes_dive")}
    assert rows["effect of the planes"].met and rows["effect of the planes"].median == "1 %"
    assert rows["95 % intervals that hold the truth"].median == "66.7 %"
    assert not rows["95 % intervals that hold the truth"].met
    rows = {row.name: row for row in dive_figures([good, bad, bad], "eight_minutes_dive")}
    assert not rows["righting moment, pitch frequency squared"].met


def test_targets_are_those_of_the_program_not_of_its_folder() -> None:
    (effect, *_), (short, *_) = (
        dive_figures([outcome(0.01, 1.0)], f"two/{program}.yaml")
        for program in ("eight_minutes_dive", "two_minutes_dive")
    )
    assert (effect.target, short.target) == ("2 %", "4 %")


def test_the_figures_say_how_far_intervals_in_the_plane_are_to_be_trusted() -> None:
    good, bad = outcome(0.01, 1.0), outcome(0.01, 3.0)
    errors, held = dive_figures([good, good, good, bad], "two_minutes_dive")[-2:]
    assert (errors.median, errors.worst, errors.met) == ("1.73", "3.00", False)
    assert (held.median, held.worst, held.met) == ("75.0 %", "28 intervals", False)
    assert all(row.met for row in dive_figures([good], "two_minutes_dive")[-2:])


def test_drawn_divers_are_of_all_lengths_heavy_and_light_and_their_planes_hold_them() -> None:
    divers = [random_diver(seed) for seed in range(40)]
    verticals = [diver.coefficients.vertical for diver in divers]
    lengths = np.array([diver.length for diver in divers])
    light = np.array([v.B - v.W for v in verticals if v is not None])
    assert lengths.min() < 1.5 and lengths.max() > 3.5 and lengths.min() >= 1.0 and lengths.max() <= 5.0
    assert light.min() < 0.0 < light.max() and light.min() >= -3.0 and light.max() <= 6.0
    assert all(fastest_growth(diver, diver.top_speed) < 1.0 for diver in divers)
    assert random_diver(3) == divers[3]


def test_what_is_known_of_a_diver_is_its_length_and_weight_not_its_coefficients() -> None:
    true = random_diver(1)
    vertical, known = true.coefficients.vertical, known_diver(true.length).vertical
    assert vertical is not None and known is not None
    assert pytest.approx(vertical.W) == known.W
    assert known.Muud != pytest.approx(vertical.Muud, rel=0.01)
