"""heading_autopilot: from the references of guidance to rudder and thrust."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from nav_msgs.msg import Odometry
from std_msgs.msg import Float64

from auv_msgs_py import topics
from auv_msgs_py.conversions import finite
from auv_msgs_py.frames import FrameTable, flip_yaw
from auv_msgs_py.pairing import Pairing
from auv_msgs_py.runtime import SuiteNode, run_nodes
from auv_msgs_py.stamps import StampGuard
from auv_msgs_py.topics import Topic
from auv_msgs_py.types import STOP, Command, Navigation, Reference
from auv_path_following import vehicle
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.nodes.navigation_input import accept
from auv_path_following.parameters import AutopilotParameters

_REFERENCES = (topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST)


class HeadingAutopilotNode(SuiteNode):
    """Sends both commands exactly once per odometry, and zeros of itself when its inputs fall silent.

    An odometry is answered as soon as guidance has answered it too. Without lockstep one that is still
    open when the next comes is answered with the last reference, or, if that is too old, with a stop.
    """

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.AUTOPILOT, AutopilotParameters, **arguments)
        self.autopilot = HeadingAutopilot(vehicle.load(self.parameters.vehicle), self.parameters.autopilot)
        self._frames = FrameTable(self.parameters.frames)
        self._guard = StampGuard(ordered=self.parameters.lockstep)
        self._pairing = Pairing(
            (topics.ODOM.name, *(topic.name for topic in _REFERENCES)), strict=self.parameters.lockstep
        )
        self._reference: tuple[Reference, float] | None = None
        self._last_odometry: float | None = None
        self._command = STOP
        self._rudder, self._rudder_message = self.advertise(topics.RUDDER_CMD), Float64()
        self._thrust, self._thrust_message = self.advertise(topics.THRUST_CMD), Float64()
        self.close_gate()
        self.listen(topics.ODOM, self._on_odometry)
        for topic in _REFERENCES:
            self.listen(topic, self._on_reference(topic))
        if not self.parameters.lockstep:
            self.create_timer(0.1, self._watch)

    def configure(self) -> None:
        self.autopilot.configure(self.parameters.autopilot)

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._pairing.missing)

    def report(self) -> dict[str, Any]:
        return {"rudder [rad]": f"{self._command.rudder:.4f}", "thrust [N]": f"{self._command.thrust:.2f}"}

    def _on_odometry(self, message: Odometry) -> None:
        topic = topics.ODOM.name
        navigation, dt, stamp, restarted = accept(message, self._frames, self._guard)
        if restarted:
            self.autopilot.reset()
        self._last_odometry = self.now()
        if not self.parameters.lockstep and topic in self._pairing:
            self._answer(*self._pairing.take())
        self._put(topic, (navigation, dt), stamp)

    def _on_reference(self, topic: Topic) -> Callable[[Float64], None]:
        def callback(message: Float64) -> None:
            self._put(topic.name, finite(message.data, topic.name), None)

        return callback

    def _put(self, topic: str, value: Any, stamp: int | None) -> None:
        if self._pairing.put(topic, value, stamp):
            self._answer(*self._pairing.take())

    def _answer(
        self, odometry: tuple[Navigation, float], yaw: float | None, rate: float | None, thrust: float | None
    ) -> None:
        if yaw is not None and rate is not None and thrust is not None:
            self._reference = Reference(flip_yaw(yaw), -rate, thrust), self.now()
        reference = self._fresh_reference()
        navigation, dt = odometry
        if reference is None:
            self.autopilot.reset()
            self._command = STOP
        else:
            self._command = self.autopilot.update(navigation, reference, dt).command
        self.answer(self._publish)

    def _fresh_reference(self) -> Reference | None:
        if self._reference is None:
            return None
        reference, at = self._reference
        silent = not self.parameters.lockstep and self.now() - at > self.parameters.reference_timeout
        self.health.error("guidance", "guidance is silent: rudder and thrust are 0" if silent else "")
        return None if silent else reference

    def _watch(self) -> None:
        """Odometry drives everything; without it nobody else would stop the vehicle."""
        if self._last_odometry is None:
            return
        silent = self.now() - self._last_odometry > self.parameters.odometry_timeout
        self.health.error("odometry", f"no {topics.ODOM.name}: rudder and thrust are 0" if silent else "")
        if silent:
            self.autopilot.reset()
            self._pairing.clear()
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
