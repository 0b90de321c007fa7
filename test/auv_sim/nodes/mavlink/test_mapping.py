"""The mapping, against numbers worked out by hand from MAVLink's own definitions."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import SPATIAL_STOP, STOP, Command, SpatialCommand
from auv_sim.nodes.mavlink.mapping import (
    NO_COVARIANCE,
    CommandLimits,
    angle_of_pulse,
    command_of,
    covariance_of,
    manual_control,
    pulse_of,
    water_track,
)

LIMITS = CommandLimits(math.radians(35.0), 6.48)
DIVING = CommandLimits(math.radians(35.0), 6.48, math.radians(20.0))


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
    message = manual_control(SPATIAL_STOP, DIVING, clockwise=True, target=1)
    assert (message.x, message.r, message.s, message.enabled_extensions) == (0, 0, 0, 1)


def test_stern_planes_are_the_pitch_axis_positive_bow_down() -> None:
    """The specification's table of directional control has s positive nose-down, as PX4's stick has it."""
    down, up = (SpatialCommand(0.0, math.radians(angle), 0.0) for angle in (10.0, -20.0))
    message = manual_control(down, DIVING, clockwise=True, target=1)
    assert (message.s, message.enabled_extensions & 1, message.r) == (500, 1, 0)
    assert manual_control(up, DIVING, clockwise=True, target=1).s == -1000
    assert manual_control(down, DIVING, clockwise=True, target=1, bow_down=False).s == -500


def test_a_planar_vehicle_gets_no_pitch_axis() -> None:
    message = manual_control(Command(0.1, 1.0), LIMITS, clockwise=True, target=1)
    assert (message.s, message.enabled_extensions) == (0, 0)


def test_a_pitch_axis_that_is_not_enabled_is_neutral() -> None:
    message = manual_control(SpatialCommand(0.0, 0.1, 1.0), DIVING, clockwise=True, target=1)
    message.enabled_extensions = 0
    assert command_of(message, DIVING, clockwise=True).sternplanes == 0.0  # type: ignore[union-attr]


@pytest.mark.parametrize("largest", [35.0, 20.0], ids=["rudder", "stern planes"])
def test_a_servo_is_neutral_at_1500_and_longer_to_starboard_and_bow_up(largest: float) -> None:
    limit = math.radians(largest)
    assert pulse_of(0.0, limit) == 1500
    assert pulse_of(-limit, limit) == 1900
    assert angle_of_pulse(1100, limit) == pytest.approx(limit)


def test_the_water_track_speaks_of_nothing_else() -> None:
    message = water_track(5_000_000, 1.5, -0.1)
    assert (message.vx, message.vy) == (1.5, -0.1)
    assert math.isnan(message.x)
    assert math.isnan(message.yawspeed)
    assert math.isnan(message.velocity_covariance[0])
    assert len(message.pose_covariance) == 21


@given(
    st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(0.0, 1.0),
    st.booleans(), st.booleans(), st.booleans(),
)  # fmt: skip
def test_what_arrives_is_what_was_sent_but_for_the_steps_of_an_axis(
    rudder: float, planes: float, thrust: float, dives: bool, clockwise: bool, bow_down: bool
) -> None:
    limits = DIVING if dives else LIMITS
    rudder, thrust, planes = rudder * DIVING.rudder, thrust * DIVING.thrust, planes * math.radians(20.0)
    sent = SpatialCommand(rudder, planes, thrust) if dives else Command(rudder, thrust)
    message = manual_control(sent, limits, clockwise, 1, bow_down)
    arrived = command_of(message, limits, clockwise, bow_down)
    steps = (limits.rudder, math.radians(20.0), limits.thrust) if dives else limits[:2]
    for value, expected, largest in zip(arrived, sent, steps, strict=True):
        assert value == pytest.approx(expected, abs=0.5e-3 * largest)


def test_a_covariance_is_an_upper_triangle_row_by_row() -> None:
    """PX4 fills the diagonal, places 0, 6, 11, 15, 18 and 20, and leaves NaN elsewhere."""
    triangle = [math.nan] * 21
    for place, value in zip((0, 6, 11, 15, 18, 20), (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), strict=True):
        triangle[place] = value
    found = covariance_of(triangle)
    assert found[::7] == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert sum(found) == 21.0
    triangle[1], triangle[10] = 0.5, 0.25  # x with y; y with yaw
    found = covariance_of(triangle)
    assert (found[1], found[6], found[11], found[31]) == (0.5, 0.5, 0.25, 0.25)


@pytest.mark.parametrize(("place", "value"), [(0, math.nan), (6, -1.0), (3, math.inf)])
def test_a_covariance_that_cannot_be_is_unknown(place: int, value: float) -> None:
    triangle = [1.0] * 21
    triangle[place] = value
    assert covariance_of(triangle) == NO_COVARIANCE
