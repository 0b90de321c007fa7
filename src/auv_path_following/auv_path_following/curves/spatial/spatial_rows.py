"""A path in three dimensions as numbers: the planar rows, and for each subpath its depth over t.

The depth of a subpath is kept as polynomial pieces of t, fitted to `pieces.TOLERANCE`; a ramp over a line or
an arc is such a polynomial itself.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_msgs_py.values.pure import pure
from auv_path_following.curves.rows import (
    AFTER,
    CORNER,
    JOINT,
    JOINT_Z,
    LENGTH,
    SMOOTH,
    SPEED,
    PathRows,
    evaluate,
)
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, tangent_of
from auv_path_following.curves.spatial.spatial_segment import DEPTH_WIDTH

#: Columns of a row of depth: where its first piece begins in `SpatialRows.depth_piece`, number of pieces.
FIRST, PIECES = range(2)


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
    # A path that repeats itself holds one subpath many times; its pieces are kept once.
    known: dict[int, tuple[float, float]] = {}
    subpaths = []
    for i, subpath in enumerate(path.subpaths):
        row = list(planar.subpath[i])
        row[LENGTH], row[AFTER] = subpath.length, path.after[i]
        row[SPEED] = tangent_of(path.evaluate(i, 0.0)).speed
        if i < len(path.joints):
            row[JOINT] = CORNER if path.joints[i].is_corner else SMOOTH
            row[JOINT_Z] = path.joints[i].z
        subpaths.append(tuple(row))
        if id(subpath) not in known:
            own = subpath.depth_pieces
            known[id(subpath)] = float(len(pieces)), float(len(own) // DEPTH_WIDTH)
            pieces += own
        depth.append(known[id(subpath)])
    return SpatialRows(PathRows(path.n, tuple(subpaths), planar.piece), tuple(depth), pieces)
