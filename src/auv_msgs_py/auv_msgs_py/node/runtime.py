"""The base of every node. `run` has the loop that runs it."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.time import Time

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node import params
from auv_msgs_py.node.health import Health
from auv_msgs_py.node.lockstep_gate import LockstepGate
from auv_msgs_py.node.private_rclpy import stop_reading_clock
from auv_msgs_py.node.transport import WirePublisher, decoder, generated_decoder
from auv_msgs_py.node.watch import ClockWatch, RateWatch
from auv_msgs_py.values.errors import LockstepBroken, MessageRefused


class SuiteNode(Node):  # type: ignore[misc]
    """A node with declared settings, contract topics and health.

    Args:
        name: the node's name.
        parameters: its settings class, which has `lockstep`, `recorded` and `flood_rate`.
        arguments: handed on to `rclpy.node.Node` (namespace, cli_args, ...).
    """

    def __init__(self, name: str, parameters: type[Any], **arguments: Any) -> None:
        self._stamp: int | None = None
        #: Names of the topics that are listened to and have one publisher each.
        self._heard: list[str] = []
        super().__init__(name, **arguments)
        self._steady_to_ros = float(self.get_clock().now().nanoseconds) * 1e-9 - time.monotonic()
        self.parameters: Any = params.declare(
            self, parameters, self._changed, self.validate, arguments.get("cli_args") or sys.argv
        )
        self.publishers_by_topic: dict[Topic, Publisher] = {}
        self.fault = ""
        self.finished = False
        #: Set by `spin`: makes it look at `fault` and `finished` at once.
        self.interrupt_spinning: Callable[[], None] = lambda: None
        self._gate: LockstepGate | None = None
        self._kept: Callable[[], None] | None = None
        self._rates = RateWatch(self.parameters.flood_rate)
        self._clock_watch = ClockWatch()
        self.health = Health(self, self.report, self.waiting_for, self._look)
        if self.parameters.lockstep:
            # Time stands still between two odometries, whose stamps are what /clock says: `listen` takes it
            # from there. A reader of /clock in every node costs a fifth of a step's processor time.
            stop_reading_clock(self)

    def report(self) -> dict[str, Any]:
        """Further values for /diagnostics."""
        return {}

    def waiting_for(self) -> str:
        """The topic that the current step still lacks, for /diagnostics."""
        return ""

    def claim(self) -> Claim | None:
        """What a simulator takes for itself in the graph; None for every other node."""
        return None

    def configure(self) -> None:
        """Called after `self.parameters` was changed in flight."""

    def validate(self, wanted: Any) -> None:
        """Called before parameters are changed in flight; a `ConfigurationError` refuses them."""

    def _changed(self, parameters: Any) -> None:
        self.parameters = parameters
        self.configure()

    def advertise(self, topic: Topic) -> Publisher:
        """A publisher as the contract has it; it takes light messages and the generated ones."""
        publisher = self.create_publisher(
            qos.message_class(topic.type), topic.name, qos.offered(topic), publisher_class=WirePublisher
        )
        self.publishers_by_topic[topic] = publisher
        return publisher

    def listen(self, topic: Topic, callback: Callable[[Any], None]) -> None:
        """A subscription as the contract has it; a refused message is counted and reported, never raised.

        A message that `wire` knows arrives as its light class, the same object each time: do not keep it.
        """
        decode = decoder(topic)
        if topic is not topics.DIAGNOSTICS:  # every node publishes that
            self._heard.append(topic.name)
        tells_time = topic is topics.ODOM and self.parameters.lockstep
        name, rates = topic.name, self._rates

        def guarded(data: bytes) -> None:
            rates.counts[name] += 1
            try:
                message = decode(data)
                if tells_time:
                    self.time_is(stamp_of(message.header.stamp, name))
                callback(message)
            except MessageRefused as error:
                self.health.refuse(error)
            except LockstepBroken as error:
                self.fail(str(error))

        profile = qos.requested(topic, self.parameters.lockstep)
        self.create_subscription(qos.message_class(topic.type), name, guarded, profile, raw=True)

    def create_subscription(self, kind: Any, name: str, callback: Any, *arguments: Any, **named: Any) -> Any:
        """As rclpy's; what comes on /clock is checked before rclpy sets the clock by it."""
        if name == topics.CLOCK.name and not named.get("raw"):
            self._heard.append(name)
            return super().create_subscription(
                kind, name, self._guarded_clock(callback), *arguments, raw=True, **named
            )
        return super().create_subscription(kind, name, callback, *arguments, **named)

    def _guarded_clock(self, set_clock: Callable[[Any], None]) -> Callable[[bytes], None]:
        decode = generated_decoder(topics.CLOCK)

        def guarded(data: bytes) -> None:
            try:
                message = decode(data)
                stamp_of(message.clock, topics.CLOCK.name)
                set_clock(message)
            except MessageRefused as error:
                self.health.refuse(error)

        return guarded

    def _second_publishers(self) -> str:
        """Topics that more than one node publishes, for people: the contract has one publisher for each."""
        found = []
        for name in self._heard:
            if self.count_publishers(name) > 1:
                infos = self.get_publishers_info_by_topic(self.resolve_topic_name(name))
                nodes = sorted({topics.full_name(info.node_namespace, info.node_name) for info in infos})
                if len(nodes) > 1:
                    found.append(f"{name} is published by {', '.join(nodes)}")
        return "; ".join(found)

    def _look(self) -> None:
        """What no single message shows."""
        self.health.warn("publishers", self._second_publishers())
        if self.parameters.lockstep:
            return
        now = self.now()
        still = self._clock_watch.stands_still(now, time.monotonic())
        self.health.error("clock", "the clock stands still: is the simulator dead?" if still else "")
        self.health.warn("flood", self._rates.told(now))

    def now(self) -> float:
        """Time to measure by, s: simulated time where there is one; else a clock that nobody sets.

        The computer's own time steps when it is set by GPS or a network; nothing came late because of that.
        """
        if self._stamp is not None:
            return self._stamp * 1e-9
        clock = self.get_clock()
        if clock.ros_time_is_active:
            return float(clock.now().nanoseconds) * 1e-9
        return self._steady_to_ros + time.monotonic()

    def every(self, period: float, callback: Callable[[], None]) -> None:
        """Call back every `period` s of the time that `now` measures: setting a clock delays no watchdog."""
        simulated = self.get_clock().ros_time_is_active
        self.create_timer(
            period, callback, clock=None if simulated else Clock(clock_type=ClockType.STEADY_TIME)
        )

    def time_is(self, stamp: int) -> None:
        """In lockstep: what /clock says now, ns."""
        if self.parameters.lockstep:
            self._stamp = stamp

    def get_clock(self) -> Clock:
        """The node's clock; in lockstep it is set when somebody looks at it."""
        clock = super().get_clock()
        if self._stamp is not None:
            clock.set_ros_time_override(Time(nanoseconds=self._stamp, clock_type=ClockType.ROS_TIME))
        return clock

    def close_gate(self) -> None:
        """Lockstep: call once after the last `advertise`; from then on `answer` waits for all readers."""
        if self.parameters.lockstep:
            self._gate = LockstepGate(self, dict(self.publishers_by_topic), self.parameters.recorded)

    def answer(self, publish: Callable[[], None]) -> None:
        """Publish now, or in lockstep as soon as every reader is matched. One step is under way at a time."""
        if self._gate is None:
            publish()
        elif not self._gate.waiting_for():
            self._gate = None
            publish()
        elif self._kept is None:
            self._kept = publish
            self._retry = self.create_timer(
                0.005, self._answer_kept, clock=Clock(clock_type=ClockType.STEADY_TIME)
            )
        else:
            raise LockstepBroken(
                f"{self.get_name()}: a second answer while {self._gate.waiting_for()} is awaited"
            )

    def _answer_kept(self) -> None:
        if self._kept is None or (self._gate is not None and self._gate.waiting_for()):
            return
        self._gate = None
        publish, self._kept = self._kept, None
        self.destroy_timer(self._retry)
        publish()

    def gate_waits_for(self) -> str:
        """Which reader is still missing, for /diagnostics; empty when all are matched."""
        return self._gate.waiting_for() if self._gate is not None else ""

    def busy(self) -> bool:
        """Asked after a stop was requested: whether there is something left to take in."""
        return False

    def close(self) -> None:
        """Called once before the node is destroyed, while ROS is still up."""

    def fail(self, text: str) -> None:
        """End this node with exit code 1 and one line."""
        self.get_logger().fatal(text)
        self.health.error("fault", text)
        self.health.publish()
        self.fault = text
        self.interrupt_spinning()
