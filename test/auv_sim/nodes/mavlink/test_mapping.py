"""The mapping, against numbers worked out by hand from MAVLink's own definitions."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import STOP, Command
from auv_sim.nodes.mavlink.mapping import (
    CommandLimits,
    command_of,
    manual_control,
    pulse_of_rudder,
    rudder_of_pulse,
    water_track,
)

LIMITS = CommandLimits(math.radians(35.0), 6.48)


def test_a_rudder_to_port_is_a_counter_clockwise_axis() -> None:
    """Autopilots take a positive r for a turn to starboard, as a ground station's stick has it."""
    message = manual_control(Command(math.radians(35.0), 6.48), LIMITS, clockwise=True, target=7)
    assert (message.target, message.x, message.y, message.z, message.r) == (7, 1000, 0, 0, -1000)
    message = manual_control(Command(math.radians(-17.5), 3.24), LIMITS, clockwise=True, target=1)
    assert (message.x, message.r) == (500, 500)


def test_the_specification_has_the_other_sign() -> None:
    assert manual_control(Command(math.radians(35.0), 0.0), LIMITS, clockwise=False, target=1).r == 1000


def test_a_stop_is_neutral() -> None:
    message = manual_control(STOP, LIMITS, clockwise=True, target=1)
    assert (message.x, message.y, message.z, message.r, message.buttons) == (0, 0, 0, 0, 0)


def test_a_servo_is_neutral_at_1500_and_longer_to_starboard() -> None:
    assert pulse_of_rudder(0.0, LIMITS) == 1500
    assert pulse_of_rudder(math.radians(-35.0), LIMITS) == 1900
    assert rudder_of_pulse(1100, LIMITS) == pytest.approx(math.radians(35.0))


def test_the_water_track_speaks_of_nothing_else() -> None:
    message = water_track(5_000_000, 1.5, -0.1)
    assert (message.vx, message.vy) == (1.5, -0.1)
    assert math.isnan(message.x)
    assert math.isnan(message.yawspeed)
    assert math.isnan(message.velocity_covariance[0])
    assert len(message.pose_covariance) == 21


@given(
    st.floats(-LIMITS.rudder, LIMITS.rudder), st.floats(0.0, LIMITS.thrust), st.booleans()
)  # fmt: skip
def test_what_arrives_is_what_was_sent_but_for_the_steps_of_an_axis(
    rudder: float, thrust: float, clockwise: bool
) -> None:
    arrived = command_of(manual_control(Command(rudder, thrust), LIMITS, clockwise, 1), LIMITS, clockwise)
    assert arrived.rudder == pytest.approx(rudder, abs=0.5e-3 * LIMITS.rudder)
    assert arrived.thrust == pytest.approx(thrust, abs=0.5e-3 * LIMITS.thrust)
