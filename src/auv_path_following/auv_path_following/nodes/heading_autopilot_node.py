"""heading_autopilot: turn the references of guidance into rudder, stern planes and thrust."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import finite
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.contract.wire import Float64, Odometry
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import vehicle
from auv_path_following.nodes.odometry_intake import OdometryIntake
from auv_path_following.nodes.reference_input import ReferenceInput
from auv_path_following.nodes.spatial_steering import steering_of
from auv_path_following.parameters import AutopilotParameters

_STOPPED = "rudder and thrust are 0"


class HeadingAutopilotNode(SuiteNode):
    """Publish each command exactly once per odometry, and zeros when the inputs stop.

    An odometry is answered as soon as guidance has answered it. Without lockstep an odometry that is still
    open when the next one comes is answered with the last reference, or with a stop if that is too old.
    """

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.AUTOPILOT, AutopilotParameters, **arguments)
        hull = vehicle.load(self.parameters.vehicle)
        self.autopilot = steering_of(hull, self.parameters)
        self._intake = OdometryIntake(self, _STOPPED)
        names = (topics.ODOM.name, *(topic.name for topic in self.autopilot.references))
        self._pairing = Pairing(names, strict=self.parameters.lockstep)
        self._command = self.autopilot.stop
        self._outputs = [(self.advertise(topic), Float64()) for topic in self.autopilot.commands]
        self.close_gate()
        self.listen(topics.ODOM, self._on_odometry)
        for topic in () if self.parameters.lockstep else self.autopilot.watched:
            self.listen(topic, self._on_planes)
        self._references = ReferenceInput(self, self.autopilot, self._put, self._starts, _STOPPED)
        if not self.parameters.lockstep:
            self.every(0.1, self._watch)

    def validate(self, proposed: AutopilotParameters) -> None:
        self.autopilot.validate(proposed)

    def configure(self) -> None:
        self.autopilot.configure(self.parameters)
        self._intake.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._pairing.missing)

    def report(self) -> dict[str, Any]:
        rudder, *planes, thrust = self._command
        values = {"rudder [rad]": f"{rudder:.4f}", "thrust [N]": f"{thrust:.2f}"}
        return values | ({"stern planes [rad]": f"{planes[0]:.4f}"} if planes else {})

    def _on_odometry(self, message: Odometry) -> None:
        topic = topics.ODOM.name
        self._intake.under_way = self._command.thrust > 0.0
        navigation, dt, stamp, _, moved = self._intake.take(message)
        free = not self.parameters.lockstep
        # A gap between stamps counts as a gap in time: which is found first must not matter.
        if moved or (free and dt > self.parameters.odometry_timeout):
            self.autopilot.reset()
        if free and topic in self._pairing:
            self._answer(self._pairing.take())
        self._put(topic, (navigation, dt), stamp)

    def _on_planes(self, message: Float64) -> None:
        self.autopilot.planes = finite(message.data, topics.STERNPLANE_STATE.name)

    def _starts(self) -> None:
        self._intake.reset_gate()
        self.autopilot.reset()

    def _put(self, topic: str, value: Any, stamp: int | None = None) -> None:
        if self._pairing.put(topic, value, stamp):
            self._answer(self._pairing.take())

    def _answer(self, parts: tuple[Any, ...]) -> None:
        """Answer an odometry: (navigation, dt), then the references in their order."""
        (navigation, dt), *references = parts
        self._references.take(tuple(references))
        reference = self._references.obeyed()
        if reference is None:
            self.autopilot.reset()
            self._command = self.autopilot.stop
        else:
            self._command = self.autopilot.update(navigation, reference, dt)
        self.health.warn("planes", self.autopilot.watch(self._command, dt))
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
        self._command = self.autopilot.stop
        self._publish()

    def _publish(self) -> None:
        for (publisher, message), value in zip(self._outputs, self._command, strict=True):
            message.data = value
            publisher.publish(message)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `heading_autopilot`."""
    return run_nodes([HeadingAutopilotNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
