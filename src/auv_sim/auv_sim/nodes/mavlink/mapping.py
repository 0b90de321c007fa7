"""The mapping between the wire contract and MAVLink, in numbers; docs/mavlink.md has it as a table. ROS-free.

MAVLink's local frame is NED and its body frame FRD, as in the suite's calculations: no frame is converted
here. `auv_msgs_py.contract.conversions` converts for the wire.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle

#: MANUAL_CONTROL's axes go from -FULL to FULL.
FULL = 1000
#: Servo pulses: neutral, and its distance to either stop, microseconds.
NEUTRAL_PULSE, PULSE_RANGE = 1500, 400
#: Component of the vehicle that sends the velocity of its water-track log.
WATER_LOG = mavlink.MAV_COMP_ID_USER1


class CommandLimits(NamedTuple):
    """Rudder (rad) and thrust (N) at full deflection of an axis."""

    rudder: float
    thrust: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> CommandLimits:
        """Return the limits of a vehicle."""
        return cls(vehicle.rudder.max_angle, vehicle.thrust_max)


def heartbeat() -> Any:
    """Return the HEARTBEAT of an onboard computer."""
    kind, autopilot = mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID
    return mavlink.MAVLink_heartbeat_message(kind, autopilot, 0, 0, mavlink.MAV_STATE_ACTIVE, 3)


def manual_control(command: Command, limits: CommandLimits, clockwise: bool, target: int) -> Any:
    """Return MANUAL_CONTROL: x is thrust ahead, r the rudder; y, z and the buttons stay at rest.

    Args:
        command: rudder positive to port, and thrust.
        limits: at full deflection.
        clockwise: whether a positive r turns the bow to starboard, as autopilots and ground stations do; the
            specification's text says counter-clockwise.
        target: the vehicle's system id.
    """
    x = _axis(command.thrust / limits.thrust)
    r = _axis(command.rudder / limits.rudder)
    return mavlink.MAVLink_manual_control_message(target, x, 0, 0, -r if clockwise else r, 0)


def command_of(message: Any, limits: CommandLimits, clockwise: bool) -> Command:
    """Return the command of a MANUAL_CONTROL message, as a vehicle interprets it."""
    rudder = limits.rudder * message.r / FULL
    return Command(-rudder if clockwise else rudder, limits.thrust * message.x / FULL)


def _axis(share: float) -> int:
    return round(FULL * min(max(share, -1.0), 1.0))


def pulse_of_rudder(angle: float, limits: CommandLimits) -> int:
    """Return the servo pulse, us, of a rudder angle (rad, positive to port); longer is more to starboard."""
    return NEUTRAL_PULSE - round(PULSE_RANGE * angle / limits.rudder)


def rudder_of_pulse(pulse: int, limits: CommandLimits) -> float:
    """Return the rudder angle of a servo pulse: the inverse of `pulse_of_rudder`."""
    return limits.rudder * (NEUTRAL_PULSE - pulse) / PULSE_RANGE


def water_track(boot_us: int, ur: float, vr: float) -> Any:
    """Return ODOMETRY with the velocity through the water alone, in the body frame (FRD), m/s."""
    unknown = float("nan")
    covariance = [unknown] + [0.0] * 20
    return mavlink.MAVLink_odometry_message(
        boot_us, mavlink.MAV_FRAME_LOCAL_FRD, mavlink.MAV_FRAME_BODY_FRD, unknown, unknown, unknown,
        [1.0, 0.0, 0.0, 0.0], ur, vr, 0.0, unknown, unknown, unknown, covariance, covariance,
    )  # fmt: skip
