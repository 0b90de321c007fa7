"""The rudder's servo."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_sim.plant.actuator import RudderFlaws, RudderServo

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


def flawed(**flaws):
    return RudderServo(LIMIT, RATE, RudderFlaws(**flaws))


def test_without_flaws_rudder_and_servo_are_one():
    rudder = flawed()
    rudder.command(0.1)
    rudder.advance(0.2)
    assert rudder.fin == rudder.angle == servo_after(0.1, 0.2)
    assert rudder.fin_after(0.3) == rudder.after(0.3)


def servo_after(target, seconds):
    rudder = servo()
    rudder.command(target)
    return rudder.after(seconds)


def test_in_its_dead_band_a_servo_at_rest_stays():
    rudder = flawed(dead_band_deg=2.0)
    rudder.command(math.radians(1.9))
    rudder.advance(1.0)
    assert rudder.angle == 0.0
    rudder.command(math.radians(2.1))
    rudder.advance(1.0)
    assert rudder.angle == pytest.approx(math.radians(2.1))  # once it runs it runs to its target
    rudder.command(math.radians(1.0))
    rudder.advance(1.0)
    assert rudder.angle == pytest.approx(math.radians(2.1))


def test_a_servo_that_runs_takes_every_new_target():
    rudder = flawed(dead_band_deg=2.0)
    rudder.command(0.3)
    rudder.advance(0.1)
    rudder.command(rudder.angle + math.radians(0.5))
    rudder.advance(1.0)
    assert math.degrees(rudder.angle) == pytest.approx(2.0)


def test_play_is_lost_at_every_reversal():
    rudder = flawed(backlash_deg=2.0)
    play = math.radians(1.0)
    rudder.command(0.2)
    assert rudder.fin_after(0.5) == pytest.approx(0.5 * RATE - play)
    rudder.advance(10.0)
    assert (rudder.angle, rudder.fin) == pytest.approx((0.2, 0.2 - play))
    rudder.command(0.2 - 1.5 * play)
    rudder.advance(10.0)
    assert rudder.fin == pytest.approx(0.2 - play)  # still within the play
    rudder.command(0.0)
    rudder.advance(10.0)
    assert rudder.fin == pytest.approx(play)


def test_a_command_comes_after_its_dead_time():
    rudder = flawed(dead_time=0.1)
    rudder.command(0.1)
    rudder.advance(0.05)
    rudder.command(-0.1)
    rudder.advance(0.05)
    assert rudder.angle == 0.0
    rudder.advance(0.05)
    assert rudder.angle == pytest.approx(0.05 * RATE)
    rudder.advance(0.05)
    assert rudder.angle == pytest.approx(0.0)


@settings(deadline=None)
@given(
    st.lists(st.floats(-1.0, 1.0), max_size=40),
    st.floats(0.0, 5.0),
    st.floats(0.0, 5.0),
    st.floats(0.0, 0.5),
)
def test_flaws_never_break_the_limits(commands, band, backlash, dead_time):
    rudder = flawed(dead_band_deg=band, backlash_deg=backlash, dead_time=dead_time)
    for angle in commands:
        before = rudder.fin
        rudder.command(angle)
        rudder.advance(0.05)
        assert abs(rudder.fin - before) <= RATE * 0.05 + 1e-12
        assert abs(rudder.angle) <= LIMIT
        assert abs(rudder.fin - rudder.angle) <= math.radians(0.5 * backlash) + 1e-12
