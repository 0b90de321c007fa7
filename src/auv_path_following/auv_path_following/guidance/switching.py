"""When the next subpath is followed early: the circle of acceptance, Eq. (44)."""

from __future__ import annotations

import math
from typing import Literal

from auv_msgs_py.settings import Auto, setting, settings
from auv_msgs_py.types import NO_CURRENT, Current
from auv_path_following.guidance.acceptance import Corner, Cornering, acceptance_radius, corner_of
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
    radius: Auto = setting(
        6.0,
        "radius Rk of the circles; 0 or auto: computed for each corner",
        unit="m",
        ge=0.0,
        le=1000.0,
        live=True,
    )


def as_wished(config: SwitchingConfig, mode: SwitchingMode | None, radius: float | None) -> SwitchingConfig:
    """`config` with what a mission asks for; None leaves a value as it is."""
    return SwitchingConfig(
        mode=config.mode if mode is None else mode, radius=config.radius if radius is None else radius
    )


class CircleOfAcceptance:
    """Eq. (44) for a path whose joints are classified, and for subpaths of any length and shape.

    Args:
        path: the path.
        config: which joints, and Rk.
        cornering: how the vehicle turns, for an Rk of 0; without it that is no circle.
        lookahead: Delta, m, for an Rk of 0.
    """

    def __init__(
        self,
        path: CompositePath,
        config: SwitchingConfig | None = None,
        cornering: Cornering | None = None,
        lookahead: float = 0.0,
    ) -> None:
        self.path = path
        self.config = config or SwitchingConfig()
        self.lookahead = lookahead
        self._cornering = cornering
        self._stretches: dict[int, float] = {}
        self._corners: dict[int, Corner] = {}

    def radius(self, i: int, Ur: float, current: Current) -> float:
        """Return Rk at the end of subpath `i` (from 0), m, at a speed through the water in m/s.

        A smooth joint needs no circle: where Rk is computed it is 0 there.
        """
        if self.config.radius > 0.0 or self._cornering is None or self.path.joints[i].geometric != "G0":
            return self.config.radius
        if i not in self._corners:
            self._corners[i] = corner_of(self.path, i)
        return acceptance_radius(self._cornering, self._corners[i], self.lookahead, Ur, current)

    def reached(
        self, x: float, y: float, i: int, t: float, Ur: float = 0.0, current: Current = NO_CURRENT
    ) -> bool:
        """Whether a vehicle at (x, y), with P at t of subpath `i` (from 0), may go on to the next one.

        Args:
            x, y: the vehicle's position, NED, m.
            i, t: place of P.
            Ur: its speed through the water, m/s.
            current: the estimate, m/s, NED.
        """
        mode = self.config.mode
        if mode == "off" or i >= len(self.path.joints):
            return False
        joint = self.path.joints[i]
        if mode == "g0" and joint.geometric != "G0":
            return False
        if t < self._stretch(i):
            return False
        return math.hypot(joint.x - x, joint.y - y) <= self.radius(i, Ur, current)

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
