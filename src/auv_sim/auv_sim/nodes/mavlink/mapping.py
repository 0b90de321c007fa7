"""The mapping between the wire contract and MAVLink, in numbers; docs/mavlink.md has it as a table. ROS-free.

MAVLink's local frame is NED and its body frame FRD, which is also what the suite calculates in: nothing is
turned here. What has to be turned for the wire is turned by `auv_msgs_py.contract.conversions`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle

#: MANUAL_CONTROL's axes go from -FULL to FULL.
FULL = 1000
#: Servo pulses: neutral, and from there to either stop, microseconds.
NEUTRAL_PULSE, PULSE_RANGE = 1500, 400
#: Component of the vehicle that sends the velocity of its water-track log.
WATER_LOG = mavlink.MAV_COMP_ID_USER1


class CommandLimits(NamedTuple):
    """What full deflection of an axis means: rudder in rad, thrust in N."""

    rudder: float
    thrust: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> CommandLimits:
        """The vehicle's own."""
        return cls(vehicle.rudder.max_angle, vehicle.thrust_max)


def heartbeat() -> Any:
    """HEARTBEAT of an onboard computer."""
    kind, autopilot = mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID
    return mavlink.MAVLink_heartbeat_message(kind, autopilot, 0, 0, mavlink.MAV_STATE_ACTIVE, 3)


def manual_control(command: Command, limits: CommandLimits, clockwise: bool, target: int) -> Any:
    """MANUAL_CONTROL: x is thrust ahead, r the rudder; y, z and the buttons stay at rest.

    Args:
        command: rudder positive to port, and thrust.
        limits: what full deflection means.
        clockwise: whether a positive r turns the bow to starboard, as autopilots and ground stations have
            it; the specification's text says counter-clockwise.
        target: the vehicle's system id.
    """
    x = _axis(command.thrust / limits.thrust)
    r = _axis(command.rudder / limits.rudder)
    return mavlink.MAVLink_manual_control_message(target, x, 0, 0, -r if clockwise else r, 0)


def command_of(message: Any, limits: CommandLimits, clockwise: bool) -> Command:
    """MANUAL_CONTROL as a vehicle understands it."""
    rudder = limits.rudder * message.r / FULL
    return Command(-rudder if clockwise else rudder, limits.thrust * message.x / FULL)


def _axis(share: float) -> int:
    return round(FULL * min(max(share, -1.0), 1.0))


def pulse_of_rudder(angle: float, limits: CommandLimits) -> int:
    """Rudder angle (rad, positive to port) -> servo pulse; a longer pulse is more to starboard."""
    return NEUTRAL_PULSE - round(PULSE_RANGE * angle / limits.rudder)


def rudder_of_pulse(pulse: int, limits: CommandLimits) -> float:
    """The inverse of `pulse_of_rudder`."""
    return limits.rudder * (NEUTRAL_PULSE - pulse) / PULSE_RANGE


def water_track(boot_us: int, ur: float, vr: float) -> Any:
    """ODOMETRY with nothing but the velocity through the water in the body frame (FRD), m/s."""
    unknown = float("nan")
    covariance = [unknown] + [0.0] * 20
    return mavlink.MAVLink_odometry_message(
        boot_us, mavlink.MAV_FRAME_LOCAL_FRD, mavlink.MAV_FRAME_BODY_FRD, unknown, unknown, unknown,
        [1.0, 0.0, 0.0, 0.0], ur, vr, 0.0, unknown, unknown, unknown, covariance, covariance,
    )  # fmt: skip
