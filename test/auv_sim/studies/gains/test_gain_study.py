"""The study of gains: its hulls, and how it compares."""

from __future__ import annotations

import pytest

from auv_path_following.control.rule.fin_response import response_of
from auv_sim.studies.gains import gain_study, new_study
from auv_sim.studies.gains.gain_flights import Figures
from auv_sim.studies.gains.gain_study import compared, parser
from auv_sim.studies.gains.study_hulls import DELAYS, chosen, drawn_hull, stable_hull, study_hulls
from hulls import STABLE


def test_the_hulls_are_the_same_every_time_and_of_two_families() -> None:
    hulls = study_hulls(4)
    assert hulls == study_hulls(4)
    assert {"remus100", "mss_remus100", "stable in yaw", "drawn 3"} <= hulls.keys()
    drawn = [drawn_hull(number) for number in range(10)]
    assert all(DELAYS[0] <= hull.rudder.dead_time <= DELAYS[1] for hull in drawn)
    divergences = [response_of(hull).divergence for hull in drawn]
    assert min(divergences) < 0.0 < max(divergences)


def test_the_stable_hull_is_that_of_the_tests() -> None:
    assert stable_hull().coefficients == STABLE.coefficients


def test_millimetres_count_as_alike_and_sums_count_together() -> None:
    robust = {"a": Figures(0.1, 0.003, 1.0, True), "b": Figures(0.1, 0.1, 1.0, True)}
    tuned = {"a": Figures(0.1, 0.006, 1.5, True), "b": Figures(0.1, 0.08, 1.0, True)}
    found = compared(tuned, robust)
    assert found["worst off corners"] == 1.0
    assert found["off corners"] == pytest.approx(0.8, rel=0.01)
    assert found["travel"] == pytest.approx(1.25)
    assert compared({"b": robust["b"]}, {"b": tuned["b"]})["worst off corners"] == pytest.approx(1.25)


def test_the_command_line() -> None:
    assert parser().parse_args(["--hulls", "drawn 0", "--rule-only"]).rule_only


@pytest.mark.parametrize("study", [gain_study, new_study])
def test_an_unknown_hull_is_refused_before_any_flight(study, tmp_path, capsys) -> None:
    out = tmp_path / "found.json"
    assert study.main(["--drawn", "1", "--hulls", "remus100", "drawn 1", "--out", str(out)]) == 2
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 1
    assert "--hulls: found drawn 1, expected" in said[0]
    assert "remus100_table2" in said[0]
    assert "drawn 0" in said[0]
    assert not out.exists()
    out.write_text("of an hour")
    assert study.main(["--drawn", "1", "--hulls", "drawn 1", "--out", str(out)]) == 2
    assert "which exists, expected a new file, or --overwrite" in capsys.readouterr().err
    assert out.read_text() == "of an hour"


def test_hulls_are_chosen_by_name() -> None:
    hulls = {name: stable_hull() for name in ("a", "b", "c")}
    assert list(chosen(hulls, ["c", "a"])) == ["a", "c"]
    assert list(chosen(hulls, None)) == ["a", "b", "c"]
