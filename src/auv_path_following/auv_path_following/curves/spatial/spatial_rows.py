"""A path in three dimensions as numbers: the planar rows, and for each subpath its depth over t.

The depth of a subpath is kept as polynomial pieces of t, fitted to `pieces.TOLERANCE`; a ramp over a line or
an arc is such a polynomial itself.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from auv_msgs_py.values.pure import pure
from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.rows import (
    AFTER,
    CORNER,
    FITTED_WIDTH,
    JOINT,
    LENGTH,
    SMOOTH,
    SPEED,
    TERMS,
    PathRows,
    evaluate,
)
from auv_path_following.curves.segment import PathPoint
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, tangent_of

#: Numbers of a piece of depth: the t at its start and 2 / its width, then its coefficients of u in [-1, 1].
DEPTH_WIDTH = 2 + TERMS
#: Columns of a row of depth: where its first piece begins in `SpatialRows.depth_piece`, number of pieces,
#: depth at its end (m).
FIRST, PIECES, END_DEPTH = range(3)


class SpatialRows(NamedTuple):
    """A path; read only.

    Attributes:
        plan: the planar rows, with lengths, speeds and kinds of joints as they are in three dimensions.
        depth: row of each subpath, see above.
        depth_piece: numbers of all pieces of depth, one after another.
    """

    plan: PathRows
    depth: Any
    depth_piece: Any


@pure
def evaluate_spatial(path: SpatialRows, i: int, t: float) -> SpatialPoint:
    """Return the point at t in [0, 1] of subpath i (from 0)."""
    x, y, dx, dy, ddx, ddy = evaluate(path.plan, path.plan.subpath[i], t)
    z, dz, ddz = _depth(path.depth_piece, path.depth[i], t)
    return SpatialPoint(x, y, z, dx, dy, dz, ddx, ddy, ddz)


@pure
def _depth(piece: Any, row: Any, t: float) -> tuple[float, float, float]:
    """Return depth and both its derivatives with respect to t, m."""
    low, high, first = 0, int(row[PIECES]), int(row[FIRST])
    while high - low > 1:
        middle = (low + high) // 2
        if t >= piece[first + DEPTH_WIDTH * middle]:
            low = middle
        else:
            high = middle
    begin = first + DEPTH_WIDTH * low
    scale = piece[begin + 1]
    u = (t - piece[begin]) * scale - 1.0
    z = dz = half_ddz = 0.0
    for k in range(begin + 2, begin + DEPTH_WIDTH):
        half_ddz = half_ddz * u + dz
        dz = dz * u + z
        z = z * u + piece[k]
    return z, dz * scale, half_ddz * 2.0 * scale * scale


def spatial_rows(path: SpatialPath) -> SpatialRows:
    """Return a path as numbers."""
    planar = path.plan.rows
    depth: list[tuple[float, ...]] = []
    pieces: list[float] = []
    lengths = [_length(path, i) for i in range(path.n)]
    subpaths = []
    for i in range(path.n):
        row = list(planar.subpath[i])
        row[LENGTH], row[AFTER] = lengths[i], math.fsum(lengths[i + 1 :])
        row[SPEED] = tangent_of(path.evaluate(i, 0.0)).speed
        if i < len(path.joints):
            row[JOINT] = CORNER if path.joints[i].is_corner else SMOOTH
        subpaths.append(tuple(row))
        own = _fitted_depth(path, i)
        depth.append((float(len(pieces)), float(len(own) // DEPTH_WIDTH), path.evaluate(i, 1.0).z))
        pieces += own
    return SpatialRows(PathRows(path.n, tuple(subpaths), planar.piece), tuple(depth), pieces)


class _DepthOverT:
    """Depth of a subpath as the first axis of a curve, which `fitted_row` fits."""

    kind = "depth"

    def __init__(self, path: SpatialPath, i: int) -> None:
        self._path, self._i = path, i

    def evaluate(self, t: Any) -> PathPoint:
        """Depth and its derivatives in the place of x, dx and ddx."""
        points = [self._path.evaluate(self._i, float(one)) for one in np.atleast_1d(t)]
        z, dz, ddz = (np.array([getattr(p, name) for p in points]) for name in ("z", "dz", "ddz"))
        none = np.zeros(len(points))
        return PathPoint(z, none, dz, none, ddz, none)  # type: ignore[arg-type]


def _fitted_depth(path: SpatialPath, i: int) -> list[float]:
    """Return the pieces of a subpath's depth."""
    _, *numbers = fitted_row(_DepthOverT(path, i))  # type: ignore[arg-type]
    found: list[float] = []
    for begin in range(0, len(numbers), FITTED_WIDTH):
        found += numbers[begin : begin + DEPTH_WIDTH]
    return found


def _length(path: SpatialPath, i: int) -> float:
    """Length of a subpath in three dimensions, m."""
    nodes, weights = np.polynomial.legendre.leggauss(32)
    speeds = [tangent_of(path.evaluate(i, 0.5 + 0.5 * float(node))).speed for node in nodes]
    return float(0.5 * np.dot(weights, speeds))
