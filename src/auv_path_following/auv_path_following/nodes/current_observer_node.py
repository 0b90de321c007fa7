"""current_observer: estimate the current from odometry and velocity through water."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import fill_current
from auv_msgs_py.contract.spatial_conversions import fill_spatial_current
from auv_msgs_py.contract.wire import Vector3Stamped
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following import vehicle
from auv_path_following.navigation.current_observer import CurrentObserver
from auv_path_following.navigation.spatial_observer import SpatialCurrentObserver
from auv_path_following.nodes.navigation_input import NavigationInput
from auv_path_following.nodes.readings import Inputs
from auv_path_following.parameters import ObserverParameters


class CurrentObserverNode(SuiteNode):
    """Publish `current_estimate` once per odometry with a fresh velocity through water."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.OBSERVER, ObserverParameters, **arguments)
        dives = vehicle.load(self.parameters.vehicle).dives
        kind = SpatialCurrentObserver if dives else CurrentObserver
        self.observer: Any = kind(self.parameters.observer)
        self._fill = fill_spatial_current if dives else fill_current
        self._message = Vector3Stamped()
        self._publisher = self.advertise(topics.CURRENT_ESTIMATE)
        self.close_gate()
        self._input = NavigationInput(self, self._step, self.observer.reset)

    def configure(self) -> None:
        self.observer.configure(self.parameters.observer)
        self._input.odometry.configure()

    def waiting_for(self) -> str:
        return self.gate_waits_for() or ", ".join(self._input.missing)

    def report(self) -> dict[str, Any]:
        current = self.observer.current
        names = ("north [m/s]", "east [m/s]", "down [m/s]")
        return {name: f"{part:.3f}" for name, part in zip(names, current, strict=False)}

    def _step(self, inputs: Inputs) -> None:
        if inputs.moved:
            self.observer.relocate()
        self.observer.update(inputs.navigation, inputs.water, inputs.dt)
        late = inputs.water is None and inputs.water_age > self.parameters.water_velocity_timeout
        text = f"no fresh {topics.WATER_VELOCITY.name}: the estimate rests" if late else ""
        self.health.warn("water", text)
        if inputs.water is None:
            return
        self._fill(self._message, self.observer.current, inputs.stamp)
        self.answer(self._publish)

    def _publish(self) -> None:
        self._publisher.publish(self._message)


def main(args: Sequence[str] | None = None) -> int:
    """The executable `current_observer`."""
    return run_nodes([CurrentObserverNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
