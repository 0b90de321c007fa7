"""A composite path in three dimensions: subpaths with depths under one scalar s in [0, n]."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.closest_in_space import closest_in_space, points_of
from auv_path_following.curves.spatial.depth_profile import DepthProfile, Knot
from auv_path_following.curves.spatial.part import Part
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, tangent_of
from auv_path_following.curves.spatial.spatial_segment import Lifted, SpatialSegment

Array = npt.NDArray[np.float64]

#: Largest difference of a profile's length and its path's, m.
LENGTH_TOLERANCE = 0.01
#: Largest step of the depth at a joint, m.
DEPTH_TOLERANCE = 1e-3
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


class SpatialPose(NamedTuple):
    """A place on a path and its direction there: NED, m, rad; the elevation gamma is positive upwards."""

    x: float
    y: float
    z: float
    gamma: float
    chi: float


class SpatialPath:
    """Subpaths in a row; subpath i (from 0) owns s in [i, i + 1). Immutable.

    The profile's knots are joints: a subpath in which one lies becomes two. So each subpath has one ramp, and
    at a knot the slope is that of the subpath that is asked.

    Args:
        segments: the subpaths in their order: planar ones, or without a profile spatial ones.
        profile: depth over the horizontal length of planar segments.

    Raises:
        ConfigurationError: the profile is longer or shorter than the path, or a joint does not meet.
    """

    def __init__(
        self, segments: Sequence[Segment] | Sequence[SpatialSegment], profile: DepthProfile | None = None
    ) -> None:
        self.subpaths: Final[tuple[SpatialSegment, ...]] = tuple(
            segments if profile is None else _divided(segments, profile)  # type: ignore[arg-type]
        )
        self.plan: Final = CompositePath(subpath.plan for subpath in self.subpaths)
        self.n: Final = self.plan.n
        self.knots: Final = tuple(profile.knots if profile is not None else _knots_of(self.subpaths))
        ends = [self.evaluate(i, 1.0) for i in range(self.n - 1)]
        begins = [self.evaluate(i, 0.0) for i in range(1, self.n)]
        for number, (end, begin) in enumerate(zip(ends, begins, strict=True), start=1):
            if not abs(end.z - begin.z) <= DEPTH_TOLERANCE:
                found = f"a depth of {begin.z:.6g} m where segments[{number - 1}] ends at {end.z:.6g} m"
                raise ConfigurationError(f"segments[{number}]", found, "the same depth")
        tangents = zip(map(tangent_of, ends), map(tangent_of, begins), strict=True)
        self.joints: Final = tuple(
            SpatialJoint(*place[:3], before.chi, after.chi, before.gamma, after.gamma)
            for place, (before, after) in zip(begins, tangents, strict=True)
        )
        lengths = [subpath.length for subpath in self.subpaths]
        #: Length in three dimensions, m.
        self.length: Final = math.fsum(lengths)
        #: Length of path after each subpath, m.
        self.after: Final = tuple(itertools.accumulate(reversed(lengths[1:]), initial=0.0))[::-1]

    def evaluate(self, i: int, t: float) -> SpatialPoint:
        """Return the point at t in [0, 1] of subpath i (from 0)."""
        return self.subpaths[i].evaluate(t)

    def sampled(self, i: int, t: Array) -> SpatialPoint:
        """Return the points at an array of t in [0, 1] of subpath i (from 0): arrays of that shape."""
        return points_of(self.subpaths[i], t)

    def polyline(self, spacing: float) -> tuple[Array, Array, Array, Array]:
        """Return points along the path, all joints included, for drawing.

        Args:
            spacing: largest length of path between neighbours, m.

        Returns:
            x, y, z (NED, m) and s, each of shape (m,).
        """
        columns = []
        for i, subpath in enumerate(self.subpaths):
            t = np.linspace(0.0, 1.0, max(1, math.ceil(subpath.length / spacing)) + 1)
            # The end of a subpath is the start of the next one: keep it once.
            t = t if i == self.n - 1 else t[:-1]
            p: Any = self.sampled(i, t)
            columns.append((p.x, p.y, p.z, i + t))
        x, y, z, s = (np.concatenate(parts) for parts in zip(*columns, strict=True))
        return x, y, z, s

    def distance_to_go(self, i: int, t: float) -> float:
        """Return the length of path from t of subpath i (from 0) to the end of the path, m."""
        return self.subpaths[i].length_to_go(t) + self.after[i]

    @property
    def start_pose(self) -> SpatialPose:
        """Start of the path, and its direction there."""
        return self.pose_at(0.0)

    def pose_at(self, s: float) -> SpatialPose:
        """Return the place at s, Eq. (1), in [0, n], and the direction of the path there."""
        i = min(int(s), self.n - 1)
        point = self.evaluate(i, s - i)
        along = tangent_of(point)
        return SpatialPose(point.x, point.y, point.z, along.gamma, along.chi)

    def distance(self, x: Array, y: Array, z: Array, i: npt.NDArray[Any]) -> Array:
        """Return the distance of a track from the path, as `closest` does without the depth."""
        return self.closest(x, y, z, i)[0]

    def closest(self, x: Array, y: Array, z: Array, i: npt.NDArray[Any]) -> tuple[Array, Array]:
        """Return the distance of a track from the path near the subpath followed, and the path's depth there.

        Args:
            x, y, z: shape (n,), NED, m.
            i: shape (n,), subpath followed at each sample, from 0; it and its neighbours are searched.

        Returns:
            closest distance, not negative, and depth of the closest point, both of shape (n,), m; NaN where
            x, y or z is not finite.
        """
        followed = np.asarray(i)
        order = np.argsort(followed, kind="stable")
        in_order = followed[order]
        distance, depth = np.full(len(x), np.inf), np.full(len(x), np.nan)
        for j in np.unique(np.concatenate([in_order + step for step in (-1, 0, 1)])):
            if 0 <= j < self.n:
                first, last = np.searchsorted(in_order, (j - 1, j + 2))
                near = order[first:last]
                found, at = closest_in_space(self.subpaths[j], x[near], y[near], z[near])
                is_closer = ~(found >= distance[near])
                distance[near] = np.where(is_closer, found, distance[near])
                depth[near] = np.where(is_closer, at, depth[near])
        return distance, depth


def _knots_of(subpaths: Sequence[SpatialSegment]) -> list[Knot]:
    """Return the knots of all subpaths by their horizontal length from the path's start, joints once."""
    found: list[Knot] = []
    before = 0.0
    for subpath in subpaths:
        own = subpath.knots if not found else subpath.knots[1:]
        found += [Knot(before + knot.way, knot.depth) for knot in own]
        before += subpath.plan.length
    return found


def _divided(segments: Sequence[Segment], profile: DepthProfile) -> list[Lifted]:
    """Return the subpaths, divided at the knots."""
    length = math.fsum(segment.length for segment in segments)
    if abs(profile.length - length) > LENGTH_TOLERANCE:
        found = f"a last knot at {profile.length:.3f} m"
        raise ConfigurationError("depth_profile", found, f"the path's horizontal length, {length:.3f} m")
    lifted_: list[Lifted] = []
    before, ramp = 0.0, 0
    for segment in segments:
        t, after = 0.0, before + segment.length
        while True:
            while ramp + 2 < len(profile.knots) and profile.knots[ramp + 1].way <= before + _AT_THE_END:
                ramp += 1
            knot = profile.knots[ramp + 1].way
            is_inside = ramp + 2 < len(profile.knots) and knot < after - _AT_THE_END
            end = place_of(segment, segment.length - (after - knot)) if is_inside else 1.0
            part = segment if (t, end) == (0.0, 1.0) else Part(segment, t, end)
            lifted_.append(Lifted(part, profile, ramp, before))
            if not is_inside:
                break
            t, before = end, knot
        before = after
    return lifted_


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
