"""The Archimedean spiral: its turns keep one distance from each other, so it sweeps an area."""

from __future__ import annotations

import math
from typing import Any, Final

from auv_msgs_py.values.elementary import functions_of
from auv_path_following.curves.rows import SPIRAL
from auv_path_following.curves.segment import PathPoint


class ArchimedeanSpiral:
    """Part of an Archimedean spiral around (cx, cy): the radius grows evenly with the bearing.

    Args:
        cx, cy: centre (north, east), m.
        radius0, radius1: at its start and its end, m, not negative and not equal.
        a0, a1: bearings of its start and its end as seen from the centre, rad; they differ.
    """

    kind: Final = "spiral"

    def __init__(self, cx: float, cy: float, radius0: float, radius1: float, a0: float, a1: float) -> None:
        self.cx: Final = cx
        self.cy: Final = cy
        self._radius0: Final = radius0
        self._growth: Final = radius1 - radius0
        self._a0: Final = a0
        self._sweep: Final = a1 - a0
        self._per_radian: Final = self._growth / self._sweep
        self._end: Final = self._primitive(radius1)
        self.length: Final = abs(self._end - self._primitive(radius0))

    def _primitive(self, radius: float) -> float:
        """Length of the whole spiral from its centre out to `radius`, m, up to the sign of the growth."""
        b = self._per_radian
        q = radius / b
        return 0.5 * b * (q * math.hypot(1.0, q) + math.asinh(q))

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        m = functions_of(t)
        w, g = self._sweep, self._growth
        a, radius = self._a0 + t * w, self._radius0 + t * g
        cos, sin = m.cos(a), m.sin(a)
        turn, twice = radius * w, 2.0 * g * w
        pull = turn * w
        return PathPoint(
            self.cx + radius * cos,
            self.cy + radius * sin,
            g * cos - turn * sin,
            g * sin + turn * cos,
            -twice * sin - pull * cos,
            twice * cos - pull * sin,
        )

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return abs(self._end - self._primitive(self._radius0 + t * self._growth))

    def row(self) -> list[float]:
        """SPIRAL, centre, radius at its start, growth, a0, sweep."""
        return [SPIRAL, self.cx, self.cy, self._radius0, self._growth, self._a0, self._sweep]
