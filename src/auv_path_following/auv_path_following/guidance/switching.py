"""When the next subpath is followed early: the circle of acceptance, Eq. (44)."""

from __future__ import annotations

import math
from typing import Literal

from auv_msgs_py.settings import setting, settings
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.outline import last_stretch
from auv_path_following.paths.segment import Segment

SwitchingMode = Literal["off", "g0", "all"]


@settings
class SwitchingConfig:
    """The circle of acceptance around a joint."""

    mode: SwitchingMode = setting(
        "g0", "joints with a circle of acceptance: off, g0 (corners only) or all", live=True
    )
    radius: float = setting(
        6.0, "radius Rk of the circle, at most Delta", unit="m", ge=0.0, le=1000.0, live=True
    )


def as_wished(config: SwitchingConfig, mode: SwitchingMode | None, radius: float | None) -> SwitchingConfig:
    """`config` with what a mission asks for; None leaves a value as it is."""
    return SwitchingConfig(
        mode=config.mode if mode is None else mode, radius=config.radius if radius is None else radius
    )


class CircleOfAcceptance:
    """Eq. (44) for a path whose joints are classified, and for subpaths of any length and shape."""

    def __init__(self, path: CompositePath, config: SwitchingConfig | None = None) -> None:
        self.path = path
        self.config = config or SwitchingConfig()
        self._stretches: dict[int, float] = {}

    def reached(self, x: float, y: float, i: int, t: float) -> bool:
        """Whether a vehicle at (x, y), with P at t of subpath `i` (from 0), may go on to the next one."""
        mode = self.config.mode
        if mode == "off" or i >= len(self.path.joints):
            return False
        joint = self.path.joints[i]
        if mode == "g0" and joint.geometric != "G0":
            return False
        return math.hypot(joint.x - x, joint.y - y) <= self.config.radius and t >= self._stretch(i)

    def _stretch(self, i: int) -> float:
        """From where on the circle of subpath `i` counts; found when it is first entered."""
        if i not in self._stretches:
            self._stretches[i] = counts_from(self.path.segments[i])
        return self._stretches[i]


def counts_from(segment: Segment) -> float:
    """Return the t from which on the circle at a subpath's end counts.

    A subpath that comes back to its start has its joint there, and a vehicle that sets out is inside the
    circle at once: only the last stretch counts. Of a subpath shorter than the circle, as between dense
    waypoints, half is followed at least, so that P does not run ahead from one circle to the next.
    """
    return max(last_stretch(segment), 0.5)
