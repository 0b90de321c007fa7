"""The topics of one vehicle, polled; all queues but that of the state hold one message."""

from __future__ import annotations

import contextlib
import hashlib
from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.private_rclpy import take_polled
from auv_msgs_py.node.transport import decoder
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.nodes.console.course_reader import CourseReader
from auv_sim.nodes.console.readings_of_topics import Reader, TopicReader
from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.vehicle_record import VehicleRecord

#: After a silence of this long another publisher may be there, s.
_SILENCE = 2.0
#: Queues that hold more than the newest message: a new state counts when it was heard twice.
_DEPTHS = {topics.MISSION_STATE: qos.DEPTH}
#: Odometries that are left out while the graph does not show their publisher.
_MOST_LOOKS = 40


class PolledReader:
    """A subscription without a callback.

    Args:
        node: of the console.
        topic: to hear.
        name: its full name.
        depth: of the queue.
    """

    def __init__(self, node: Node, topic: Topic, name: str, depth: int = 1) -> None:
        self._kind = qos.message_class(topic.type)
        profile = qos.requested(topic, reliable=False, depth=depth)
        subscription = node.create_subscription(self._kind, name, _ignore, profile, raw=True)
        self._take = take_polled(node, subscription)
        self._decode = decoder(topic)
        self._subscription = subscription  # it lives as long as its reader

    def take(self) -> Any | None:
        """Return the next message; None if there is none.

        Raises:
            MessageRefused: its bytes do not decode.
        """
        taken = self._take(self._kind, True)
        return None if taken is None else self._decode(taken[0])


def _ignore(_: bytes) -> None:
    """Stand in for the callback that `create_subscription` asks for."""


class VehicleFeed:
    """Hears one vehicle.

    Args:
        node: of the console.
        record: of the vehicle.
        domain: ROS domain, part of the track's owner.
        clock: returns steady time, s.
        faults: logs what fails.
    """

    def __init__(
        self, node: Node, record: VehicleRecord, domain: int, clock: Callable[[], float], faults: FaultLog
    ) -> None:  # fmt: skip
        self.record = record
        self._node, self._domain, self._clock, self._faults = node, domain, clock, faults
        self._reader = TopicReader(record, FrameTable(FrameIds()), clock)
        self.course = CourseReader(record)
        readers = {**self.course.readers(), **self._reader.readers()}
        self._polled: list[tuple[Topic, PolledReader, Reader]] = [
            (topic, self._polled_reader(topic), read) for topic, read in readers.items()
        ]
        self._publisher = ""
        self._heard_at, self._sought = 0.0, 0

    def _polled_reader(self, topic: Topic) -> PolledReader:
        name = topics.full_name(self.record.namespace, topic.name)
        return PolledReader(self._node, topic, name, _DEPTHS.get(topic, 1))

    def poll(self) -> None:
        """Take what has arrived."""
        for topic, polled, read in self._polled:
            for _ in range(_DEPTHS.get(topic, 1)):
                with self._faults.guard(f"{self.record.namespace} {topic.name}"):
                    if not self._take(topic, polled, read):
                        break
        with self._faults.guard(f"{self.record.namespace} state"):
            self._reader.look()

    def _take(self, topic: Topic, polled: PolledReader, read: Reader) -> bool:
        """Read the next message of a topic; return whether there was one."""
        with contextlib.suppress(MessageRefused):  # the control chain reports it
            message = polled.take()
            if message is None:
                return False
            if topic is not topics.ODOM or self._is_identified():
                read(message)
        return True

    def _is_identified(self) -> bool:
        """Return whether an odometry counts: its publisher is known, or was sought for long enough.

        It is looked up at the first odometry and after a silence, because the track belongs to it.
        """
        now = self._clock()
        is_known, self._heard_at = self._publisher and now - self._heard_at < _SILENCE, now
        if is_known:
            return True
        name = topics.full_name(self.record.namespace, topics.ODOM.name)
        found = self._node.get_publishers_info_by_topic(name)
        if not found:  # the graph lags behind the message
            self._sought += 1
            return bool(self._publisher) or self._sought > _MOST_LOOKS
        identity = "|".join(sorted(bytes(info.endpoint_gid).hex() for info in found))
        publisher = hashlib.sha256(identity.encode()).hexdigest()
        if publisher != self._publisher:
            self._publisher = publisher
            self.record.belongs_to(f"{self._domain} {self.record.namespace} {publisher}")
        return True
