"""The straight segment, Eq. (10)."""

from __future__ import annotations

import math
from typing import Any, Final

from auv_path_following.curves.rows import LINE
from auv_path_following.curves.segment import PathPoint


class Line:
    """A straight leg, Eq. (10).

    Args:
        x0, y0: where it starts (north, east), m.
        length: L > 0, m.
        chi: its course chi_l, rad.
    """

    kind: Final = "line"

    def __init__(self, x0: float, y0: float, length: float, chi: float) -> None:
        self.x0: Final = x0
        self.y0: Final = y0
        self.length: Final = length
        self.chi: Final = chi
        self._dx: Final = length * math.cos(chi)
        self._dy: Final = length * math.sin(chi)

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        zero = 0.0 * t
        return PathPoint(
            self.x0 + self._dx * t, self.y0 + self._dy * t, self._dx + zero, self._dy + zero, zero, zero
        )

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self.length * (1.0 - t)

    def row(self) -> list[float]:
        """LINE, x0, y0, dx, dy."""
        return [LINE, *self.evaluate(0.0)[:4]]
