"""Where a vehicle goes on after it had to hold."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.path_follower import PathFollower
from auv_path_following.guidance.rejoin import closest_ahead
from auv_path_following.missions import mission_file

NORTH_THEN_EAST = CompositePath([Line(0.0, 0.0, 100.0, 0.0), Line(100.0, 0.0, 100.0, math.pi / 2)])
PAPER = mission_file.load("paper_composite").path
WATER = WaterVelocity(1.9, 0.0)


@pytest.mark.parametrize("east", [-8.0, 0.0, 5.0])
def test_on_a_line_it_is_the_foot_of_the_perpendicular(east):
    i, t = closest_ahead(NORTH_THEN_EAST.rows, 0, 0.2, 43.21, east, 50.0)
    assert (i, t) == (0, pytest.approx(0.4321, abs=1e-5))


def test_it_goes_on_to_the_next_subpath():
    i, t = closest_ahead(NORTH_THEN_EAST.rows, 0, 0.9, 103.0, 12.5, 50.0)
    assert (i, t) == (1, pytest.approx(0.125, abs=1e-5))


def test_it_is_never_behind_and_never_beyond_reach():
    assert closest_ahead(NORTH_THEN_EAST.rows, 0, 0.5, 10.0, 0.0, 50.0) == (0, 0.5)
    i, t = closest_ahead(NORTH_THEN_EAST.rows, 0, 0.2, 90.0, 0.0, 10.0)
    assert (i, t) == (0, pytest.approx(0.3, abs=1e-9 + 0.005))
    assert closest_ahead(NORTH_THEN_EAST.rows, 1, 0.99, 100.0, 500.0, 50.0) == (1, pytest.approx(1.0))


@settings(max_examples=100)
@given(
    st.floats(0.0, 6.99), st.floats(-30.0, 30.0), st.floats(-30.0, 30.0), st.floats(0.0, 80.0)
)  # fmt: skip
def test_anywhere_it_only_goes_ahead_and_not_too_far(s, north, east, reach):
    i, t = int(s), s - int(s)
    here = PAPER.evaluate(i, t)
    at_i, at_t = closest_ahead(PAPER.rows, i, t, here.x + north, here.y + east, reach)
    assert (at_i, at_t) >= (i, t)
    gone = PAPER.distance_to_go(i, t) - PAPER.distance_to_go(at_i, at_t)
    # A step may be longer than it was meant to be, where the path's speed grows along it: by a hundredth.
    assert gone <= reach + 0.005
    there = PAPER.evaluate(at_i, at_t)
    assert math.hypot(there.x - here.x - north, there.y - here.y - east) <= math.hypot(north, east) + 1e-9


def test_a_leg_beside_this_one_is_not_mistaken_for_it():
    """Legs 10 m apart: carried 7 m sideways the vehicle is closer to the second, yet stays on the first."""
    legs = CompositePath(
        [Line(0.0, 0.0, 60.0, 0.0), Line(60.0, 0.0, 10.0, math.pi / 2), Line(60.0, 10.0, 60.0, math.pi)]
    )
    follower = PathFollower(legs)
    follower.place_at(0, 0.5)
    follower.update(Navigation(30.0, 0.0, 0.0, 0.0), WATER, NO_CURRENT, 0.0)
    follower.rejoin(Navigation(30.0, 7.0, 0.0, 0.0))
    assert follower.state.progress.point.i == 0
    assert follower.state.progress.point.t == pytest.approx(0.5, abs=1e-3)


def test_after_a_long_hold_the_virtual_point_is_beside_the_vehicle_and_not_where_it_would_have_run():
    follower = PathFollower(NORTH_THEN_EAST)
    for k in range(100):
        follower.update(Navigation(0.2 * k, 0.0, 0.0, 0.0), WATER, NO_CURRENT, 0.1 if k else 0.0)
    before = follower.s
    there = Navigation(30.0, 4.0, 0.0, 0.0)  # carried 10 m ahead in 20 s
    follower.rejoin(there)
    output = follower.update(there, WATER, NO_CURRENT, 0.0)
    assert output.s > before
    assert output.x_p == pytest.approx(30.0, abs=1e-2)
    assert output.ye == pytest.approx(4.0)


def test_a_vehicle_that_was_carried_back_finds_the_virtual_point_where_it_left_it():
    follower = PathFollower(NORTH_THEN_EAST)
    follower.place_at(0, 0.5)
    follower.update(Navigation(50.0, 0.0, 0.0, 0.0), WATER, NO_CURRENT, 0.0)
    follower.rejoin(Navigation(20.0, 0.0, 0.0, 0.0))
    assert follower.s == 0.5
