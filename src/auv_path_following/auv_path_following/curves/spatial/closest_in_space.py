"""Exact distance of points from one subpath in three dimensions, and the depth of the closest point there."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.closest import descended, samples
from auv_path_following.curves.spatial.spatial_point import SpatialPoint
from auv_path_following.curves.spatial.spatial_segment import SpatialSegment, depths_at

Array = npt.NDArray[np.float64]

_CHUNK = 2048


def points_of(segment: SpatialSegment, t: Array) -> SpatialPoint:
    """Return the points of a subpath at an array of t in [0, 1]: arrays of that shape."""
    x, y, dx, dy, ddx, ddy = segment.plan.evaluate(t)
    z, dz, ddz = depths_at(segment.depth_pieces, t)
    return SpatialPoint(x, y, z, dx, dy, dz, ddx, ddy, ddz)


def closest_in_space(segment: SpatialSegment, x: Array, y: Array, z: Array) -> tuple[Array, Array]:
    """Return the distance of each point to a subpath, its ends included, and the depth of the closest point.

    Newton's method, safeguarded by bisection, refines every minimum of a coarse sampling, as in the plane.

    Args:
        segment: any subpath.
        x, y, z: shape (n,), NED, m.

    Returns:
        both of shape (n,), m; the distance is not negative; NaN for a point that is not finite.
    """
    t = coarse_places(segment)
    places = np.column_stack((x, y, z))
    distance, depth = np.full(len(x), np.nan), np.full(len(x), np.nan)
    finite = np.flatnonzero(np.isfinite(places).all(axis=1))
    for start in range(0, len(finite), _CHUNK):
        part = finite[start : start + _CHUNK]
        distance[part], depth[part] = _of_chunk(segment, t, places[part])
    return distance, depth


def coarse_places(segment: SpatialSegment) -> Array:
    """Return the t of a sampling that is dense enough to resolve every minimum of the distance."""
    return np.linspace(0.0, 1.0, 2 * samples(segment.plan) + 1)


def _of_chunk(segment: SpatialSegment, t: Array, places: Array) -> tuple[Array, Array]:
    coarse = _axes(points_of(segment, t), 0)
    squared = np.full((len(places), len(t) + 2), np.inf)
    squared[:, 1:-1] = ((coarse[None] - places[:, None]) ** 2).sum(axis=2)
    middle = squared[:, 1:-1]
    owner, sample = np.nonzero((middle <= squared[:, :-2]) & (middle <= squared[:, 2:]))
    last = len(t) - 1
    low, high = t[np.maximum(sample - 1, 0)], t[np.minimum(sample + 1, last)]
    best = _descend(segment, places[owner], t[sample], low, high)
    found = _axes(points_of(segment, best), 0)
    distances = np.sqrt(((found - places[owner]) ** 2).sum(axis=1))
    # The first of each owner is its closest; every owner has one.
    order = np.lexsort((distances, owner))
    closest = order[np.searchsorted(owner[order], np.arange(len(places)))]
    return distances[closest], found[closest, 2]


def _axes(point: Any, derivative: int) -> Array:
    """Return the three axes of a place or of a derivative of it, shape (m, 3)."""
    return np.column_stack(point[3 * derivative : 3 * derivative + 3])


def _descend(segment: SpatialSegment, places: Array, t: Array, low: Array, high: Array) -> Array:
    """Return the t of least distance between `low` and `high`, started at `t`; all of shape (m,)."""

    def slopes(at: Array, rows: Array) -> tuple[Array, Array]:
        point = points_of(segment, at)
        offset, along = _axes(point, 0) - places[rows], _axes(point, 1)
        bend = (along**2).sum(axis=1) + (offset * _axes(point, 2)).sum(axis=1)
        return (offset * along).sum(axis=1), bend

    return descended(slopes, t, low, high)
