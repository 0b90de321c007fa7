"""One thing to know of a mission before the vehicle is in the water, and where on the path it is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Level = Literal["refused", "warning"]


@dataclass(frozen=True)
class Finding:
    """One thing to know before the vehicle is in the water.

    Attributes:
        level: "refused" or "warning".
        where: the place on the path.
        found: what is there.
        expected: what would be better.
    """

    level: Level
    where: str
    found: str
    expected: str

    def __str__(self) -> str:
        return f"{self.where}: found {self.found}, expected {self.expected}"


def at(x: float, y: float) -> str:
    """Rounded, and without a minus in front of a zero."""
    return f"at north {round(x, 1) + 0.0:.1f}, east {round(y, 1) + 0.0:.1f}"
