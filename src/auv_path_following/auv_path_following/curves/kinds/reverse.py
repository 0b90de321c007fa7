"""Any segment, followed the other way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from auv_path_following.curves.segment import PathPoint, Segment


class Reversed:
    """A segment from its end to its start.

    Args:
        segment: the segment to turn round.
    """

    def __init__(self, segment: Segment) -> None:
        self.segment: Final = segment
        self.kind: Final = segment.kind
        self.length: Final = segment.length

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        p = self.segment.evaluate(1.0 - t)
        return PathPoint(p.x, p.y, -p.dx, -p.dy, p.ddx, p.ddy)

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self.length - self.segment.length_to_go(1.0 - t)

    def row(self) -> list[float]:
        """The segment's, with its kind negated."""
        kind, *numbers = self.segment.row()
        return [-kind, *numbers]


def reversed_path(segments: Sequence[Segment]) -> list[Segment]:
    """The same way back: last segment first, each turned round."""
    return [Reversed(segment) for segment in reversed(segments)]
