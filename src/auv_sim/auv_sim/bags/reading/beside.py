"""The messages of another topic that belong to an odometry, as a node pairs them."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract.conversions import nanoseconds
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.load import messages_of
from auv_sim.bags.reading.recording import RecordedTopic


class Beside:
    """A topic beside the odometry: its message of the same stamp in lockstep, else the newest.

    Args:
        topic: the topic; None where it was not recorded.
        lockstep: whether the recording is one of lockstep.
        timeout: a message farther from the odometry's stamp counts as none, s.

    Attributes:
        topic: the same.
    """

    def __init__(self, topic: RecordedTopic | None, lockstep: bool, timeout: float) -> None:
        self.topic, self._lockstep, self._bound = topic, lockstep, timeout * 1e9
        self._by_stamp: dict[int, Any] = {}
        self._newest: Any | None = None
        if topic is not None and lockstep:
            self._by_stamp = {nanoseconds(message.header.stamp): message for _, message in messages_of(topic)}
        self._decode = deserializer(topic) if topic is not None else None

    def take(self, data: bytes | None) -> None:
        """Take the next message of the topic."""
        if data is not None and self._decode is not None and not self._lockstep:
            self._newest = self._decode(data)

    def at(self, stamp: int) -> Any | None:
        """Return the message that belongs to an odometry's stamp (ns)."""
        found = self._by_stamp.get(stamp) if self._lockstep else self._newest
        if found is not None and abs(stamp - nanoseconds(found.header.stamp)) > self._bound:
            return None
        return found
