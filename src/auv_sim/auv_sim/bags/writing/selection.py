"""The recorded topics and their QoS: the contract from the start, others as they appear."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.bags.writing.intake import PolledTopic
from auv_sim.bags.writing.qos_records import matching, qos_record
from auv_sim.sim_parameters import RecorderParameters

#: ROS's own topics that belong to every record.
LOG = Topic("/rosout", "rcl_interfaces/msg/Log", "every node", latched=True)
ROS_OWN = (
    LOG,
    Topic("/parameter_events", "rcl_interfaces/msg/ParameterEvent", "every node"),
)


class Selection:
    """The recorder's subscriptions.

    Args:
        node: the recorder.
        parameters: of the recorder.
        writer: receives a channel for each topic.
        keeps: returns which messages of a topic to record, None for all.

    Raises:
        ConfigurationError: no topics are selected.
    """

    def __init__(
        self, node: Node, parameters: RecorderParameters, writer: BagWriter,
        keeps: Callable[[str], Callable[[bytes], bool] | None],
    ) -> None:  # fmt: skip
        self._node = node
        self._keeps = keeps
        self._p = parameters
        self._writer = writer
        self._refused: set[str] = set()
        self._listed = {node.resolve_topic_name(name) for name in parameters.topics.split()}
        #: Whether further topics are looked for.
        self.seeks = bool(self._listed or parameters.regex or parameters.all_topics)
        self._promised: dict[str, QoSProfile] = {}
        self._has_own_clock = parameters.lockstep and parameters.shared_clock
        clock = topics.VEHICLE_CLOCK if self._has_own_clock else topics.CLOCK
        self._clock = node.resolve_topic_name(clock.name)
        self.topics: list[PolledTopic] = []
        if parameters.contract:
            spatial = topics.SPATIAL_CONTRACT if parameters.sternplanes else ()
            own_clock = (topics.VEHICLE_CLOCK,) if self._has_own_clock else ()
            for topic in (*own_clock, *topics.CONTRACT, *spatial, *ROS_OWN):
                self._follow_contract(topic)
        elif not self.seeks:
            raise ConfigurationError(
                f"{node.get_name()}: parameters",
                "no topics to record",
                "contract, topics, regex or all_topics",
            )

    def _follow_contract(self, topic: Topic) -> None:
        lockstep, name = self._p.lockstep, self._node.resolve_topic_name(topic.name)
        steps = lockstep and topic not in (topics.DIAGNOSTICS, *ROS_OWN)  # those are as deep as outside it
        promised = self._promised[name] = qos.offered(topic, steps)
        reliable = lockstep or topic.latched or topic.publisher != topics.PLANT
        requested = qos.requested(topic, reliable, qos.RECORDER_DEPTH)
        self._follow(name, topic.type, [promised], requested, lockstep)
        self.topics[-1].channel.latched = int(topic.latched and topic is not LOG)

    def _follow(self, name: str, type_name: str, offers: list[Any], requested: Any, fixed: bool) -> None:
        channel = self._writer.find(name)  # another recorder's, where several share a bag
        if channel is None:
            channel = self._writer.add_topic(name, type_name, [qos_record(offer) for offer in offers])
        self.topics.append(
            PolledTopic(self._node, name, type_name, requested, channel, fixed, name == self._clock)
        )
        self.topics[-1].keeps = self._keeps(name)

    def look_around(self) -> list[str]:
        """Subscribe to selected topics that have appeared, and adapt the QoS of those that are still silent.

        Returns:
            One line for each selected topic that cannot be recorded.
        """
        for topic in self.topics:
            if not topic.fixed and not topic.known:
                offers = self._offers(topic.name)
                requested = matching(offers, qos.RECORDER_DEPTH)
                if offers and _kind(requested) != _kind(topic.profile):
                    topic.resubscribe(requested)
            elif topic.known:
                topic.publishers = self._node.count_publishers(topic.name)
                if topic.channel.latched:
                    topic.channel.latched = max(1, topic.publishers)
        if not self.seeks:
            return []
        followed = {topic.name for topic in self.topics}
        troubles = []
        for name, types in self._node.get_topic_names_and_types():
            if name in followed or name in self._refused or not self._is_selected(name):
                continue
            offers = self._offers(name)
            if not offers:
                continue
            try:
                if len(types) > 1:
                    raise ConfigurationError(name, f"types {' and '.join(types)}", "one type")
                self._follow(name, types[0], offers, matching(offers, qos.RECORDER_DEPTH), False)
            except (ConfigurationError, ImportError, AttributeError) as error:
                self._refused.add(name)
                troubles.append(f"not recorded: {error}")
        return troubles

    def _is_selected(self, name: str) -> bool:
        if name in self._listed:
            return True
        if self._p.exclude and re.search(self._p.exclude, name):
            return False
        return self._p.all_topics or bool(self._p.regex and re.search(self._p.regex, name))

    def meet(self, topic: PolledTopic) -> None:
        """Process the first message of a topic: its publishers are now known."""
        topic.known = True
        offers = self._offers(topic.name)
        topic.publishers = max(1, len(offers))
        # Discovery has no depth of the history; the contract has.
        promised = self._promised.get(topic.name)
        described = [promised if promised and _kind(offer) == _kind(promised) else offer for offer in offers]
        # Log lines are transient local, too, but not a state with which a further file begins.
        if offers and topic.name != LOG.name and _is_latched(offers):
            topic.channel.latched = topic.publishers
        if described:
            self._writer.set_qos(topic.channel, [qos_record(offer) for offer in described])

    def _offers(self, name: str) -> list[Any]:
        return [info.qos_profile for info in self._node.get_publishers_info_by_topic(name)]

    def close(self) -> None:
        """End all subscriptions."""
        for topic in self.topics:
            topic.close()


def _is_latched(offers: list[Any]) -> bool:
    return bool(matching(offers, 1).durability == DurabilityPolicy.TRANSIENT_LOCAL)


def _kind(profile: Any) -> tuple[Any, Any]:
    return profile.reliability, profile.durability
