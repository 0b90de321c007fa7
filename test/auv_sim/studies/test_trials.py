"""Figures of many flights."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_sim.flight.run_record import Run
from auv_sim.studies.trials import Trial, judge, together

PATH = CompositePath([Line(0.0, 0.0, 100.0, 0.0)])
GOOD = Trial("robust", 0, True, 0.97, 100.0, 1.0, math.nan, 0.4, 1.2, 3.0, 8.0)


def test_a_flight_has_its_figures() -> None:
    t = np.arange(0.0, 50.01, 0.1)
    rudder = np.radians(2.0) * ((np.arange(t.size) // 2) % 2)
    run = Run.from_columns(
        {
            "t": t, "x": 2.0 * t, "y": 0.0 * t, "psi": 0.0 * t, "rudder": rudder, "thrust_cmd": 6.0 + 0.0 * t,
            "s": np.minimum(t / 50.0, 1.0), "x_true": 2.0 * t, "y_true": 0.3 + 0.0 * t,
        }
    )  # fmt: skip
    trial = judge(run, PATH, "robust", 7)
    assert (trial.params, trial.seed, trial.completed) == ("robust", 7, True)
    assert trial.flown_share == 1.0
    assert trial.largest_distance == pytest.approx(0.3)
    assert trial.navigation_error == pytest.approx(0.3)
    assert math.isnan(trial.largest_at_corners)
    # Two degrees in every second step of 0.1 s and 0.2 m.
    assert trial.rudder_travel == pytest.approx(5.0, rel=0.01)
    assert trial.rudder_rate == pytest.approx(20.0 / math.sqrt(2.0), rel=0.01)


def test_only_a_flight_that_flew_the_path_to_its_end_within_the_limit_counts() -> None:
    trials = [
        GOOD,
        dataclasses.replace(GOOD, seed=1, largest_distance=2.0),
        dataclasses.replace(GOOD, seed=2, largest_distance=2.6),
        dataclasses.replace(GOOD, seed=3, completed=False),
        dataclasses.replace(GOOD, seed=4, flown_share=0.94),
        dataclasses.replace(GOOD, params="rough"),
    ]
    robust, rough = together(trials, 2.5, 0.95)
    assert (robust.params, robust.flights, robust.completed, robust.within) == ("robust", 5, 4, 2)
    assert (robust.median["largest_distance"], robust.worst["largest_distance"]) == (1.0, 2.6)
    assert (rough.flights, rough.within) == (1, 1)
    assert (robust.flown_share, rough.flown_share) == (0.94, 0.97)


def test_depth_is_judged_after_joining_and_away_from_corners() -> None:
    path = CompositePath([Line(0.0, 0.0, 200.0, 0.0), Line(200.0, 0.0, 200.0, math.pi / 2.0)])
    t = np.arange(0.0, 200.0, 0.1)
    x, y = np.minimum(2.0 * t, 200.0), np.maximum(2.0 * t - 200.0, 0.0)
    off = np.full(t.size, 0.2)
    off[t < 29.0] = 3.0  # still joining
    off[np.abs(t - 100.0) < 14.0] = -2.0  # within 30 m of the corner
    off[1500] = -0.4
    columns = {
        "t": t, "x": x, "y": y, "psi": 0.0 * t, "thrust_cmd": 6.0 + 0.0 * t, "x_true": x,
        "s": np.minimum(t / 99.5, 2.0),
        "y_true": y, "z": 10.0 + 0.0 * t, "depth_d": 10.0 + 0.0 * t, "z_true": 10.0 + off, "rudder": 0.0 * t,
        "sternplanes": np.radians(2.0) * ((np.arange(t.size) // 2) % 2),
    }  # fmt: skip
    trial = judge(Run.from_columns(columns), path, "robust", 7)
    assert trial.largest_depth_error == pytest.approx(0.4)
    assert trial.planes_travel == pytest.approx(5.0, rel=0.01)
    kept = [together([trial], 2.5, 0.9, limit)[0].within for limit in (0.39, 0.41)]
    assert kept == [0, 1]


def test_a_vehicle_in_the_plane_has_no_depth_to_judge() -> None:
    assert math.isnan(GOOD.largest_depth_error)
    assert together([GOOD], 2.5, 0.9, 1e-9)[0].within == 1


def test_a_flight_that_never_came_to_a_corner_does_not_hide_the_others() -> None:
    trials = [
        dataclasses.replace(GOOD, seed=0, largest_at_corners=1.0),
        dataclasses.replace(GOOD, seed=1, largest_at_corners=3.0),
        dataclasses.replace(GOOD, seed=2, completed=False),
    ]
    (row,) = together(trials, 2.5, 0.95)
    assert (row.median["largest_at_corners"], row.worst["largest_at_corners"]) == (2.0, 3.0)
    (row,) = together([GOOD], 2.5, 0.95)
    assert math.isnan(row.median["largest_at_corners"]) and math.isnan(row.worst["largest_at_corners"])
