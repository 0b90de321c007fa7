"""The rudder's servo."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_sim.plant.actuator import RudderServo

LIMIT, RATE = math.radians(35.0), math.radians(15.0)


def servo():
    return RudderServo(LIMIT, RATE)


def test_it_turns_at_its_rate_and_stops_at_the_target():
    rudder = servo()
    rudder.command(0.3)
    rudder.advance(1.0)
    assert rudder.angle == pytest.approx(RATE)
    rudder.advance(10.0)
    assert rudder.angle == pytest.approx(0.3)
    rudder.command(-0.1)
    rudder.advance(0.5)
    assert rudder.angle == pytest.approx(0.3 - 0.5 * RATE)


@pytest.mark.parametrize(("asked", "stop"), [(2.0, LIMIT), (-2.0, -LIMIT), (math.inf, LIMIT)])
def test_it_does_not_go_past_the_stops(asked, stop):
    rudder = servo()
    rudder.command(asked)
    rudder.advance(100.0)
    assert rudder.angle == stop


@settings(deadline=None)
@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.lists(st.floats(0.0, 1.0), max_size=10))
def test_many_small_steps_are_one_large_step(first, second, steps):
    small, large = servo(), servo()
    for rudder in (small, large):
        rudder.command(first)
        rudder.advance(0.7)
        rudder.command(second)
    for seconds in steps:
        before = small.angle
        small.advance(seconds)
        assert abs(small.angle - before) <= RATE * seconds + 1e-12
    large.advance(sum(steps))
    assert small.angle == pytest.approx(large.angle, abs=1e-12)


def test_looking_ahead_changes_nothing():
    rudder = servo()
    rudder.command(0.3)
    assert rudder.after(0.5) == pytest.approx(0.5 * RATE)
    assert rudder.after(0.5) == pytest.approx(0.5 * RATE)
    assert rudder.angle == 0.0
