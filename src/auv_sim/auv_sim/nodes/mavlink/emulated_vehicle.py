"""The emulated vehicle: the REMUS plant, its instruments and its failsafe, speaking MAVLink. ROS-free."""

from __future__ import annotations

import math
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.values.types import Current, SpatialCurrent
from auv_path_following.vehicle import Vehicle
from auv_sim.nodes.held_commands import orders_of
from auv_sim.nodes.mavlink.delay_line import MessageKind
from auv_sim.nodes.mavlink.mapping import CommandLimits, command_of, pulse_of, water_track
from auv_sim.vehicle.diving.simulated_diver import simulated_vehicle
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.remus import PlantState

#: One step, ms; every period below is a multiple of it.
STEP_MS = 10
#: Age of the newest command after which the vehicle stops, ms.
COMMAND_TIMEOUT_MS = 1000
#: The vehicle's time since boot when the program starts, ms.
BOOT_MS = 12_340

KINDS = {
    "attitude": MessageKind(20, 20.0, 5.0),
    "position": MessageKind(50, 40.0, 10.0),
    "water": MessageKind(100, 60.0, 20.0),
    "servo": MessageKind(100, 30.0, 10.0),
    "heartbeat": MessageKind(1000, 20.0, 5.0),
}
#: Answers and warnings come at any time: a varying delay would make them overtake each other.
ANSWERS = MessageKind(0, 20.0, 0.0)
#: Link id of each kind: signatures must rise on a link, and messages of different kinds overtake each other.
LINKS = {kind: number for number, kind in enumerate((*KINDS.values(), ANSWERS))}
#: Of a vehicle that dives above a bottom.
ALTITUDE = MessageKind(100, 40.0, 5.0)
LINKS[ALTITUDE] = len(LINKS)
#: Commands and requests to the vehicle.
UPLINK = MessageKind(0, 20.0, 5.0)


class Emulator:
    """The vehicle, its instruments and its failsafe, advanced step by step.

    Until the first thrust it lies in its launching tube, at rest over ground.

    Args:
        hull: of the plant.
        initial: first state; its speed applies from the first thrust on.
        current: of the water, m/s, NED.
    """

    def __init__(
        self, hull: Vehicle, initial: PlantState | BodyState, current: Current | SpatialCurrent
    ) -> None:
        self.plant: Any = simulated_vehicle(hull, initial, current=current)
        self.limits = CommandLimits.of(hull)
        self.kinds = dict(KINDS)
        self.now_ms = BOOT_MS
        self.in_tube = True
        self.failsafe = True
        self.failsafes = 0
        #: Messages sent since this was last cleared: (kind, message).
        self.sent: list[tuple[MessageKind, Any]] = []
        self._stop: Any = orders_of(hull).stop
        self._command, self._commanded_at = self._stop, -COMMAND_TIMEOUT_MS

    def hear(self, message: Any) -> None:
        """Process a message of the driver."""
        kind = message.get_type()
        if kind == "MANUAL_CONTROL":
            self._command, self._commanded_at = command_of(message, self.limits, clockwise=True), self.now_ms
            self.failsafe = False
            if self._command.thrust > 0.0:
                self.in_tube = False
        elif kind == "TIMESYNC" and message.tc1 == 0:
            answer = mavlink.MAVLink_timesync_message(self.now_ms * 1_000_000, message.ts1)
            self.sent.append((ANSWERS, answer))

    def step(self) -> None:
        """Measure and send, then advance by one step."""
        for name, kind in self.kinds.items():
            if self.now_ms % kind.period == 0:
                self.sent.append((kind, getattr(self, f"_{name}")()))
        if not self.failsafe and self.now_ms - self._commanded_at > COMMAND_TIMEOUT_MS:
            self.failsafe = True
            self.failsafes += 1
            text = f"failsafe: no command for {COMMAND_TIMEOUT_MS / 1000:g} s".encode()
            message = mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_CRITICAL, text)
            self.sent.append((ANSWERS, message))
        command = self._stop if self.failsafe else self._command
        if not self.in_tube:
            self.plant.advance(command, STEP_MS * 1e-3)
        self.now_ms += STEP_MS

    def _heartbeat(self) -> Any:
        state = mavlink.MAV_STATE_CRITICAL if self.failsafe and not self.in_tube else mavlink.MAV_STATE_ACTIVE
        mode = mavlink.MAV_MODE_FLAG_SAFETY_ARMED | mavlink.MAV_MODE_FLAG_MANUAL_INPUT_ENABLED
        return mavlink.MAVLink_heartbeat_message(
            mavlink.MAV_TYPE_SUBMARINE, mavlink.MAV_AUTOPILOT_GENERIC, mode, 0, state, 3
        )

    def _attitude(self) -> Any:
        state = self.plant.motion
        psi, r = math.remainder(state.psi, math.tau), 0.0 if self.in_tube else state.r
        return mavlink.MAVLink_attitude_message(self.now_ms, 0.0, 0.0, psi, 0.0, 0.0, r)

    def _position(self) -> Any:
        state = self.plant.motion
        u, v = (0.0, 0.0) if self.in_tube else self.plant.ground_velocity
        cos_psi, sin_psi = math.cos(state.psi), math.sin(state.psi)
        return mavlink.MAVLink_local_position_ned_message(
            self.now_ms, state.x, state.y, 0.0, u * cos_psi - v * sin_psi, u * sin_psi + v * cos_psi, 0.0
        )

    def _water(self) -> Any:
        ur, vr = (0.0, 0.0) if self.in_tube else self.plant.water_velocity
        return water_track(self.now_ms * 1000, ur, vr)

    def _servo(self) -> Any:
        pulse = pulse_of(self.plant.rudder, self.limits.rudder)
        return mavlink.MAVLink_servo_output_raw_message(self.now_ms * 1000 % 2**32, 0, pulse, *[0] * 7)
