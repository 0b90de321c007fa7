"""A cubic spline through points with depths: one subpath, twice continuously differentiable all along."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.polynomial import Polynomial as Series

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.arc_length import ArcLength
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.spatial.depth_profile import Knot
from auv_path_following.curves.spatial.spatial_point import SpatialPoint
from auv_path_following.curves.spatial.spatial_segment import depths_at, piece

#: A point: north, east and depth (positive down), m.
Place = tuple[float, float, float]


class SpatialSpline:
    """A cubic in each coordinate; t grows with the straight distance between the points, depth included.

    Args:
        points: at least two (north, east, depth), m; neighbours not above one another.
        chi_start, chi_end: courses at its ends, rad. With one, that end is level as well; without, it has no
            curvature.

    Raises:
        ConfigurationError: neighbours at one place in the plan, or a curve that stands still somewhere.
    """

    def __init__(
        self, points: Sequence[Place], chi_start: float | None = None, chi_end: float | None = None
    ) -> None:
        self.points: Final = tuple((float(x), float(y), float(z)) for x, y, z in points)
        self._courses: Final = chi_start, chi_end
        for number, (before, after) in enumerate(itertools.pairwise(self.points), start=1):
            if math.dist(before[:2], after[:2]) <= 1e-6:
                found = f"the place of points[{number - 1}]"
                raise ConfigurationError(f"points[{number}]", found, "a point at another place in the plan")
        chords = [math.dist(*pair) for pair in itertools.pairwise(self.points)]
        self.plan: Final = Spline([point[:2] for point in self.points], chi_start, chi_end, chords)
        knots = np.concatenate(([0.0], np.cumsum(chords)))
        self._knots: Final = knots / knots[-1]
        ends = tuple((2 if chi is None else 1, 0.0) for chi in self._courses)
        from scipy.interpolate import CubicSpline

        depth = CubicSpline(self._knots, [point[2] for point in self.points], bc_type=ends)
        pieces: list[float] = []
        for start, width, cubic in zip(self._knots, np.diff(self._knots), depth.c.T, strict=False):
            over_u = Series(cubic[::-1])(Series([0.5 * width, 0.5 * width]))
            pieces += piece(float(start), float(width), over_u)
        self.depth_pieces: Final = pieces
        self._arc: Final = ArcLength(self._speed, len(chords))
        self.length: Final = self._arc.total

    def _speed(self, t: Any) -> Any:
        place = self.plan.evaluate(t if isinstance(t, np.ndarray) else np.array([t]))
        shape = np.shape(place.dx)
        _, dz, _ = depths_at(self.depth_pieces, np.ravel(t))
        speed = np.sqrt(place.dx**2 + place.dy**2 + dz.reshape(shape) ** 2)
        return speed if isinstance(t, np.ndarray) else float(speed[0])

    def evaluate(self, t: float) -> SpatialPoint:
        """Return the point at t in [0, 1]."""
        x, y, dx, dy, ddx, ddy = self.plan.evaluate(t)
        z, dz, ddz = (float(one[0]) for one in depths_at(self.depth_pieces, np.array([t])))
        return SpatialPoint(x, y, z, dx, dy, dz, ddx, ddy, ddz)

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end in three dimensions, m."""
        return self._arc.to_go(t)

    @cached_property
    def knots(self) -> tuple[Knot, ...]:
        """Horizontal length from its start and depth (m) at its points."""
        length = self.plan.length
        ways = [length - self.plan.length_to_go(float(t)) for t in self._knots]
        return tuple(Knot(way, point[2]) for way, point in zip(ways, self.points, strict=True))

    def reversed(self) -> SpatialSpline:
        """Return the same curve, followed from its end to its start."""
        start, end = (None if chi is None else chi + math.pi for chi in self._courses)
        return SpatialSpline(self.points[::-1], end, start)
