"""A subpath in three dimensions: a planar segment, and its depth over t."""

from __future__ import annotations

from functools import cached_property
from typing import Any, Final, Protocol

import numpy as np
from numpy.polynomial import Polynomial as Series

from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.rows import FITTED_WIDTH, TERMS
from auv_path_following.curves.segment import PathPoint, Segment
from auv_path_following.curves.spatial.depth_profile import DepthProfile, Knot
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, lifted

#: Numbers of a piece of depth: the t at its start and 2 / its width, then its coefficients of u in [-1, 1],
#: highest power first.
DEPTH_WIDTH = 2 + TERMS
#: Kinds on which the length grows evenly with t: a ramp over them is a polynomial of t.
_EVEN = ("line", "arc", "clothoid")


class SpatialSegment(Protocol):
    """One subpath in three dimensions. Immutable."""

    @property
    def plan(self) -> Segment:
        """The segment seen from above."""

    @property
    def length(self) -> float:
        """Length of the whole in three dimensions, m."""

    def evaluate(self, t: float) -> SpatialPoint:
        """Return the point at t in [0, 1]."""

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end in three dimensions, m."""

    @property
    def depth_pieces(self) -> list[float]:
        """Depth over t as pieces of `DEPTH_WIDTH` numbers each, one after another."""

    @property
    def knots(self) -> tuple[Knot, ...]:
        """Horizontal length from its start and depth (m) at both ends, and between them where ramps meet."""

    def reversed(self) -> SpatialSegment:
        """Return the same curve, followed from its end to its start."""


class Lifted:
    """A planar segment at the depths of one ramp of a profile, Eq. (3D-10).

    Args:
        plan: the planar segment.
        profile: depth over horizontal length.
        ramp: index of the ramp in which the whole segment lies; at a knot its slope counts.
        begin: horizontal length of the path before the segment, m.
    """

    def __init__(self, plan: Segment, profile: DepthProfile, ramp: int, begin: float) -> None:
        self.plan: Final = plan
        self.profile: Final = profile
        self.ramp: Final = ramp
        self.begin: Final = begin
        before, after = profile.knots[ramp : ramp + 2]
        self._is_level: Final = before.depth == after.depth
        self.length: Final = self.length_to_go(0.0)

    def _way(self, t: float) -> float:
        return self.begin + self.plan.length - self.plan.length_to_go(t)

    def evaluate(self, t: float) -> SpatialPoint:
        """Return the point at t in [0, 1]."""
        return lifted(self.plan.evaluate(t), self.profile.at(self._way(t), self.ramp))

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end in three dimensions, m."""
        planar = self.plan.length_to_go(t)
        if self._is_level:
            return planar
        half = 0.5 * planar
        return half * self.profile.stretch(self.begin + self.plan.length - half, half, self.ramp)

    @cached_property
    def depth_pieces(self) -> list[float]:
        """Depth over t as pieces."""
        before, after = self.profile.knots[self.ramp : self.ramp + 2]
        if not self._is_level and self.plan.kind not in _EVEN:
            return _fitted(self)
        rise = after.depth - before.depth
        smooth = self.profile.kind == "smooth"
        ramp = (
            [before.depth, 0.0, 0.0, 10.0 * rise, -15.0 * rise, 6.0 * rise]
            if smooth
            else [before.depth, rise]
        )
        half = 0.5 * self.plan.length / (after.way - before.way)
        share = Series([(self.begin - before.way) / (after.way - before.way) + half, half])
        return piece(0.0, 1.0, Series(ramp)(share) if rise else Series([before.depth]))

    @property
    def knots(self) -> tuple[Knot, ...]:
        """Horizontal length from its start and depth (m) at both ends."""
        ways = (self.begin, self.begin + self.plan.length)
        return tuple(Knot(way - self.begin, self.profile.at(way, self.ramp)[0]) for way in ways)

    def reversed(self) -> Lifted:
        """Return the same curve, followed from its end to its start."""
        ramp = len(self.profile.knots) - 2 - self.ramp
        begin = self.profile.length - self.begin - self.plan.length
        return Lifted(Reversed(self.plan), self.profile.reversed(), ramp, begin)


def piece(start: float, width: float, depth: Any) -> list[float]:
    """Return one piece of depth.

    Args:
        start, width: of the piece, in t.
        depth: polynomial of u, which goes from -1 to 1 over the piece (`numpy.polynomial.Polynomial`).
    """
    coefficients = [float(number) for number in depth.coef[::-1]]
    return [start, 2.0 / width, *[0.0] * (TERMS - len(coefficients)), *coefficients]


def depths_at(pieces: list[float], t: Any) -> tuple[Any, Any, Any]:
    """Return depth and both its derivatives with respect to t at an array of t, m."""
    table = np.asarray(pieces).reshape(-1, DEPTH_WIDTH)
    rows = table[np.maximum(np.searchsorted(table[:, 0], t, side="right") - 1, 0)]
    scale = rows[:, 1]
    u = (t - rows[:, 0]) * scale - 1.0
    z, dz, half_ddz = (np.zeros(len(u)) for _ in range(3))
    for k in range(2, DEPTH_WIDTH):
        half_ddz = half_ddz * u + dz
        dz = dz * u + z
        z = z * u + rows[:, k]
    return z, dz * scale, half_ddz * 2.0 * scale * scale


class _DepthOverT:
    """Depth of a subpath as the first axis of a curve, which `fitted_row` fits."""

    kind = "depth"

    def __init__(self, segment: SpatialSegment) -> None:
        self._segment = segment

    def evaluate(self, t: Any) -> PathPoint:
        """Depth and its derivatives in the place of x, dx and ddx."""
        points = [self._segment.evaluate(float(one)) for one in np.atleast_1d(t)]
        z, dz, ddz = (np.array([getattr(p, name) for p in points]) for name in ("z", "dz", "ddz"))
        none = np.zeros(len(points))
        return PathPoint(z, none, dz, none, ddz, none)  # type: ignore[arg-type]


def _fitted(segment: SpatialSegment) -> list[float]:
    """Return the depth of a segment as pieces fitted to `pieces.TOLERANCE`."""
    _, *numbers = fitted_row(_DepthOverT(segment))  # type: ignore[arg-type]
    found: list[float] = []
    for begin in range(0, len(numbers), FITTED_WIDTH):
        found += numbers[begin : begin + DEPTH_WIDTH]
    return found
