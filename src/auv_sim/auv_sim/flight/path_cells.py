"""A path divided into cells of equal length, in the plane or in three dimensions, and its corners."""

from __future__ import annotations

import math
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

#: A corner is the path within this distance of a G0 joint, on the two subpaths that it joins, m.
CORNER_RADIUS: Final = 30.0
#: Longest cell of path, m.
SPACING: Final = 0.5
#: Largest distance of the track from a flown cell, away from corners and at them, m.
REACH: Final = 1.0
REACH_AT_CORNERS: Final = 3.0
#: Longest step of the table that leads from s to metres of path, m.
_KNOT_SPACING = 2.0


#: Columns of `Cells.knots` and of `Cells.cells`; the last two of a path in three dimensions only.
KNOT_S, KNOT_METRES = range(2)
CELL_X, CELL_Y, CELL_NORTH, CELL_EAST, CELL_REACH, CELL_Z, CELL_DOWN = range(7)


class Cells(NamedTuple):
    """A path divided into cells of equal length, as plain arrays that compiled code reads, too.

    Attributes:
        spacing: length of a cell, m.
        knots: shape (m, 2), KNOT_S: s of Eq. (1); KNOT_METRES: the metres of path before it.
        cells: shape (n, 5), CELL_X, CELL_Y: the middles, NED, m; CELL_NORTH, CELL_EAST: the unit tangent;
            CELL_REACH: the reach, m. In three dimensions shape (n, 7), with CELL_Z and CELL_DOWN.
    """

    spacing: float
    knots: Array
    cells: Array


class Corner(NamedTuple):
    """A joint at which the course, or in three dimensions the elevation, jumps.

    Attributes:
        number: of the subpath that ends here, counted from 1.
        x, y, z: where it is, NED, m; z is 0 on a planar path.
    """

    number: int
    x: float
    y: float
    z: float


def corners_of(path: CompositePath | SpatialPath) -> list[Corner]:
    """Return the corners of a path."""
    if isinstance(path, SpatialPath):
        return [Corner(k, *joint[:3]) for k, joint in enumerate(path.joints, 1) if joint.is_corner]
    return [Corner(joint.index, joint.x, joint.y, 0.0) for joint in path.joints if joint.geometric == "G0"]


def apart(dx: Array, dy: Array, dz: Array | None) -> Array:
    """Return lengths, m; `dz` None in the plane."""
    return np.asarray(np.hypot(dx, dy) if dz is None else np.sqrt(dx * dx + dy * dy + dz * dz))


def cells_of(path: CompositePath | SpatialPath) -> Cells:
    """Divide a path into cells."""
    knots = _knots(path)
    is_spatial = isinstance(path, SpatialPath)
    n = max(1, math.ceil(path.length / SPACING))
    spacing = path.length / n
    s = np.interp((np.arange(n) + 0.5) * spacing, knots[:, KNOT_METRES], knots[:, KNOT_S])
    subpath = np.minimum(s.astype(np.int64), path.n - 1)
    cells = np.empty((n, 7 if is_spatial else 5))
    for i, rows in _groups(subpath):
        p = _points(path, i, s[rows] - i)
        cells[rows, CELL_X], cells[rows, CELL_Y] = p.x, p.y
        cells[rows, CELL_NORTH], cells[rows, CELL_EAST] = p.dx, p.dy
        if is_spatial:
            cells[rows, CELL_Z], cells[rows, CELL_DOWN] = p.z, p.dz
    speed = apart(cells[:, CELL_NORTH], cells[:, CELL_EAST], cells[:, CELL_DOWN] if is_spatial else None)
    cells[:, CELL_NORTH : CELL_EAST + 1] /= speed[:, None]
    if is_spatial:
        cells[:, CELL_DOWN] /= speed
    cells[:, CELL_REACH] = np.where(_at_corners(path, subpath, cells), REACH_AT_CORNERS, REACH)
    return Cells(spacing, knots, cells)


def metres_of(path: CompositePath | SpatialPath, s: Array) -> Array:
    """Return the metres of path before each s of Eq. (1), shape (n,); NaN where s is."""
    knots = _knots(path)
    metres: Array = np.interp(s, knots[:, KNOT_S], knots[:, KNOT_METRES])
    return metres


def _points(path: CompositePath | SpatialPath, i: int, t: Array) -> Any:
    if isinstance(path, SpatialPath):
        return path.sampled(i, t)
    several: Any = t
    return path.evaluate(i, several)


def _lengths(path: CompositePath | SpatialPath) -> list[float]:
    if isinstance(path, SpatialPath):
        return [subpath.length for subpath in path.subpaths]
    return [segment.length for segment in path.segments]


def _knots(path: CompositePath | SpatialPath) -> Array:
    """Return metres of path over s: exact at the joints, by the midpoint rule between them."""
    s, metres = [np.zeros(1)], [np.zeros(1)]
    is_spatial = isinstance(path, SpatialPath)
    for i, length in enumerate(_lengths(path)):
        n = max(1, math.ceil(length / _KNOT_SPACING))
        steps = np.full(1, length)
        if n > 1:
            p = _points(path, i, (np.arange(n) + 0.5) / n)
            steps = apart(p.dx, p.dy, p.dz if is_spatial else None)
            steps *= length / steps.sum()
        s.append(i + np.arange(1, n + 1) / n)
        metres.append(steps)
    return np.column_stack([np.concatenate(s), np.cumsum(np.concatenate(metres))])


def _groups(subpath: npt.NDArray[np.int64]) -> list[tuple[int, slice]]:
    """Return the rows of each subpath that has any; `subpath` is sorted."""
    first = np.flatnonzero(np.diff(subpath, prepend=-1))
    ends = [*first[1:].tolist(), len(subpath)]
    return [(int(subpath[a]), slice(a, b)) for a, b in zip(first.tolist(), ends, strict=True)]


def _at_corners(path: CompositePath | SpatialPath, subpath: npt.NDArray[np.int64], cells: Array) -> Flags:
    near = np.zeros(len(cells), bool)
    for corner in corners_of(path):
        first, end = np.searchsorted(subpath, (corner.number - 1, corner.number + 1))
        part = cells[first:end]
        down = part[:, CELL_Z] - corner.z if isinstance(path, SpatialPath) else None
        near[first:end] |= (
            apart(part[:, CELL_X] - corner.x, part[:, CELL_Y] - corner.y, down) <= CORNER_RADIUS
        )
    return near


def middles_of(cells: Cells) -> Array:
    """Return the middles of the cells, shape (n,), m of path."""
    middles: Array = (np.arange(len(cells.cells), dtype=np.float64) + 0.5) * cells.spacing
    return middles
