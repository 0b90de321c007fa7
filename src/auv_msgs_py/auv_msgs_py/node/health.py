"""A node's report about itself in /diagnostics."""

from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import MessageRefused

_OK, _WARN, _ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
#: Time for which a refused message keeps the status at WARN, s of wall time.
_MEMORY = 5.0
#: Numbers in a refusal, which may differ within a kind.
_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")
#: Shortest time between two reports of changes, s of wall time.
_SHORTEST = 0.1

#: Longest text of a report, characters.
_LONGEST = 1000


class Refusals:
    """Counts of refused messages by topic, and the latest of them."""

    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()
        self._kinds: set[tuple[str, str]] = set()
        self._last = ""
        self._last_at = float("-inf")

    def add(self, error: MessageRefused) -> bool:
        """Count a refusal; return whether it is the first of its kind.

        Refusals on one topic that expected the same, whatever the numbers, are of one kind.
        """
        self.counts[error.topic] += 1
        self._last, self._last_at = str(error), time.monotonic()
        kind = error.topic, _NUMBER.sub("#", error.expected)
        is_first = kind not in self._kinds
        self._kinds.add(kind)
        return is_first

    @property
    def latest(self) -> str:
        """The latest refusal, for `_MEMORY` s; empty otherwise."""
        return self._last if time.monotonic() - self._last_at < _MEMORY else ""


class Health:
    """Publish a status every `period` s of wall time, and changes at once.

    Wall time, because a report must also come when the ROS clock stands still.

    Args:
        node: the node that reports.
        values: called for each report; returns further key-value pairs.
        waiting_for: called for each report; returns the topics that a step waits for ("" if none).
        look: called before each regular report, to set conditions.
        period: of regular reports, s of wall time.
    """

    #: Key of the latest refusal in a report.
    REFUSED = "condition refused"

    def __init__(
        self,
        node: Node,
        values: Callable[[], dict[str, Any]] = dict,
        waiting_for: Callable[[], str] = str,
        look: Callable[[], None] = lambda: None,
        period: float = 0.5,
    ) -> None:
        self._node = node
        self._values = values
        self._waiting_for = waiting_for
        self._look = look
        self.refusals = Refusals()
        #: Count of refused messages by topic.
        self.refused = self.refusals.counts
        self._reported_at = float("-inf")
        self._condition: dict[str, tuple[bytes, str]] = {}
        self._publisher = node.create_publisher(
            DiagnosticArray, topics.DIAGNOSTICS.name, qos.offered(topics.DIAGNOSTICS)
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(period, self._report, clock=steady)
        self._held_back = node.create_timer(_SHORTEST, self._publish_held_back, clock=steady)
        self._held_back.cancel()

    def refuse(self, error: MessageRefused) -> None:
        """Count a refused message; the first of its kind is logged, the count is in every report."""
        if self.refusals.add(error):
            self._node.get_logger().error(f"refused: {error}")
        self._publish_soon()

    def expect(self, name: str, text: str) -> None:
        """Set a condition at WARN that is normal at the start: it is in every report, but not in the log."""
        self._condition[name] = (_WARN, text)

    def warn(self, name: str, text: str) -> None:
        """Set or (with an empty text) clear a lasting condition; a new one is logged."""
        self._set(name, _WARN, text)

    def error(self, name: str, text: str, log: bool = True) -> None:
        """Set or clear a condition as `warn` does, one level higher; log it if `log`."""
        self._set(name, _ERROR, text, log)

    def _set(self, name: str, level: bytes, text: str, log: bool = True) -> None:
        if not text:
            self._condition.pop(name, None)
            return
        known = self._condition.get(name)
        if known == (level, text):
            return
        self._condition[name] = (level, text)
        if known is not None:
            self._publish_soon()
            return
        if log:
            self._node.get_logger().warning(text)
        self.publish()

    def _publish_soon(self) -> None:
        """Publish a change, at most once in `_SHORTEST` s; a new condition is published at once by `_set`."""
        if time.monotonic() - self._reported_at > _SHORTEST:
            self.publish()
        elif self._held_back.is_canceled():
            self._held_back.reset()

    def _publish_held_back(self) -> None:
        self._held_back.cancel()
        self.publish()

    def _report(self) -> None:
        self._look()
        self.publish()

    def publish(self) -> None:
        """Send one report."""
        level, message = _OK, "ok"
        self._reported_at = time.monotonic()
        refusal = self.refusals.latest
        if refusal:
            level, message = _WARN, f"refused: {refusal}"
        for condition_level, text in self._condition.values():
            if condition_level > level:
                level, message = condition_level, text
        values = {"waiting_for": self._waiting_for(), **self._values()}
        if refusal:
            values[self.REFUSED] = refusal
        values |= {f"condition {name}": text for name, (_, text) in self._condition.items()}
        values |= {f"refused {topic}": count for topic, count in self.refusals.counts.items()}
        status = DiagnosticStatus(
            level=level,
            name=self._node.get_fully_qualified_name(),
            message=message[:_LONGEST],
            hardware_id=self._node.get_name(),
            values=[KeyValue(key=key, value=str(value)[:_LONGEST]) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(array)
