"""heading_autopilot: from the references of guidance to rudder and thrust."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from std_msgs.msg import String

from auv_msgs_py import topics
from auv_msgs_py.conversions import finite
from auv_msgs_py.errors import MessageRefused
from auv_msgs_py.frames import flip_yaw
from auv_msgs_py.mission_word import MissionWord
from auv_msgs_py.pairing import Pairing
from auv_msgs_py.runtime import SuiteNode, run_nodes
from auv_msgs_py.topics import Topic
from auv_msgs_py.types import STOP, Command, Navigation, Reference
from auv_msgs_py.wire import Float64, Odometry
from auv_path_following import vehicle
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.control.reference_watch import ReferenceWatch
from auv_path_following.guidance.mission_state import State
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.parameters import AutopilotParameters

_REFERENCES = (topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST)
_STOPPED = "rudder and thrust are 0"


class HeadingAutopilotNode(SuiteNode):
    """Sends both commands exactly once per odometry, and zeros of itself when its inputs fall silent.

    An odometry is answered as soon as guidance has answered it too. Without lockstep one that is still
    open when the next comes is answered with the last reference, or, if that is too old, with a stop.
    """

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.AUTOPILOT, AutopilotParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.autopilot = HeadingAutopilot(hull, self.parameters.autopilot)
        #: What no guidance asks for: more than a turn, a whirl, a multiple of the thrust there is.
        self._largest = dict(zip(_REFERENCES, (6.5, 10.0, 10.0 * hull.thrust_max), strict=True))
        self._intake = OdometryIntake(self, _STOPPED)
        self._pairing = Pairing(
            (topics.ODOM.name, *(topic.name for topic in _REFERENCES)), strict=self.parameters.lockstep
        )
        self._references = ReferenceWatch()
        self._command = STOP
        self._missing = ""
        self._mission = MissionWord(State)
        self._rudder, self._rudder_message = self.advertise(topics.RUDDER_CMD), Float64()
        self._thrust, self._thrust_message = self.advertise(topics.THRUST_CMD), Float64()
        self.close_gate()
        self.listen(topics.ODOM, self._on_odometry)
        for topic in _REFERENCES:
            self.listen(topic, self._on_reference(topic))
        self.listen(topics.MISSION_STATE, self._on_mission_state)
        if not self.parameters.lockstep:
            self.every(0.1, self._watch)

    def try_out(self, wanted: AutopilotParameters) -> None:
        HeadingAutopilot(self.autopilot.vehicle, wanted.autopilot)  # raises where that cannot be

    def configure(self) -> None:
        self.autopilot.configure(self.parameters.autopilot)
        self._intake.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._pairing.missing)

    def report(self) -> dict[str, Any]:
        return {"rudder [rad]": f"{self._command.rudder:.4f}", "thrust [N]": f"{self._command.thrust:.2f}"}

    def _on_odometry(self, message: Odometry) -> None:
        topic = topics.ODOM.name
        self._intake.under_way = self._command.thrust > 0.0
        navigation, dt, stamp, _, moved = self._intake.take(message)
        free = not self.parameters.lockstep
        # A gap between stamps as one in time: which is noticed first must not matter.
        if moved or (free and dt > self.parameters.odometry_timeout):
            self.autopilot.reset()
        if free and topic in self._pairing:
            self._answer(*self._pairing.take())
        self._put(topic, (navigation, dt), stamp)

    def _on_reference(self, topic: Topic) -> Callable[[Float64], None]:
        largest = self._largest[topic]

        def callback(message: Float64) -> None:
            value = finite(message.data, topic.name)
            if abs(value) > largest:
                raise MessageRefused(topic.name, f"{value:g}", f"from {-largest:g} to {largest:g}")
            self._put(topic.name, value, None)

        return callback

    def _on_mission_state(self, message: String) -> None:
        now = time.monotonic()
        before = self._mission.at(now)
        refused = self._mission.hear(message.data, now)
        starts = message.data == State.RUNNING and before not in (State.RUNNING, State.HOLDING)
        if starts and not self.parameters.lockstep:
            self._intake.believe_anew()
            self.autopilot.reset()
        if refused is not None:
            raise refused

    def _put(self, topic: str, value: Any, stamp: int | None) -> None:
        if self._pairing.put(topic, value, stamp):
            self._answer(*self._pairing.take())

    def _answer(
        self, odometry: tuple[Navigation, float], yaw: float | None, rate: float | None, thrust: float | None
    ) -> None:
        if yaw is not None and rate is not None and thrust is not None:
            self._references.put(Reference(flip_yaw(yaw), -rate, thrust), self.now())
        else:
            parts = zip(_REFERENCES, (yaw, rate, thrust), strict=True)
            self._missing = ", ".join(topic.name for topic, value in parts if value is None)
        reference = self._obeyed()
        navigation, dt = odometry
        if reference is None:
            self.autopilot.reset()
            self._command = STOP
        else:
            self._command = self.autopilot.update(navigation, reference, dt).command
        self.answer(self._publish)

    def _obeyed(self) -> Reference | None:
        """The reference to follow; None: stop."""
        references = self._references
        if self.parameters.lockstep:
            return references.newest
        reference = references.allowed(
            self.now(), self._mission.at(time.monotonic()), self.parameters.reference_timeout
        )
        silent = f"guidance is silent (no {self._missing}): {_STOPPED}" if references.silent else ""
        self.health.error("guidance", silent)
        odd = references.contradiction
        self.health.error("interlock", f"{topics.DESIRED_THRUST.name} {odd}: {_STOPPED}" if odd else "")
        return reference

    def _watch(self) -> None:
        """Odometry drives everything; without it nobody else would stop the vehicle."""
        if self._intake.silent:
            self.autopilot.reset()
            self._pairing.clear()
            self._stop()

    def close(self) -> None:
        """Whoever stops the autopilot stops the vehicle."""
        if not self.parameters.lockstep:
            self._stop()

    def _stop(self) -> None:
        self._command = STOP
        self._publish()

    def _publish(self) -> None:
        command: Command = self._command
        self._rudder_message.data, self._thrust_message.data = command
        self._rudder.publish(self._rudder_message)
        self._thrust.publish(self._thrust_message)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `heading_autopilot`."""
    return run_nodes([HeadingAutopilotNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
