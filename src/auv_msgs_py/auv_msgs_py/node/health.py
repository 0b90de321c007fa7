"""What a node tells about itself in /diagnostics."""

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
#: How long a refused message keeps the status at WARN, s of wall time.
_MEMORY = 5.0
#: What may differ from one refusal to the next of its kind.
_NUMBER = re.compile(r"[-+]?\d+(\.\d+)?(e[-+]?\d+)?")
#: News are told at once, or when so much has passed since the last report, s of wall time.
_NEWS = 0.1

#: Longest text of a report, characters.
_LONGEST = 1000


class Health:
    """Counts what was refused; publishes a status twice a second of wall time, and news at once.

    Wall time, because a health report must also come when the ROS clock stands still.

    Args:
        node: the node that reports.
        values: called for each report; further key-value pairs.
        waiting_for: called for each report; topics a step waits for ("" if none).
        look: called before each regular report, to set conditions.
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
        self.refused: Counter[str] = Counter()
        self._kinds: set[tuple[str, str]] = set()
        self._last_refusal = ""
        self._last_refusal_at = float("-inf")
        self._reported_at = float("-inf")
        self._condition: dict[str, tuple[bytes, str]] = {}
        self._publisher = node.create_publisher(
            DiagnosticArray, topics.DIAGNOSTICS.name, qos.offered(topics.DIAGNOSTICS)
        )
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = node.create_timer(period, self._report, clock=steady)
        self._kept_back = node.create_timer(_NEWS, self._tell_kept_back, clock=steady)
        self._kept_back.cancel()

    @property
    def last_refusal(self) -> str:
        """What was refused lately; empty when nothing was."""
        return self._last_refusal if time.monotonic() - self._last_refusal_at < _MEMORY else ""

    def refuse(self, error: MessageRefused) -> None:
        """Count a refused message; its kind is logged once, its number is in every report.

        Of one kind are refusals on one topic that expected the same, whatever the numbers.
        """
        self.refused[error.topic] += 1
        text = str(error)
        kind = error.topic, _NUMBER.sub("#", error.expected)
        if kind not in self._kinds:
            self._kinds.add(kind)
            self._node.get_logger().error(f"refused: {text}")
        self._last_refusal, self._last_refusal_at = text, time.monotonic()
        self._news()

    def expect(self, name: str, text: str) -> None:
        """Set a condition at WARN that is normal at the start: it is in every report, but not in the log."""
        self._condition[name] = (_WARN, text)

    def warn(self, name: str, text: str) -> None:
        """Set or (with an empty text) clear a lasting condition; a new one is logged."""
        self._set(name, _WARN, text)

    def error(self, name: str, text: str, log: bool = True) -> None:
        """As `warn`, one level higher; `log`: False where the caller has his own words for the log."""
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
            self._news()
            return
        if log:
            self._node.get_logger().warning(text)
        self.publish()

    def _news(self) -> None:
        """What has changed, but not more often than anybody can read; a new condition is never kept back."""
        if time.monotonic() - self._reported_at > _NEWS:
            self.publish()
        elif self._kept_back.is_canceled():
            self._kept_back.reset()

    def _tell_kept_back(self) -> None:
        self._kept_back.cancel()
        self.publish()

    def _report(self) -> None:
        self._look()
        self.publish()

    def publish(self) -> None:
        """Send one report."""
        level, message = _OK, "ok"
        self._reported_at = time.monotonic()
        refusal = self.last_refusal
        if refusal:
            level, message = _WARN, f"refused: {refusal}"
        for condition_level, text in self._condition.values():
            if condition_level > level:
                level, message = condition_level, text
        values = {"waiting_for": self._waiting_for(), **self._values()}
        if refusal:
            values[self.REFUSED] = refusal
        values |= {f"condition {name}": text for name, (_, text) in self._condition.items()}
        values |= {f"refused {topic}": count for topic, count in self.refused.items()}
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
