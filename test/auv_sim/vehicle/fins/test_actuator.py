"""The rudder's servo."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following import vehicle
from auv_sim.vehicle.fins.actuator import (
    FlawedServoState,
    RudderFlaws,
    Servo,
    ServoState,
    flawed_servo_of,
    servo_of,
    servo_step,
    with_rate,
)

LIMIT, RATE = math.radians(35.0), math.radians(15.0)


class Driven:
    """A servo of one rudder: configuration, state and the last deflection."""

    def __init__(self, **flaws: float) -> None:
        limits = vehicle.Rudder(max_angle_deg=35.0, max_rate_deg_s=15.0)
        self.config = flawed_servo_of(limits, RudderFlaws(**flaws), 0.05) if flaws else servo_of(limits)
        self.state = FlawedServoState() if flaws else ServoState()
        self.fins = (0.0, 0.0, 0.0)

    def command(self, angle: float, seconds: float) -> None:
        self.state, self.fins = servo_step(self.config, self.state, (angle, True), seconds)

    def hold(self, angle: float, seconds: float) -> None:
        self.state, self.fins = servo_step(self.config, self.state, (angle, False), seconds)

    @property
    def angle(self) -> float:
        return self.state.angle


def test_it_turns_at_its_rate_and_stops_at_the_target():
    rudder = Driven()
    rudder.command(0.3, 1.0)
    assert rudder.angle == pytest.approx(RATE)
    rudder.hold(0.3, 10.0)
    assert rudder.angle == pytest.approx(0.3)
    rudder.command(-0.1, 0.5)
    assert rudder.angle == pytest.approx(0.3 - 0.5 * RATE)


@pytest.mark.parametrize(("asked", "stop"), [(2.0, LIMIT), (-2.0, -LIMIT), (math.inf, LIMIT)])
def test_it_does_not_go_past_the_stops(asked, stop):
    rudder = Driven()
    rudder.command(asked, 100.0)
    assert rudder.angle == stop


@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.lists(st.floats(0.0, 1.0), max_size=10))
def test_many_small_steps_are_one_large_step(first, second, steps):
    small, large = Driven(), Driven()
    for rudder in (small, large):
        rudder.command(first, 0.7)
    for seconds in steps:
        before = small.angle
        small.command(second, seconds)
        assert abs(small.angle - before) <= RATE * seconds + 1e-12
    large.command(second, sum(steps))
    assert small.angle == pytest.approx(large.angle, abs=1e-12)


def test_the_deflection_has_the_beginning_the_middle_and_the_end_of_a_step():
    rudder = Driven()
    rudder.command(0.3, 0.5)
    rudder.command(0.3, 0.5)
    assert rudder.fins == pytest.approx((0.5 * RATE, 0.75 * RATE, RATE))


def test_without_flaws_rudder_and_servo_are_one():
    ideal, flawless = Driven(), Driven(dead_time=0.0)
    for angle in (0.1, 0.1, -0.02, 0.0, 0.4):
        for rudder in (ideal, flawless):
            rudder.command(angle, 0.1)
        assert ideal.fins == flawless.fins
        assert ideal.angle == ideal.fins[2] == flawless.angle


def test_a_share_of_the_rate_is_all_that_changes():
    remus = vehicle.load("remus100")
    slow = servo_of(with_rate(remus, 0.5).rudder)
    assert slow == pytest.approx(Servo(remus.rudder.max_angle, 0.5 * remus.rudder.max_rate))


def test_in_its_dead_band_a_servo_at_rest_stays():
    rudder = Driven(dead_band_deg=2.0)
    rudder.command(math.radians(1.9), 1.0)
    assert rudder.angle == 0.0
    rudder.command(math.radians(2.1), 1.0)
    assert rudder.angle == pytest.approx(math.radians(2.1))  # once it runs it runs to its target
    rudder.command(math.radians(1.0), 1.0)
    assert rudder.angle == pytest.approx(math.radians(2.1))


def test_a_servo_that_runs_takes_every_new_target():
    rudder = Driven(dead_band_deg=2.0)
    rudder.command(0.3, 0.1)
    rudder.command(rudder.angle + math.radians(0.5), 1.0)
    assert math.degrees(rudder.angle) == pytest.approx(2.0)


def test_play_is_lost_at_every_reversal():
    rudder = Driven(backlash_deg=2.0)
    play = math.radians(1.0)
    rudder.command(0.2, 0.5)
    assert rudder.fins[2] == pytest.approx(0.5 * RATE - play)
    rudder.command(0.2, 10.0)
    assert (rudder.angle, rudder.fins[2]) == pytest.approx((0.2, 0.2 - play))
    rudder.command(0.2 - 1.5 * play, 10.0)
    assert rudder.fins[2] == pytest.approx(0.2 - play)  # still within the play
    rudder.command(0.0, 10.0)
    assert rudder.fins[2] == pytest.approx(play)


def test_a_command_comes_after_its_dead_time():
    rudder = Driven(dead_time=0.1)
    rudder.command(0.1, 0.05)
    rudder.command(-0.1, 0.05)
    assert rudder.angle == 0.0
    rudder.hold(-0.1, 0.05)
    assert rudder.angle == pytest.approx(0.05 * RATE)
    rudder.hold(-0.1, 0.05)
    assert rudder.angle == pytest.approx(0.0)


def test_commands_faster_than_the_ring_was_made_for_are_an_error():
    rudder = Driven(dead_time=0.1)
    with pytest.raises(IndexError, match="more commands within their dead time"):
        for _ in range(10):
            rudder.command(0.1, 0.001)


@given(
    st.lists(st.floats(-1.0, 1.0), max_size=40),
    st.floats(0.0, 5.0),
    st.floats(0.0, 5.0),
    st.floats(0.0, 0.5),
)
def test_flaws_never_break_the_limits(commands, band, backlash, dead_time):
    rudder = Driven(dead_band_deg=band, backlash_deg=backlash, dead_time=dead_time)
    for angle in commands:
        before = rudder.fins[2]
        rudder.command(angle, 0.05)
        assert rudder.fins[0] == before
        assert abs(rudder.fins[2] - before) <= RATE * 0.05 + 1e-12
        assert abs(rudder.angle) <= LIMIT
        assert abs(rudder.fins[2] - rudder.angle) <= math.radians(0.5 * backlash) + 1e-12
