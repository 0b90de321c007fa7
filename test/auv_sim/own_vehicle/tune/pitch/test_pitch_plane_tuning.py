"""Tuning of the stern planes: its gains, its flights, and the figures that the objective sees."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_path_following import config_files
from auv_path_following.control.rule.gain_rule import gains_for
from auv_sim.flight.batch.scenarios import Courses
from auv_sim.own_vehicle.tune import tuned_file
from auv_sim.own_vehicle.tune.gain_space import VARIABLES, GainSpace
from auv_sim.own_vehicle.tune.pitch.pitch_plane_tuning import (
    PITCH,
    PitchSpace,
    can_be_tuned,
    draw_dives,
    room_of,
    seen_from_the_side,
)
from auv_sim.own_vehicle.tune.trial_flights import Amount, Conditions
from auv_sim.own_vehicle.tune.tuning_problem import Problem, margins_of
from auv_sim.sim_parameters import SUITE
from hulls import DIVER, REMUS

BASE = params_file.load(config_files.find("params", "robust"), SUITE)
CONDITIONS = Conditions(0.05, 0.05, (0.1, 0.05), None)
HEADING = GainSpace(DIVER, BASE[topics.GUIDANCE].guidance, 0.05, 0.05).rule()
SPACE = PitchSpace(DIVER, HEADING, 0.05, 0.05)
FEW = Amount(starts=1, courses=2, legs=4, at_sea=0)


def test_the_first_point_is_the_rule_and_the_heading_stays() -> None:
    ruled = gains_for(DIVER, 0.05, 0.05).pitch
    assert ruled is not None
    for gains in (SPACE.rule(), SPACE.gains(SPACE.first)):
        assert gains.pitch.nism.k5 == pytest.approx(ruled.autopilot.nism.k5)
        assert gains.pitch.reference.bandwidth == pytest.approx(ruled.autopilot.reference.bandwidth)
        assert gains.guidance.vertical.lookahead == pytest.approx(ruled.lookahead)
        assert gains.autopilot == HEADING.autopilot
        assert gains.guidance.ailos == HEADING.guidance.ailos
        assert gains.guidance.switching == HEADING.guidance.switching


def test_gains_lead_back_to_their_point() -> None:
    point = SPACE.first + np.array([0.3, -0.2, 0.1, 0.2, 0.1, -0.3, 0.2, 0.0, 0.0])
    gains = SPACE.gains(point)
    assert gains.pitch.nism.k5 > 1.2 * SPACE.rule().pitch.nism.k5
    assert len(point) == len(VARIABLES)
    assert SPACE.point_of(gains) == pytest.approx(point, abs=1e-3)
    present = tuned_file.flown_of(BASE)
    assert SPACE.with_planes_of(present).pitch == present.pitch
    assert SPACE.with_planes_of(present).autopilot == HEADING.autopilot


def test_dives_stay_within_the_range_of_depth() -> None:
    shallow = dataclasses.replace(DIVER, depth=dataclasses.replace(DIVER.depth, max=12.0))
    for hull in (DIVER, shallow):
        (top, bottom), first = room_of(hull), draw_dives(hull, CONDITIONS, FEW, np.random.default_rng(3))
        again = draw_dives(hull, CONDITIONS, FEW, np.random.default_rng(4))
        assert [flight.is_line for flight in first] == [True] * 2 + [False] * 6
        for flight, other in zip(first, again, strict=True):
            assert flight.scenario.spatial is not None
            depths = [knot.depth for knot in flight.scenario.spatial.knots]
            assert top - 1e-9 <= min(depths) <= max(depths) <= bottom + 1e-9
            assert top - 1e-9 <= flight.scenario.initial.z <= bottom + 1e-9
            assert flight.scenario.initial != other.scenario.initial
        assert max(len(flight.scenario.spatial.knots) for flight in first) >= 8
    assert can_be_tuned(shallow)
    assert not can_be_tuned(dataclasses.replace(DIVER, depth=dataclasses.replace(DIVER.depth, max=5.0)))
    assert not can_be_tuned(REMUS)
    slow = dataclasses.replace(DIVER.depth, minimum_speed=3.0)
    assert not can_be_tuned(dataclasses.replace(DIVER, depth=slow))


def test_a_limit_cycle_in_pitch_is_seen_and_the_rule_has_none() -> None:
    """Planes that are far too quick for their delay: pitch swings, and the linear loop has no margins."""
    problem = Problem(SPACE, [DIVER], CONDITIONS, 1, plane=PITCH)
    wild = SPACE.gains(SPACE.first + np.log([5.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]))
    level = Amount(starts=1, courses=0, legs=3, at_sea=0)
    (ruled, cycling), is_line, _ = problem.fly(DIVER, level, (0,), [SPACE.rule(), wild], 1, Courses())
    assert is_line.all()
    assert np.max(ruled.late_rms_yaw_rate) < 0.1
    assert np.max(cycling.late_rms_yaw_rate) > 0.3
    assert margins_of(problem, SPACE.rule(), DIVER).is_stable
    assert not margins_of(problem, wild, DIVER).is_stable
    assert (ruled.rms_distance == ruled.rms_depth_error).all()  # type: ignore[attr-defined]
    assert (ruled.rudder_travel_per_metre == ruled.sternplane_travel_per_metre).all()  # type: ignore[attr-defined]
    assert seen_from_the_side(ruled).rms_distance.tolist() == ruled.rms_distance.tolist()
