"""A finding of the mission check: what stands where on the path, and what would be better."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Level = Literal["refused", "warning"]


@dataclass(frozen=True)
class Finding:
    """A reason to refuse a mission, or a warning.

    Attributes:
        level: "refused" or "warning".
        where: the place on the path.
        found: what is there.
        expected: what would be better.
        way: horizontal length from the path's start, m, where the picture of depths marks it; else NaN.
    """

    level: Level
    where: str
    found: str
    expected: str
    way: float = math.nan

    def __str__(self) -> str:
        return f"{self.where}: found {self.found}, expected {self.expected}"


def at(x: float, y: float) -> str:
    """Return a place for people, m, without a minus in front of a zero."""
    return f"at north {round(x, 1) + 0.0:.1f}, east {round(y, 1) + 0.0:.1f}"
