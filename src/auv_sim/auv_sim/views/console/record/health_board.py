"""The health of a vehicle's nodes: what each reports, and how long ago."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

#: A node of which nothing was heard for this long is silent, s of wall time.
SILENT_AFTER = 2.0
OK, WARN, ERROR, SILENT = 0, 1, 2, 3
_UNHEARD = (None, SILENT, "not heard yet")


class NodeHealth(NamedTuple):
    """One node.

    Attributes:
        node: its name.
        age: since its last report, s; None if it was never heard.
        level: `OK`, `WARN`, `ERROR` or `SILENT`.
        message: of its last report.
    """

    node: str
    age: float | None
    level: int
    message: str


class HealthBoard:
    """Collects reports.

    Args:
        expected: nodes that are listed before they are heard.
    """

    def __init__(self, expected: Sequence[str]) -> None:
        self._reports: dict[str, tuple[float | None, int, str]] = dict.fromkeys(expected, _UNHEARD)

    @property
    def names(self) -> list[str]:
        """All nodes that are expected or were heard."""
        return list(self._reports)

    def hear(self, node: str, level: int, message: str, now: float) -> None:
        """Take a report at steady time `now`, s."""
        self._reports[node] = now, max(OK, min(level, SILENT)), message

    def of(self, node: str, now: float) -> NodeHealth:
        """Return the health of one node."""
        heard, level, message = self._reports.get(node, _UNHEARD)
        if heard is None:
            return NodeHealth(node, None, level, message)
        age = max(now - heard, 0.0)
        if age > SILENT_AFTER:
            return NodeHealth(node, age, SILENT, f"silent; its last report: {message}")
        return NodeHealth(node, age, level, message)

    def table(self, now: float) -> list[NodeHealth]:
        """Return the health of every node."""
        return [self.of(node, now) for node in self._reports]


def as_json(table: Sequence[NodeHealth]) -> list[dict[str, Any]]:
    """Return the table for the page; ages to 0.1 s."""
    return [{**row._asdict(), "age": None if row.age is None else round(row.age, 1)} for row in table]
