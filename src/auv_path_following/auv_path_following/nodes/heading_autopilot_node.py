"""heading_autopilot: turn the references of guidance into rudder and thrust."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.contract.wire import Float64, Odometry
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.types import STOP, Command, Navigation
from auv_path_following import vehicle
from auv_path_following.control.autopilot import HeadingAutopilot
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.nodes.reference_input import REFERENCES, ReferenceInput
from auv_path_following.parameters import AutopilotParameters

_STOPPED = "rudder and thrust are 0"


class HeadingAutopilotNode(SuiteNode):
    """Publish both commands exactly once per odometry, and zeros when the inputs stop.

    An odometry is answered as soon as guidance has answered it. Without lockstep an odometry that is still
    open when the next one comes is answered with the last reference, or with a stop if that is too old.
    """

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.AUTOPILOT, AutopilotParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.autopilot = HeadingAutopilot(hull, self.parameters.autopilot)
        self._intake = OdometryIntake(self, _STOPPED)
        names = (topics.ODOM.name, *(topic.name for topic in REFERENCES))
        self._pairing = Pairing(names, strict=self.parameters.lockstep)
        self._command = STOP
        self._rudder, self._rudder_message = self.advertise(topics.RUDDER_CMD), Float64()
        self._thrust, self._thrust_message = self.advertise(topics.THRUST_CMD), Float64()
        self.close_gate()
        self.listen(topics.ODOM, self._on_odometry)
        self._references = ReferenceInput(self, hull.thrust_max, self._put, self._starts, _STOPPED)
        if not self.parameters.lockstep:
            self.every(0.1, self._watch)

    def validate(self, proposed: AutopilotParameters) -> None:
        HeadingAutopilot(self.autopilot.vehicle, proposed.autopilot)  # raises where the gains do not fit

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
        # A gap between stamps counts as a gap in time: which is found first must not matter.
        if moved or (free and dt > self.parameters.odometry_timeout):
            self.autopilot.reset()
        if free and topic in self._pairing:
            self._answer(*self._pairing.take())
        self._put(topic, (navigation, dt), stamp)

    def _starts(self) -> None:
        self._intake.reset_gate()
        self.autopilot.reset()

    def _put(self, topic: str, value: Any, stamp: int | None = None) -> None:
        if self._pairing.put(topic, value, stamp):
            self._answer(*self._pairing.take())

    def _answer(
        self, odometry: tuple[Navigation, float], yaw: float | None, rate: float | None, thrust: float | None
    ) -> None:
        self._references.take(yaw, rate, thrust)
        reference = self._references.obeyed()
        navigation, dt = odometry
        if reference is None:
            self.autopilot.reset()
            self._command = STOP
        else:
            self._command = self.autopilot.update(navigation, reference, dt).command
        self.answer(self._publish)

    def _watch(self) -> None:
        """Stop the vehicle when no odometry comes, because only odometry triggers an answer."""
        if self._intake.silent:
            self.autopilot.reset()
            self._pairing.clear()
            self._stop()

    def close(self) -> None:
        """Stop the vehicle when the autopilot ends."""
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
