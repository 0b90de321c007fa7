"""fault_relay: forwards topics, and injects a fault into them on request.

The publisher is remapped to ``<topic>_raw``, which the relay reads; it publishes ``<topic>``. The suite, or a
vehicle's driver, is tested unchanged:

    ros2 run auv_sim remus_plant --ros-args -r __ns:=/auv -r odom:=odom_raw
    ros2 run auv_sim fault_relay --ros-args -r __ns:=/auv -p topics:=odom
    ros2 param set /auv/fault_relay fault nan
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from typing import Any

from rclpy.clock import Clock, ClockType

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.fault_injection import Injector
from auv_sim.sim_parameters import Fault, FaultRelayParameters

NAME = "fault_relay"
#: Topics that can be relayed: the control chain. The last four are those of a vehicle that dives.
RELAYED = {
    topic.name: topic
    for topic in (
        topics.ODOM, topics.WATER_VELOCITY, topics.CURRENT_ESTIMATE, topics.DESIRED_YAW,
        topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST, topics.RUDDER_CMD, topics.THRUST_CMD,
        topics.MISSION_STATE, topics.DESIRED_PITCH, topics.DESIRED_PITCH_RATE, topics.STERNPLANE_CMD,
        topics.ALTITUDE,
    )
}  # fmt: skip


def raw(topic: str) -> str:
    """Return the name to which the publisher is remapped."""
    return f"{topic}_raw"


class FaultRelay(SuiteNode):
    """Forwards its topics, those named by `on` with the fault of its parameters."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__(NAME, FaultRelayParameters, **arguments)
        names = self.parameters.topics.split()
        for name in names:
            if name not in RELAYED:
                raise ConfigurationError(f"{NAME}: parameter topics", name, " ".join(RELAYED))
        self.injectors: dict[str, Injector] = {}
        #: Messages received, by topic.
        self.passed: Counter[str] = Counter()
        self._publishers_by_name: dict[str, Any] = {}
        for name in names:
            self._relay(RELAYED[name])
        self.configure()
        self.create_timer(0.002, self._release, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _relay(self, topic: Topic) -> None:
        kind = qos.message_class(topic.type)
        self.injectors[topic.name] = Injector(kind)
        self._publishers_by_name[topic.name] = self.advertise(topic)
        self.create_subscription(
            kind, raw(topic.name), self._passing(topic.name), qos.requested(topic, False), raw=True
        )

    def _passing(self, name: str) -> Callable[[bytes], None]:
        injector, publisher = self.injectors[name], self._publishers_by_name[name]

        def callback(data: bytes) -> None:
            self.passed[name] += 1
            for message in injector.pass_on(data, self.now()):
                publisher.publish(message)

        return callback

    def _release(self) -> None:
        for name, injector in self.injectors.items():
            if injector.fault != "none":
                for message in injector.due(self.now()):
                    self._publishers_by_name[name].publish(message)

    def configure(self) -> None:
        p = self.parameters
        chosen = p.on.split() if p.on else list(self.injectors)
        for name, injector in self.injectors.items():
            injector.delay, injector.jump, injector.copies = p.delay, p.jump, p.copies
            injector.fault = p.fault if name in chosen else "none"

    def inject(self, name: str, fault: Fault, **how: float) -> None:
        """Set the fault of one topic (`none` ends it); `how`: delay, jump or copies."""
        injector = self.injectors[name]
        for key, value in how.items():
            setattr(injector, key, value)
        injector.fault = fault

    def report(self) -> dict[str, Any]:
        faults = {name: injector.fault for name, injector in self.injectors.items()}
        return {f"fault {name}": fault for name, fault in faults.items() if fault != "none"}


def main(args: Sequence[str] | None = None) -> int:
    """Run the executable `fault_relay`."""
    return run_nodes([FaultRelay], args)


if __name__ == "__main__":
    raise SystemExit(main())
