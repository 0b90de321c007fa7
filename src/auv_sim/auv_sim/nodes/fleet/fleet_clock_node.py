"""fleet_clock: the one /clock of several simulated vehicles in a graph.

In lockstep each vehicle has its own chain, and no result depends on another vehicle, so no common step is
needed: /clock follows the slowest vehicle, and the others may be `FLEET_LEAD_NS` ahead. A barrier at each
step would cost two messages for each vehicle, and all would wait for the slowest. A report twice a second
costs a tenth of that, and the tracks are bit-identical.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.clock import Clock as RosClock
from rclpy.clock import ClockType

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import set_stamp, stamp_of
from auv_msgs_py.contract.topics import Topic, full_name
from auv_msgs_py.contract.wire import Clock
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.fleet.fleet_time import FleetTime
from auv_sim.nodes.pacing import Pacer
from auv_sim.sim_parameters import FleetClockParameters

#: Period at which an unchanged /clock is repeated in lockstep, for a reader that has missed it, s.
_REPEAT = 0.2
#: Wall time from the last start to the first step of a free run, in which all nodes match their readers, s.
_SETTLING = 1.0


class FleetClockNode(SuiteNode):
    """Publishes /clock: in lockstep as far as all vehicles are, else at the pace of the wall clock."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(topics.FLEET_CLOCK, FleetClockParameters, **arguments)
        p: FleetClockParameters = self.parameters
        vehicles = p.vehicles.split()
        if not vehicles:
            raise ConfigurationError(f"{self.get_name()}: parameter vehicles", "none", "namespaces")
        self._fleet_time = FleetTime(vehicles)
        self._clock_message = Clock()
        self._read = False
        self._clock_publisher = self.advertise(topics.CLOCK)
        for vehicle in vehicles:
            self.listen(_of(vehicle, topics.MISSION_STATE), self._on_state(vehicle))
            if p.lockstep:
                self.listen(_of(vehicle, topics.VEHICLE_PROGRESS), self._on_progress(vehicle))
        self._fleet_pacer = Pacer(p.step / p.speed)
        period = _REPEAT if p.lockstep else self._fleet_pacer.ask_every
        steady = RosClock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(period, self._repeat if p.lockstep else self._tick, clock=steady)

    def claim(self) -> Claim:
        names = (topics.FLEET_CLOCK,)
        return Claim(holder=self.get_fully_qualified_name(), namespace="/", names=names, clock=True)

    def report(self) -> dict[str, Any]:
        return {"time [s]": f"{self._fleet_time.now * 1e-9:.3f}"}

    def _on_state(self, vehicle: str) -> Callable[[Any], None]:
        def entered(message: Any) -> None:
            self._fleet_time.enter(vehicle, message.data)
            self._advance()

        return entered

    def _on_progress(self, vehicle: str) -> Callable[[Any], None]:
        def reached(message: Any) -> None:
            self._fleet_time.reach(vehicle, stamp_of(message.clock, topics.VEHICLE_PROGRESS.name))
            self._advance()

        return reached

    def _advance(self) -> None:
        if self.parameters.lockstep and self._fleet_time.advance():
            self._publish()

    def _repeat(self) -> None:
        if self._fleet_time.has_begun:
            self._publish()

    def _tick(self) -> None:
        """Take the next step of a free run when the wall clock demands it."""
        if not (self._fleet_time.has_begun and self._is_read()):
            self._fleet_pacer.restart(time.monotonic() + _SETTLING)
        elif self._fleet_pacer.due(time.monotonic()):
            self._publish()
            self._fleet_time.now += round(self.parameters.step * 1e9)

    def _is_read(self) -> bool:
        """Return whether all simulators, and all other readers in the graph, receive /clock."""
        if not self._read:
            readers = self.get_subscriptions_info_by_topic(topics.CLOCK.name)
            present = {info.node_namespace for info in readers if info.node_name == topics.PLANT}
            matched = self._clock_publisher.get_subscription_count() >= len(readers)
            self._read = matched and present >= set(self.parameters.vehicles.split())
        return self._read

    def _publish(self) -> None:
        set_stamp(self._clock_message.clock, self._fleet_time.now)
        self._clock_publisher.publish(self._clock_message)


def _of(vehicle: str, topic: Topic) -> Topic:
    return topic._replace(name=full_name(vehicle, topic.name))


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `fleet_clock`."""
    return run_nodes([FleetClockNode], args)


if __name__ == "__main__":
    raise SystemExit(main())
