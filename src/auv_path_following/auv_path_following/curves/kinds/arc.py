"""The circular segment, Eq. (11)."""

from __future__ import annotations

from typing import Any, Final

from auv_msgs_py.values.elementary import functions_of
from auv_path_following.curves.rows import ARC
from auv_path_following.curves.segment import PathPoint


class Arc:
    """A circular arc, Eq. (11): to starboard (clockwise from above) when a1 > a0, else to port.

    Args:
        cx, cy: centre (north, east), m.
        radius: R > 0, m.
        a0, a1: bearings of its start and its end as seen from the centre, rad; they differ.
    """

    kind: Final = "arc"

    def __init__(self, cx: float, cy: float, radius: float, a0: float, a1: float) -> None:
        self.cx: Final = cx
        self.cy: Final = cy
        self.radius: Final = radius
        self.a0: Final = a0
        self.a1: Final = a1
        self.length: Final = radius * abs(a1 - a0)

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        m = functions_of(t)
        sweep = self.a1 - self.a0
        a = self.a0 + t * sweep
        north = self.radius * m.cos(a)
        east = self.radius * m.sin(a)
        return PathPoint(
            self.cx + north,
            self.cy + east,
            -sweep * east,
            sweep * north,
            -sweep * sweep * north,
            -sweep * sweep * east,
        )

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self.length * (1.0 - t)

    def row(self) -> list[float]:
        """ARC, centre, radius, a0, sweep."""
        return [ARC, self.cx, self.cy, self.radius, self.a0, self.a1 - self.a0]
