"""The mapping between the wire contract and MAVLink, in numbers; docs/mavlink.md has it as a table. ROS-free.

MAVLink's local frame is NED and its body frame FRD, as in the suite's calculations: no frame is converted
here. `auv_msgs_py.contract.conversions` converts for the wire.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import Command, SpatialCommand
from auv_path_following.vehicle import Vehicle

#: MANUAL_CONTROL's axes go from -FULL to FULL.
FULL = 1000
#: Bit of `enabled_extensions` that makes the axis s valid.
PITCH_ENABLED = 1
#: Servo pulses: neutral, and its distance to either stop, microseconds.
NEUTRAL_PULSE, PULSE_RANGE = 1500, 400
#: Component of the vehicle that sends the velocity of its water-track log.
WATER_LOG = mavlink.MAV_COMP_ID_USER1


class CommandLimits(NamedTuple):
    """Rudder (rad), thrust (N) and stern planes (rad; None without) at full deflection of an axis."""

    rudder: float
    thrust: float
    sternplanes: float | None = None

    @classmethod
    def of(cls, vehicle: Vehicle) -> CommandLimits:
        """Return the limits of a vehicle."""
        planes = vehicle.sternplanes
        return cls(vehicle.rudder.max_angle, vehicle.thrust_max, None if planes is None else planes.max_angle)


def heartbeat() -> Any:
    """Return the HEARTBEAT of an onboard computer."""
    kind, autopilot = mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID
    return mavlink.MAVLink_heartbeat_message(kind, autopilot, 0, 0, mavlink.MAV_STATE_ACTIVE, 3)


def manual_control(
    command: Command | SpatialCommand,
    limits: CommandLimits,
    clockwise: bool,
    target: int,
    bow_down: bool = True,
) -> Any:
    """Return MANUAL_CONTROL: x is thrust ahead, r the rudder, s the stern planes; the rest stays neutral.

    Args:
        command: rudder positive to port, stern planes positive bow down, and thrust.
        limits: at full deflection. Without stern planes s is not enabled.
        clockwise: whether a positive r turns the bow to starboard, as autopilots and ground stations do; the
            specification's text says counter-clockwise.
        target: the vehicle's system id.
        bow_down: whether a positive s puts the bow down, as the specification says.
    """
    x = _axis(command.thrust / limits.thrust)
    r = _axis(command.rudder / limits.rudder)
    r = -r if clockwise else r
    if limits.sternplanes is None:
        return mavlink.MAVLink_manual_control_message(target, x, 0, 0, r, 0)
    assert isinstance(command, SpatialCommand)
    s = _axis(command.sternplanes / limits.sternplanes)
    return mavlink.MAVLink_manual_control_message(
        target, x, 0, 0, r, 0, enabled_extensions=PITCH_ENABLED, s=s if bow_down else -s
    )


def command_of(
    message: Any, limits: CommandLimits, clockwise: bool, bow_down: bool = True
) -> Command | SpatialCommand:
    """Return the command of a MANUAL_CONTROL message, as a vehicle interprets it; s counts if enabled."""
    rudder, thrust = limits.rudder * message.r / FULL, limits.thrust * message.x / FULL
    rudder = -rudder if clockwise else rudder
    if limits.sternplanes is None:
        return Command(rudder, thrust)
    planes = limits.sternplanes * message.s / FULL if message.enabled_extensions & PITCH_ENABLED else 0.0
    return SpatialCommand(rudder, planes if bow_down else -planes, thrust)


def _axis(share: float) -> int:
    return round(FULL * min(max(share, -1.0), 1.0))


def pulse_of(angle: float, largest: float) -> int:
    """Return the servo pulse of a fin, us.

    Args:
        angle: rad; a rudder's is positive to port, that of stern planes bow down. Longer pulses turn the
            other way, to starboard and bow up: positive about the axes of FRD.
        largest: angle at either end of the pulse range, rad.
    """
    return NEUTRAL_PULSE - round(PULSE_RANGE * angle / largest)


def angle_of_pulse(pulse: int, largest: float) -> float:
    """Return the angle of a fin, rad, of its servo pulse: the inverse of `pulse_of`."""
    return largest * (NEUTRAL_PULSE - pulse) / PULSE_RANGE


#: A covariance that is not known, as ROS messages have it.
NO_COVARIANCE: tuple[float, ...] = (0.0,) * 36


def covariance_of(triangle: Sequence[float]) -> tuple[float, ...]:
    """Return the 6 x 6 covariance, row-major, of the upper triangle of an ODOMETRY, in the message's frame.

    Elements that are not known (NaN) are 0; NaN first, a number that is not finite, or a negative variance
    makes the whole unknown: all zeros.
    """
    if math.isnan(triangle[0]) or any(math.isinf(value) for value in triangle):
        return NO_COVARIANCE
    found, known = [0.0] * 36, iter(triangle)
    for i in range(6):
        for j in range(i, 6):
            value = next(known)
            found[6 * i + j] = found[6 * j + i] = 0.0 if math.isnan(value) else float(value)
    return tuple(found) if min(found[::7]) >= 0.0 else NO_COVARIANCE


def water_track(boot_us: int, ur: float, vr: float, wr: float = 0.0) -> Any:
    """Return ODOMETRY with the velocity through the water alone, in the body frame (FRD), m/s."""
    unknown = float("nan")
    covariance = [unknown] + [0.0] * 20
    return mavlink.MAVLink_odometry_message(
        boot_us, mavlink.MAV_FRAME_LOCAL_FRD, mavlink.MAV_FRAME_BODY_FRD, unknown, unknown, unknown,
        [1.0, 0.0, 0.0, 0.0], ur, vr, wr, unknown, unknown, unknown, covariance, covariance,
    )  # fmt: skip
