"""The floor under a lockstep step: the suite's processes, topics, QoS and messages, with empty callbacks.

It measures what ROS 2 itself needs to carry one step's messages around the loop. It is built from the table
of topics alone, without the suite's nodes: each node sends messages filled beforehand as soon as it has
counted all inputs of a step.

There are two. The floor carries bytes, as the suite does. The plain floor is what rclpy nodes usually are:
typed messages, `use_sim_time` with its reader of /clock in every node, a return to Python for every message.
"""

from __future__ import annotations

import argparse
import math
import signal
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from rclpy.clock import Clock, ClockType
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from std_msgs.msg import String, UInt64
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.lockstep_gate import LockstepGate
from auv_msgs_py.node.private_rclpy import take_polled
from auv_sim.checks.benchmark.measures.stopwatch import Stopwatch

NAMESPACE = "/auv"
#: Sent once a step, in the order of the table.
STEP = (topics.CLOCK, *topics.PER_STEP)
#: Period at which a recorder fetches messages without a request, s.
_POLL = 0.02


def filled(topic: Topic) -> Any:
    """Return a message of the size that the suite sends: with the names of its frames."""
    message = qos.message_class(topic.type)()
    if hasattr(message, "header"):
        message.header.frame_id = "map"
    if hasattr(message, "child_frame_id"):
        message.child_frame_id = "base_link"
    return message


class FloorNode(Node):  # type: ignore[misc]
    """Publishes its topics of a step when it has counted the step's inputs.

    Args:
        name: one of the suite's nodes.
        steps: how many steps the simulator takes.
        recorded: whether a recorder takes part.
        plain: typed messages, and a reader of /clock.
    """

    def __init__(self, name: str, steps: int, recorded: bool, plain: bool) -> None:
        timed = [Parameter("use_sim_time", value=plain)]
        super().__init__(name, namespace=NAMESPACE, parameter_overrides=timed, use_global_arguments=False)
        self._leads = name == topics.PLANT
        self._raw = not plain
        by_topic = {topic: self._advertise(topic) for topic in STEP if topic.publisher == name}
        self._outputs = [
            (publisher, filled(topic) if plain else serialize_message(filled(topic)))
            for topic, publisher in by_topic.items()
        ]
        inputs = [topic for topic in STEP if name in topic.subscribers]
        self._needed, self._come = len(inputs), 0
        self._recorded_steps = 0
        self._running = self._begun = False
        self._waiting = True
        self._lead = topics.RECORDING_LEAD if recorded else math.inf
        self._stopwatch = Stopwatch(steps) if self._leads else None
        if name == topics.GUIDANCE:
            self._state = by_topic[topics.MISSION_STATE] = self._advertise(topics.MISSION_STATE)
            self.create_service(Trigger, topics.START_SERVICE, self._on_start)
        self._request = None
        if self._leads and recorded:
            self._request = by_topic[topics.RECORD_REQUEST] = self._advertise(topics.RECORD_REQUEST)
        self._gate = LockstepGate(self, by_topic, recorded)
        for topic in inputs:
            self._listen(topic, self._on_input)
        if name in topics.MISSION_STATE.subscribers:
            self._listen(topics.MISSION_STATE, self._on_state)
        if self._leads and recorded:
            self._listen(topics.RECORDED_STEPS, self._on_recorded)

    def _advertise(self, topic: Topic) -> Any:
        return self.create_publisher(
            qos.message_class(topic.type), topic.name, qos.offered(topic, lockstep=True)
        )

    def _listen(self, topic: Topic, callback: Callable[[Any], None]) -> None:
        kind = qos.message_class(topic.type)
        raw = self._raw and topic in STEP
        self.create_subscription(kind, topic.name, callback, qos.requested(topic, reliable=True), raw=raw)

    def _on_start(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._state.publish(String(data="running"))
        response.success = True
        return response

    def _on_state(self, _: String) -> None:
        self._running = True
        self._proceed()

    def _on_recorded(self, message: UInt64) -> None:
        self._recorded_steps = message.data
        self._proceed()

    def _on_input(self, _: Any) -> None:
        self._come += 1
        if self._come < self._needed:
            return
        self._come = 0
        if self._leads:
            self._waiting = True
            self._proceed()
        else:
            self._publish()

    def _proceed(self) -> None:
        """As the simulator, take the next step when the last is answered and the recorder is near."""
        watch = self._stopwatch
        if watch is None or not (self._running and self._waiting) or watch.finished:
            return
        if watch.steps - self._recorded_steps < self._lead:
            self._waiting = False
            watch.step()
            self._publish()
            if self._request is not None and watch.steps % topics.RECORDING_REQUEST == 0:
                self._request.publish(UInt64(data=watch.steps))

    def _publish(self) -> None:
        while not self._begun and self._gate.waiting_for():
            time.sleep(0.005)
        self._begun = True
        for publisher, message in self._outputs:
            publisher.publish(message)


class FloorRecorder(Node):  # type: ignore[misc]
    """Fetches every message of the contract raw, on request as the recorder does, and only counts it."""

    def __init__(self) -> None:
        super().__init__(topics.RECORDER, namespace=NAMESPACE, use_global_arguments=False)
        self._counts: dict[str, int] = {}
        self._takes = [self._subscribe(topic) for topic in topics.CONTRACT]
        self._per_step = [topic.name for topic in topics.PER_STEP]
        self._reported = 0
        self._progress = self.create_publisher(
            UInt64, topics.RECORDED_STEPS.name, qos.offered(topics.RECORDED_STEPS)
        )
        request = topics.RECORD_REQUEST
        profile = qos.requested(request, reliable=True)
        self.create_subscription(UInt64, request.name, lambda _: self._poll(), profile)
        self.create_timer(_POLL, self._poll, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _subscribe(self, topic: Topic) -> tuple[str, Any, Any]:
        kind = qos.message_class(topic.type)
        profile = qos.requested(topic, reliable=True, depth=qos.RECORDER_DEPTH)
        subscription = self.create_subscription(kind, topic.name, lambda _: None, profile, raw=True)
        self._counts[topic.name] = 0
        return topic.name, kind, take_polled(self, subscription)

    def _poll(self) -> None:
        for name, kind, take in self._takes:
            while take(kind, True) is not None:
                self._counts[name] += 1
        steps = min(self._counts[name] for name in self._per_step)
        if steps - self._reported >= topics.RECORDING_REPORT:
            self._reported = steps
            self._progress.publish(UInt64(data=steps))


def main(argv: Sequence[str] | None = None) -> int:
    """Run the named nodes of the floor in this process until a signal."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("nodes", nargs="+")
    parser.add_argument("--steps", type=int, required=True)
    parser.add_argument("--recorded", action="store_true")
    parser.add_argument("--plain", action="store_true")
    options = parser.parse_args(argv)
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    stop = threading.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: stop.set())
    executor = EventsExecutor()
    nodes = [
        FloorRecorder()
        if name == topics.RECORDER
        else FloorNode(name, options.steps, options.recorded, options.plain)
        for name in options.nodes
    ]
    for node in nodes:
        executor.add_node(node)
    while not stop.is_set():
        if options.plain:
            executor.spin_once(timeout_sec=0.1)
        else:
            executor.spin_until_future_complete(Future(), timeout_sec=0.1)
    for node in nodes:
        node.destroy_node()
    rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
