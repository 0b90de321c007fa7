"""The variables of the search: the rule is their origin, bounds hold everywhere."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.settings.schema import flattened
from auv_path_following import vehicle
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_sim.own_vehicle.tune.gain_space import LAWS, VARIABLES, GainSpace, bounds, ratios_at
from auv_sim.own_vehicle.tune.sampled_loop import loop_of, spectral_radius, yaw_plane
from hulls import REMUS, STABLE

SPACES = [GainSpace(hull, PathFollowerConfig(), 0.05, 0.05) for hull in (REMUS, STABLE)]


@pytest.mark.parametrize(
    "space", [*SPACES, GainSpace(vehicle.load("mss_remus100"), PathFollowerConfig(), 0, 0.1)]
)
def test_the_first_point_is_the_rule(space: GainSpace) -> None:
    rule, first = space.rule(), space.gains(space.first)
    for found, wanted in (
        (first.guidance.ailos, rule.guidance.ailos),
        (first.guidance.switching, rule.guidance.switching),
        (first.autopilot.nism, rule.autopilot.nism),
        (first.autopilot.reference, rule.autopilot.reference),
    ):
        assert flattened(found) == pytest.approx(flattened(wanted))
    assert (first.guidance.law, first.autopilot.controller) == ("ailos", "nism")
    assert first.pitch == rule.pitch


@pytest.mark.parametrize("space", SPACES)
def test_gains_lead_back_to_their_point(space: GainSpace) -> None:
    """But for the corners, whose factors are not searched for."""
    point = space.first + np.array([0.3, -0.2, 0.1, 0.2, 0.1, -0.3, 0.2, 0.0, 0.0])
    assert space.point_of(space.gains(point)) == pytest.approx(np.clip(point, *bounds()), abs=1e-3)


@settings(max_examples=40)
@given(
    st.lists(st.floats(-6.0, 6.0), min_size=len(VARIABLES), max_size=len(VARIABLES)), st.sampled_from(SPACES)
)
def test_no_point_leaves_the_bounds(away, space: GainSpace) -> None:
    hull, point = space.vehicle, space.first + np.array(away)
    reference = space.gains(point).autopilot.reference
    assert reference.max_acceleration <= 0.8 * space.response.effect * hull.rudder.max_angle * (1 + 1e-9)
    assert reference.max_rate <= 1.3 * hull.top_speed / tightest_turn(hull).radius * (1 + 1e-9)
    assert reference.max_jerk == space.ruled.heading.autopilot.reference.max_jerk
    low, high = bounds()
    for (name, ratio), least, most in zip(ratios_at(point).items(), low, high, strict=True):
        assert least - 1e-9 <= math.log(ratio) <= most + 1e-9, name


def test_each_variable_moves_what_it_is_named_after() -> None:
    """One at a time, half as much again."""
    space = SPACES[1]
    first = space.gains(space.first)
    moved = [space.gains(space.first + math.log(1.5) * row) for row in np.eye(len(VARIABLES))]
    crossing, a, c, slower, pull, _, ahead, rate, lead = moved
    nism = first.autopilot.nism
    assert crossing.autopilot.nism.k5 > 1.3 * nism.k5
    assert a.autopilot.nism.k2 == pytest.approx(1.5 * nism.k2)
    assert c.autopilot.nism.k4 == pytest.approx(1.5 * nism.k4)
    assert slower.autopilot.reference.bandwidth == pytest.approx(1.5 * first.autopilot.reference.bandwidth)
    assert pull.autopilot.reference.max_acceleration == pytest.approx(
        1.5 * first.autopilot.reference.max_acceleration
    )
    assert ahead.guidance.ailos.lookahead == pytest.approx(1.5 * first.guidance.ailos.lookahead)
    assert rate.guidance.switching.turn_rate == pytest.approx(1.5 * first.guidance.switching.turn_rate)
    assert lead.guidance.switching.lead == pytest.approx(1.5 * first.guidance.switching.lead)


@pytest.mark.parametrize("law", LAWS)
def test_every_law_has_the_same_loop_near_the_path(law: str) -> None:
    """The linear loop of PID is that of NISM; the slope of the vector field is 1/Delta."""
    own, other = SPACES[0], GainSpace(REMUS, PathFollowerConfig(), 0.05, 0.05, law)
    first, gains = own.gains(own.first), other.gains(other.first)
    assert (gains.guidance.law, gains.autopilot.controller) == LAWS[law]
    assert gains.guidance.lookahead == pytest.approx(first.guidance.lookahead)
    radii = [
        spectral_radius(yaw_plane(REMUS), loop_of(flown.autopilot, REMUS, 0.05), 0.05, 0.05, factor)
        for flown in (first, gains)
        for factor in (1.0, 3.0)
    ]
    assert radii[2:] == pytest.approx(radii[:2], abs=0.02)
