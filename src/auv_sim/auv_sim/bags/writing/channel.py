"""One recorded topic, as the writer sees it."""

from __future__ import annotations

from typing import Any

from mcap import records

#: The records that describe a topic in another file.
Original = tuple[records.Channel, records.Schema | None]


class Channel:
    """Handle of one recorded topic.

    Attributes:
        name, type: full topic name, ROS type.
        qos: of its publishers, as in metadata.yaml.
        original: its description in another file, where it was copied from one.
        number: in the present file; 0 until something is written.
        count: messages written to it.
        repeated: messages written once more at the beginning of a further file.
        latched: how many of the newest messages each file begins with: a late subscriber would still get
            one from each publisher of a transient-local topic. 0 for other topics.
    """

    __slots__ = ("_newest", "count", "latched", "name", "number", "original", "qos", "repeated", "type")

    def __init__(self, name: str, type_name: str, qos: list[Any], original: Original | None = None) -> None:
        self.name = name
        self.type = type_name
        self.qos = qos
        self.original = original
        self.number = self.count = self.repeated = self.latched = 0
        self._newest: list[tuple[int, int, bytes]] = []

    def keep(self, sequence: int, publish_time_ns: int, cdr: bytes) -> None:
        """Keep a message for further files."""
        self._newest.append((sequence, publish_time_ns, cdr))
        del self._newest[: -self.latched]

    @property
    def kept(self) -> list[tuple[int, int, bytes]]:
        """Messages with which every further file begins: sequence, publish time (ns), message."""
        return self._newest if self.latched else []
