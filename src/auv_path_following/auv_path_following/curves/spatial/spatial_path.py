"""A composite path in three dimensions: planar subpaths at the depths of a profile."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final, NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.part import Part
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, lifted, tangent_of

#: Largest difference of a profile's length and its path's, m.
LENGTH_TOLERANCE = 0.01
#: Knots nearer to the end of a subpath than this are at it, m.
_AT_THE_END = 1e-6
#: Turn of the tangent from which on a joint is a corner, rad.
_CORNER = math.radians(0.1)


class SpatialJoint(NamedTuple):
    """Where two subpaths meet.

    Attributes:
        x, y, z: place, NED, m.
        chi_in, chi_out: course before and behind, rad.
        gamma_in, gamma_out: elevation before and behind, rad, up positive.
    """

    x: float
    y: float
    z: float
    chi_in: float
    chi_out: float
    gamma_in: float
    gamma_out: float

    @property
    def is_corner(self) -> bool:
        """Whether course or elevation jumps (G0)."""
        turn, tilt = wrap(self.chi_out - self.chi_in), self.gamma_out - self.gamma_in
        return abs(turn) > _CORNER or abs(tilt) > _CORNER


class SpatialPath:
    """Subpaths in a row; subpath i (from 0) owns s in [i, i + 1). Immutable.

    The profile's knots are joints: a subpath in which one lies becomes two. So each subpath has one ramp, and
    at a knot the slope is that of the subpath that is asked.

    Args:
        segments: the planar subpaths in their order.
        profile: depth over their horizontal length.

    Raises:
        ConfigurationError: the profile is longer or shorter than the path, or a planar joint does not meet.
    """

    def __init__(self, segments: Sequence[Segment], profile: DepthProfile) -> None:
        length = math.fsum(segment.length for segment in segments)
        if abs(profile.length - length) > LENGTH_TOLERANCE:
            found = f"a last knot at {profile.length:.6g} m"
            raise ConfigurationError("depth_profile", found, f"the path's horizontal length, {length:.6g} m")
        self.profile: Final = profile
        parts, self._ramps, self._begins = _divided(segments, profile)
        self.plan: Final = CompositePath(parts)
        self.n: Final = self.plan.n
        ends = [tangent_of(self.evaluate(i, 1.0)) for i in range(self.n - 1)]
        begins = [tangent_of(self.evaluate(i, 0.0)) for i in range(1, self.n)]
        places = [self.evaluate(i, 0.0)[:3] for i in range(1, self.n)]
        self.joints: Final = tuple(
            SpatialJoint(*place, before.chi, after.chi, before.gamma, after.gamma)
            for place, before, after in zip(places, ends, begins, strict=True)
        )

    def evaluate(self, i: int, t: float) -> SpatialPoint:
        """Return the point at t in [0, 1] of subpath i (from 0)."""
        segment = self.plan.segments[i]
        way = self._begins[i] + segment.length - segment.length_to_go(t)
        return lifted(segment.evaluate(t), self.profile.at(way, self._ramps[i]))


def _divided(
    segments: Sequence[Segment], profile: DepthProfile
) -> tuple[list[Segment], list[int], list[float]]:
    """Return the subpaths divided at the knots, the ramp of each, and the horizontal length before it, m."""
    parts: list[Segment] = []
    ramps: list[int] = []
    begins: list[float] = []
    before, ramp = 0.0, 0
    for segment in segments:
        t, after = 0.0, before + segment.length
        while True:
            while ramp + 2 < len(profile.knots) and profile.knots[ramp + 1].way <= before + _AT_THE_END:
                ramp += 1
            knot = profile.knots[ramp + 1].way
            is_inside = ramp + 2 < len(profile.knots) and knot < after - _AT_THE_END
            end = place_of(segment, segment.length - (after - knot)) if is_inside else 1.0
            parts.append(segment if (t, end) == (0.0, 1.0) else Part(segment, t, end))
            ramps.append(ramp)
            begins.append(before)
            if not is_inside:
                break
            t, before = end, knot
        before = after
    return parts, ramps, begins


def place_of(segment: Segment, way: float) -> float:
    """Return the t at which a length of the segment has passed.

    Args:
        segment: of any kind.
        way: length from its start, m, within the segment.
    """
    low, high, target = 0.0, 1.0, segment.length - way
    for _ in range(60):
        middle = 0.5 * (low + high)
        if segment.length_to_go(middle) > target:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
