"""In lockstep a node publishes only after all readers of its topics are matched."""

from __future__ import annotations

from collections.abc import Callable

from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSCompatibility, qos_check_compatible

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import LockstepBroken

_READS = " to subscribe to "
#: Period at which a kept answer looks at the gate, s of wall time.
_RETRY = 0.005


class LockstepGate:
    """Open once every publisher of a node is matched with every reader that must not miss a message.

    A reader counts when the graph shows it by name. The publisher's own count of matched readers must
    reach the number of compatible readers in the graph, so that a third party's subscription cannot stand
    in for a missing one. Once a reliable writer has matched a reader it keeps its last messages
    (`topics.RECORDING_LEAD`) for it until they are acknowledged, also if the reader matches the writer
    later. As no more are under way, nothing published through an open gate is lost.

    Args:
        node: the node that publishes.
        publishers: its topics.
        recorded: whether a recorder takes part.
    """

    def __init__(self, node: Node, publishers: dict[Topic, Publisher], recorded: bool) -> None:
        self._node = node
        self._publishers = publishers
        self._recorded = recorded
        self._open = False

    def waiting_for(self) -> str:
        """Return which reader is missing, as a text; empty when the gate is open."""
        if self._open:
            return ""
        for topic, publisher in self._publishers.items():
            missing = self._missing(topic, publisher)
            if missing:
                return f"{missing}{_READS}{topic.name}"
        self._open = True
        return ""

    @staticmethod
    def lacks_reader(text: str) -> bool:
        """Return whether a `waiting_for` is about a missing reader, not about a message."""
        return _READS in text

    def _missing(self, topic: Topic, publisher: Publisher) -> str:
        needed = set(topic.subscribers) | ({topics.RECORDER} if self._recorded else set())
        if topic is topics.RECORDED_STEPS:
            needed.discard(topics.RECORDER)
        present, compatible = set(), 0
        namespace = self._node.get_namespace()
        for info in self._node.get_subscriptions_info_by_topic(publisher.topic_name):
            verdict, _ = qos_check_compatible(qos.offered(topic), info.qos_profile)
            if verdict is QoSCompatibility.ERROR:
                continue
            compatible += 1
            if info.node_namespace == namespace:
                present.add(info.node_name)
        if needed - present:
            return ", ".join(sorted(needed - present))
        return "" if publisher.get_subscription_count() >= compatible else "a reader"


class LockstepAnswers:
    """Keep a node's answer until its gate is open; afterwards, and without a gate, publish at once.

    Args:
        node: the node that answers; its timer looks at the gate.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._gate: LockstepGate | None = None
        self._kept: Callable[[], None] | None = None

    def wait_for(self, gate: LockstepGate) -> None:
        """Keep answers until this gate is open."""
        self._gate = gate

    def waiting_for(self) -> str:
        """Return which reader is missing, as a text; empty when all are matched."""
        return self._gate.waiting_for() if self._gate is not None else ""

    def answer(self, publish: Callable[[], None]) -> None:
        """Publish now, or as soon as the gate is open.

        Raises:
            LockstepBroken: an earlier answer is still kept: one step is under way at a time.
        """
        if self._gate is None:
            publish()
        elif not self._gate.waiting_for():
            self._gate = None
            publish()
        elif self._kept is None:
            self._kept = publish
            steady = Clock(clock_type=ClockType.STEADY_TIME)
            self._retry = self._node.create_timer(_RETRY, self._answer_kept, clock=steady)
        else:
            raise LockstepBroken(
                f"{self._node.get_name()}: a second answer while {self._gate.waiting_for()} is awaited"
            )

    def _answer_kept(self) -> None:
        if self._kept is None or (self._gate is not None and self._gate.waiting_for()):
            return
        self._gate = None
        publish, self._kept = self._kept, None
        self._node.destroy_timer(self._retry)
        publish()
