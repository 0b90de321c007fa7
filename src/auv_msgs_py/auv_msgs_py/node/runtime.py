"""The base class of every node; `run` has the loop that runs nodes."""

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
from auv_msgs_py.node.lockstep_gate import LockstepAnswers, LockstepGate
from auv_msgs_py.node.private_rclpy import stop_reading_clock
from auv_msgs_py.node.transport import WirePublisher, decoder, generated_decoder
from auv_msgs_py.node.watch import ClockWatch, RateWatch, second_publishers
from auv_msgs_py.values.errors import LockstepBroken, MessageRefused


class SuiteNode(Node):  # type: ignore[misc]
    """A node with declared settings, contract topics, time and health.

    Subclasses override `configure`, `validate`, `report`, `waiting_for`, `claim`, `busy` and `close`.

    Args:
        name: the node's name.
        parameters: its settings class, which has `lockstep`, `recorded` and `flood_rate`.
        arguments: passed on to `rclpy.node.Node` (namespace, cli_args, ...).
    """

    def __init__(self, name: str, parameters: type[Any], **arguments: Any) -> None:
        self._stamp: int | None = None
        #: Names of the subscribed topics that have one publisher by contract.
        self._heard: list[str] = []
        super().__init__(name, **arguments)
        self._steady_to_ros = float(self.get_clock().now().nanoseconds) * 1e-9 - time.monotonic()
        self.parameters: Any = params.declare(
            self, parameters, self._changed, self.validate, arguments.get("cli_args") or sys.argv
        )
        self.publishers_by_topic: dict[Topic, Publisher] = {}
        self.fault = ""
        self.finished = False
        #: Set by `spin`: makes it check `fault` and `finished` at once.
        self.interrupt_spinning: Callable[[], None] = lambda: None
        self._answers = LockstepAnswers(self)
        self._rates = RateWatch(self.parameters.flood_rate)
        self._clock_watch = ClockWatch()
        self.health = Health(self, self.report, self.waiting_for, self._look)
        if self.parameters.lockstep:
            # Time stands still between two odometries, whose stamps equal /clock: `listen` takes the time
            # from them. A reader of /clock in every node costs a fifth of a step's processor time.
            stop_reading_clock(self)

    def report(self) -> dict[str, Any]:
        """Return further values for /diagnostics."""
        return {}

    def waiting_for(self) -> str:
        """Return the topics that the current step lacks, for /diagnostics."""
        return ""

    def claim(self) -> Claim | None:
        """Return what a simulator claims in the graph; None for every other node."""
        return None

    def configure(self) -> None:
        """Apply `self.parameters` after a change in flight."""

    def validate(self, proposed: Any) -> None:
        """Check parameters before a change in flight; a `ConfigurationError` refuses them."""

    def _changed(self, parameters: Any) -> None:
        self.parameters = parameters
        self.configure()

    def advertise(self, topic: Topic) -> Publisher:
        """Create the contract's publisher of a topic; it takes light messages and generated ones."""
        profile = qos.offered(topic, self.parameters.lockstep)
        publisher = self.create_publisher(
            qos.message_class(topic.type), topic.name, profile, publisher_class=WirePublisher
        )
        self.publishers_by_topic[topic] = publisher
        return publisher

    def listen(self, topic: Topic, callback: Callable[[Any], None], raw: bool = False) -> None:
        """Create the contract's subscription to a topic; a refused message is counted and reported.

        A message of a type in `wire` arrives as its light class, the same object each time: do not keep it.
        With `raw` the callback gets the bytes of the message.
        """
        decode: Callable[[bytes], Any] = bytes if raw else decoder(topic)
        if topic is not topics.DIAGNOSTICS:  # every node publishes that
            self._heard.append(topic.name)
        sets_time = topic is topics.ODOM and self.parameters.lockstep
        name, rates = topic.name, self._rates

        def guarded(data: bytes) -> None:
            rates.counts[name] += 1
            try:
                message = decode(data)
                if sets_time:
                    self.time_is(stamp_of(message.header.stamp, name))
                callback(message)
            except MessageRefused as error:
                self.health.refuse(error)
            except LockstepBroken as error:
                self.fail(str(error))

        profile = qos.requested(topic, self.parameters.lockstep)
        self.create_subscription(qos.message_class(topic.type), name, guarded, profile, raw=True)

    def create_subscription(self, kind: Any, name: str, callback: Any, *arguments: Any, **named: Any) -> Any:
        """Create a subscription as rclpy does; messages on /clock are checked before rclpy sets the clock."""
        if name == topics.CLOCK.name and not named.get("raw"):
            self._heard.append(name)
            return super().create_subscription(
                kind, name, _checked_clock(self, callback), *arguments, raw=True, **named
            )
        return super().create_subscription(kind, name, callback, *arguments, **named)

    def _look(self) -> None:
        """Set the conditions that no single message shows."""
        self.health.warn("publishers", second_publishers(self, self._heard))
        if self.parameters.lockstep:
            return
        now = self.now()
        still = self._clock_watch.stands_still(now, time.monotonic())
        self.health.error("clock", "the clock stands still: is the simulator dead?" if still else "")
        self.health.warn("flood", self._rates.warning(now))

    def now(self) -> float:
        """Return the time for watchdogs, s: simulated time where there is one, else a steady clock.

        The system clock steps when GPS or a network sets it, which must not count as lateness.
        """
        if self._stamp is not None:
            return self._stamp * 1e-9
        clock = self.get_clock()
        if clock.ros_time_is_active:
            return float(clock.now().nanoseconds) * 1e-9
        return self._steady_to_ros + time.monotonic()

    def every(self, period: float, callback: Callable[[], None]) -> None:
        """Call back every `period` s of the time of `now`: setting the system clock delays no watchdog."""
        simulated = self.get_clock().ros_time_is_active
        self.create_timer(
            period, callback, clock=None if simulated else Clock(clock_type=ClockType.STEADY_TIME)
        )

    def time_is(self, stamp: int) -> None:
        """Set the time in lockstep, ns: the last stamp of /clock."""
        if self.parameters.lockstep:
            self._stamp = stamp

    def get_clock(self) -> Clock:
        """Return the node's clock; in lockstep this call sets it."""
        clock = super().get_clock()
        if self._stamp is not None:
            clock.set_ros_time_override(Time(nanoseconds=self._stamp, clock_type=ClockType.ROS_TIME))
        return clock

    def close_gate(self) -> None:
        """In lockstep let `answer` wait for all readers; call once, after the last `advertise`."""
        if self.parameters.lockstep:
            gate = LockstepGate(self, dict(self.publishers_by_topic), self.parameters.recorded)
            self._answers.wait_for(gate)

    def answer(self, publish: Callable[[], None]) -> None:
        """Publish now, or in lockstep as soon as every reader is matched. One step is under way at a time.

        Raises:
            LockstepBroken: the answer to an earlier step is still waiting.
        """
        self._answers.answer(publish)

    def gate_waits_for(self) -> str:
        """Return which reader is missing, for /diagnostics; empty when all are matched."""
        return self._answers.waiting_for()

    def busy(self) -> bool:
        """Return whether messages are left to handle after a stop was requested; called again and again."""
        return False

    def close(self) -> None:
        """Clean up; called once before the node is destroyed, while ROS is still up."""

    def fail(self, text: str) -> None:
        """End this node with exit code 1 and one line."""
        self.get_logger().fatal(text)
        self.health.error("fault", text)
        self.health.publish()
        self.fault = text
        self.interrupt_spinning()


def _checked_clock(node: SuiteNode, set_clock: Callable[[Any], None]) -> Callable[[bytes], None]:
    """Return the callback for the bytes of /clock: it refuses a stamp that is none."""
    decode = generated_decoder(topics.CLOCK)

    def checked(data: bytes) -> None:
        try:
            message = decode(data)
            stamp_of(message.clock, topics.CLOCK.name)
            set_clock(message)
        except MessageRefused as error:
            node.health.refuse(error)

    return checked
