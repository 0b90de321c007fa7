"""The study of hulls that are known by little: its hulls, what is known of them, and its targets."""

from __future__ import annotations

import dataclasses
import math

import pytest

from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.control.rule.fin_response import response_of
from auv_sim.studies.gains.new_hulls import LENGTHS, SPEEDS, assumed, known_by_little, new_hulls
from auv_sim.studies.gains.new_study import TARGETS, Known, _as_if_known, _true, known, main


def test_the_hulls_are_the_same_every_time_and_of_many_sizes() -> None:
    hulls = new_hulls(12)
    assert hulls == new_hulls(12)
    assert list(new_hulls(2, first=10)) == ["drawn 10", "drawn 11"]
    drawn = [hull for name, hull in hulls.items() if name.startswith("drawn")]
    assert min(hull.length for hull in drawn) < 2.0 < 4.0 < max(hull.length for hull in drawn)
    assert all(LENGTHS[0] <= hull.length <= LENGTHS[1] for hull in drawn)
    assert all(hull.top_speed <= SPEEDS[1] + 1e-9 for hull in drawn)
    divergences = [response_of(hull).divergence for hull in drawn]
    assert min(divergences) < 0.0 < max(divergences)


def test_only_length_speed_rudder_and_radius_are_known() -> None:
    hull = new_hulls(3)["drawn 2"]
    facts = known_by_little(hull)
    assert (facts.mass, facts.diameter, facts.rate_deg_s, facts.effect, facts.divergence) == (None,) * 5
    own = assumed(hull)
    assert own.top_speed == pytest.approx(hull.top_speed, rel=1e-3)
    assert own.rudder.max_rate_deg_s == 15.0
    assert tightest_turn(own).radius == pytest.approx(tightest_turn(hull).radius, rel=1e-3)
    assert response_of(own).effect != pytest.approx(response_of(hull).effect, rel=1e-3)


def test_a_hull_that_new_refuses_meets_no_target() -> None:
    hull = new_hulls(0)["remus100"]
    found = known("odd", dataclasses.replace(hull, length=100.5), 1)
    assert "--length" in found.refused
    assert not any(has(found) for has in TARGETS.values())
    good = Known("a", 1.6, 2.0, 1.8, 1.2, 1.0, 0.96, 0.44, 1.2, 0.29)
    assert all(has(good) for has in TARGETS.values())
    for bad in (good._replace(within=0.94), good._replace(rms=0.46), good._replace(yaw_rate=math.inf)):
        assert sum(has(bad) for has in TARGETS.values()) == 2


def test_gains_are_for_the_assumed_hull_without_its_allowance_or_for_the_true_one(capsys) -> None:
    hull = new_hulls(3)["drawn 2"]
    own = assumed(hull)
    assert own.assumed_within > 1.0
    assert _as_if_known(hull) == dataclasses.replace(own, assumed_within=1.0)
    assert response_of(_true(hull)) == response_of(hull)
    assert _true(hull).rudder.dead_time == own.rudder.dead_time > hull.rudder.dead_time
    with pytest.raises(SystemExit):
        main(["--no-allowance", "--true-hull"])
    assert "not allowed with" in capsys.readouterr().err
