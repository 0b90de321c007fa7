"""The newest messages beside the odometry of a free run: the vehicle waits for none of them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from auv_msgs_py.contract.stamps import StampGuard, StampVerdict
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import MessageRefused


class NewestValues:
    """Keeps the newest value of each topic with its stamp.

    Args:
        topics: those that are kept.
    """

    def __init__(self, topics: Iterable[Topic]) -> None:
        self._guards = {topic: StampGuard() for topic in topics}
        self._values: dict[Topic, tuple[Any, int]] = {}
        self._first: int | None = None

    def reset(self) -> None:
        """Drop everything: time went back."""
        self._values.clear()
        self._first = None
        for guard in self._guards.values():
            guard.reset()

    def put(self, topic: Topic, value: Any, stamp: int) -> None:
        """Keep a value; `stamp` in ns.

        Raises:
            MessageRefused: a newer message has overtaken it.
        """
        if self._guards[topic].judge(stamp).verdict is StampVerdict.REFUSE:
            raise MessageRefused(topic.name, "a stamp that is not newer than the last", "rising stamps")
        self._values[topic] = value, stamp

    def begin(self, stamp: int) -> None:
        """Take the stamp of an odometry, ns; the first one counts."""
        if self._first is None:
            self._first = stamp

    def at(self, topic: Topic, stamp: int) -> tuple[Any | None, float]:
        """Return the newest value and its age, s, at the odometry of a stamp (ns).

        What has never come is None, and as old as the first odometry: at the start none is late.
        """
        value, at = self._values.get(topic, (None, self._first if self._first is not None else stamp))
        return value, (stamp - at) * 1e-9
