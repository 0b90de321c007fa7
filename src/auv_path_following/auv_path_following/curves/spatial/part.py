"""A part of a segment as a segment of its own."""

from __future__ import annotations

import itertools
from typing import Any, Final

from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.rows import ARC, CUBIC, CUBIC_WIDTH, LINE, SPIRAL
from auv_path_following.curves.segment import PathPoint, Segment


class Part:
    """A segment from one place on it to another, over t in [0, 1].

    Args:
        segment: the whole.
        begin, end: where the part begins and ends on it, 0 <= begin < end <= 1.
    """

    def __init__(self, segment: Segment, begin: float, end: float) -> None:
        self.segment: Final = segment
        self.begin: Final = begin
        self.end: Final = end
        self.kind: Final = segment.kind
        self._width: Final = end - begin
        self._to_go_after: Final = segment.length_to_go(end)
        self.length: Final = segment.length_to_go(begin) - self._to_go_after

    def evaluate(self, t: Any) -> PathPoint:
        """The point at t (float or array) in [0, 1]."""
        w = self._width
        x, y, dx, dy, ddx, ddy = self.segment.evaluate(self.begin + w * t)
        return PathPoint(x, y, w * dx, w * dy, w * w * ddx, w * w * ddy)

    def length_to_go(self, t: float) -> float:
        """Length from t to the end, m."""
        return self.segment.length_to_go(self.begin + self._width * t) - self._to_go_after

    def row(self) -> list[float]:
        """That of the whole's kind where parts of it are of the same kind; else fitted."""
        kind, *n = self.segment.row()
        begin, w = self.begin, self._width
        if kind < 0.0:  # followed from its end
            begin = 1.0 - self.end
        if abs(kind) == LINE:
            return [kind, n[0] + n[2] * begin, n[1] + n[3] * begin, w * n[2], w * n[3]]
        if abs(kind) == ARC:
            return [kind, n[0], n[1], n[2], n[3] + begin * n[4], w * n[4]]
        if abs(kind) == SPIRAL:
            return [kind, n[0], n[1], n[2] + begin * n[3], w * n[3], n[4] + begin * n[5], w * n[5]]
        if abs(kind) == CUBIC:
            return [kind, *_cut(n, begin, w)]
        return fitted_row(self)


def _cut(pieces: list[float], begin: float, width: float) -> list[float]:
    """Return the cubic pieces between begin and begin + width, over t in [0, 1]."""
    found: list[float] = []
    starts = [*pieces[::CUBIC_WIDTH], 1.0]
    for k, (start, end) in enumerate(itertools.pairwise(starts)):
        first = max(start, begin)
        if first >= min(end, begin + width) - 1e-15:
            continue
        found.append((first - begin) / width)
        numbers = pieces[k * CUBIC_WIDTH + 1 : (k + 1) * CUBIC_WIDTH]
        for a, b, c, d in (numbers[:4], numbers[4:]):
            u = first - start
            shifted = (
                a,
                3.0 * a * u + b,
                (3.0 * a * u + 2.0 * b) * u + c,
                ((a * u + b) * u + c) * u + d,
            )
            found += [shifted[0] * width**3, shifted[1] * width**2, shifted[2] * width, shifted[3]]
    return found
