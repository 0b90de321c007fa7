"""Nobody publishes in lockstep before all of his readers are matched."""

from __future__ import annotations

from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSCompatibility, qos_check_compatible

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic

_READS = " to subscribe to "


class LockstepGate:
    """Open once every publisher of a node is matched with every reader that must not miss a message.

    A reader counts when the graph shows it by name. The publisher's own count of matched readers must
    reach the number of compatible readers in the graph, so that a third party's subscription cannot stand
    in for a missing one. Once a reliable writer has matched a reader it keeps every message for it until
    it is acknowledged; so nothing published through an open gate can be lost.

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
        """Who is missing, for people; empty when the gate is open."""
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
        """Whether a `waiting_for` is about a reader that is not there, not about a message."""
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
