"""The share of the path that was flown, and the stretches that were missed.

The path counts as equal cells of at most `SPACING` of path length. A cell is flown when, between two
consecutive rows of the run under way,

- the vehicle's true track, taken as straight between the rows, passes the cell's middle within its reach:
  `REACH`, or `REACH_AT_CORNERS` within `CORNER_RADIUS` of a G0 joint on the two subpaths that it joins,
- the vehicle advances along the path there, by at least `LEAST_ADVANCE` for each metre of track, and
- the virtual point, at the earlier of the two rows, is at most `AHEAD` short of the cell's middle and at most
  `BEHIND` beyond it, in metres of path.

The last condition keeps legs apart that lie side by side, cross, or repeat each other: a cell is matched only
while guidance follows its surroundings. `BEHIND` is the larger one because a circle of acceptance moves the
virtual point to the joint while the vehicle still approaches it.

The share is the flown length over the length from where the mission began to the end of the path. Cells that
were not flown because guidance rejoined the path ahead after a hold count in neither. What a recording lacks
was not flown.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.run_record import Run

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

#: A corner is the path within this distance of a G0 joint, on the two subpaths that it joins, m.
CORNER_RADIUS: Final = 30.0
#: Longest cell of path, m.
SPACING: Final = 0.5
#: Largest distance of the track from a flown cell, away from corners and at them, m.
REACH: Final = 1.0
REACH_AT_CORNERS: Final = 3.0
#: How far ahead of the virtual point and how far behind it a cell can be flown, m of path.
AHEAD: Final = 10.0
BEHIND: Final = 30.0
#: Least advance along the path per metre of track: a track across the path or against it flies nothing of it.
LEAST_ADVANCE: Final = 0.1
#: Longest step of the table that leads from s to metres of path, m.
_KNOT_SPACING = 2.0
_CHUNK = 2048
_LISTED = 6


#: Columns of `Cells.knots` and of `Cells.cells`.
KNOT_S, KNOT_METRES = range(2)
CELL_X, CELL_Y, CELL_NORTH, CELL_EAST, CELL_REACH = range(5)


class Cells(NamedTuple):
    """A path divided into cells of equal length, as plain arrays that compiled code reads, too.

    Attributes:
        spacing: length of a cell, m.
        knots: shape (m, 2), KNOT_S: s of Eq. (1); KNOT_METRES: the metres of path before it.
        cells: shape (n, 5), CELL_X, CELL_Y: the middles, NED, m; CELL_NORTH, CELL_EAST: the unit tangent;
            CELL_REACH: the reach, m.
    """

    spacing: float
    knots: Array
    cells: Array


class Stretch(NamedTuple):
    """A part of the path, in metres from the path's start."""

    begin: float
    end: float

    def __str__(self) -> str:
        return f"{self.begin:.1f} to {self.end:.1f} m"


@dataclass(frozen=True)
class FlownShare:
    """The share of the path that was flown, as this module defines it.

    Attributes:
        share: of the path from the mission's start, without skipped stretches, 0 to 1; NaN without any path.
        missed: stretches that were not flown.
        skipped: stretches that a rejoin after a hold skipped.
    """

    share: float
    missed: tuple[Stretch, ...]
    skipped: tuple[Stretch, ...]


def listed(stretches: tuple[Stretch, ...]) -> str:
    """Return the stretches as text; only the first of many."""
    more = len(stretches) - _LISTED
    words = [str(stretch) for stretch in stretches[:_LISTED]] + ([f"{more} more"] if more > 0 else [])
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1]))) if words else "nothing"


def percent(share: float) -> str:
    """Return a share in percent, rounded down, because 98.996 % is less than 99 %."""
    return "-" if math.isnan(share) else f"{math.floor(1e4 * share) / 100.0:.2f} %"


def cells_of(path: CompositePath) -> Cells:
    """Divide a path into cells."""
    knots = _knots(path)
    n = max(1, math.ceil(path.length / SPACING))
    spacing = path.length / n
    s = np.interp((np.arange(n) + 0.5) * spacing, knots[:, KNOT_METRES], knots[:, KNOT_S])
    subpath = np.minimum(s.astype(np.int64), path.n - 1)
    cells = np.empty((n, 5))
    for i, rows in _groups(subpath):
        p: Any = path.evaluate(i, s[rows] - i)
        cells[rows, CELL_X], cells[rows, CELL_Y] = p.x, p.y
        cells[rows, CELL_NORTH], cells[rows, CELL_EAST] = p.dx, p.dy
    tangent = cells[:, CELL_NORTH : CELL_EAST + 1]
    tangent /= np.hypot(cells[:, CELL_NORTH], cells[:, CELL_EAST])[:, None]
    cells[:, CELL_REACH] = np.where(_at_corners(path, subpath, cells), REACH_AT_CORNERS, REACH)
    return Cells(spacing, knots, cells)


def _knots(path: CompositePath) -> Array:
    """Return metres of path over s: exact at the joints, by the midpoint rule between them."""
    s, metres = [np.zeros(1)], [np.zeros(1)]
    for i, segment in enumerate(path.segments):
        n = max(1, math.ceil(segment.length / _KNOT_SPACING))
        steps = np.full(1, segment.length)
        if n > 1:
            p: Any = segment.evaluate((np.arange(n) + 0.5) / n)
            steps = np.hypot(p.dx, p.dy)
            steps *= segment.length / steps.sum()
        s.append(i + np.arange(1, n + 1) / n)
        metres.append(steps)
    return np.column_stack([np.concatenate(s), np.cumsum(np.concatenate(metres))])


def _groups(subpath: npt.NDArray[np.int64]) -> list[tuple[int, slice]]:
    """Return the rows of each subpath that has any; `subpath` is sorted."""
    first = np.flatnonzero(np.diff(subpath, prepend=-1))
    ends = [*first[1:].tolist(), len(subpath)]
    return [(int(subpath[a]), slice(a, b)) for a, b in zip(first.tolist(), ends, strict=True)]


def _at_corners(path: CompositePath, subpath: npt.NDArray[np.int64], cells: Array) -> Flags:
    near = np.zeros(len(cells), bool)
    for joint in path.joints:
        if joint.geometric == "G0":
            first, end = np.searchsorted(subpath, (joint.index - 1, joint.index + 1))
            x, y = cells[first:end, CELL_X], cells[first:end, CELL_Y]
            near[first:end] |= np.hypot(x - joint.x, y - joint.y) <= CORNER_RADIUS
    return near


def middles_of(cells: Cells) -> Array:
    """Return the middles of the cells, shape (n,), m of path."""
    middles: Array = (np.arange(len(cells.cells), dtype=np.float64) + 0.5) * cells.spacing
    return middles


def flown_share(run: Run, path: CompositePath, begin: float = 0.0) -> FlownShare:
    """Return the share of the path that a run flew.

    Args:
        run: its rows under way, as `metrics.under_way` selects them.
        path: what it followed, NED.
        begin: s of Eq. (1) at which the mission began.
    """
    cells = cells_of(path)
    metres = np.interp(run.s, cells.knots[:, KNOT_S], cells.knots[:, KNOT_METRES])
    return share_of(cells, _flown(cells, metres, *run.track), _skipped(cells, metres, run.held > 0.0), begin)


def _flown(cells: Cells, metres: Array, x: Array, y: Array) -> Flags:
    """Return which cells a track passes.

    Args:
        cells: the path, n cells.
        metres: shape (k,), where the virtual point is at each row, m of path.
        x, y: shape (k,), the track, NED, m.

    Returns:
        shape (n,).
    """
    flags = np.zeros(len(cells.cells), bool)
    cx, cy = (np.ascontiguousarray(cells.cells[:, column]) for column in (CELL_X, CELL_Y))
    first, last = window(cells, metres[:-1])
    longest = np.hypot(np.diff(x), np.diff(y)) + REACH_AT_CORNERS
    for start in range(0, len(first), _CHUNK):
        rows = np.arange(start, min(start + _CHUNK, len(first)))
        offsets = np.arange(int((last[rows] - first[rows]).max()) + 1)
        cell = np.minimum(first[rows, None] + offsets, last[rows, None])
        # Most cells of a window are too far away for the exact test.
        near = (cx[cell] - x[rows, None]) ** 2 + (cy[cell] - y[rows, None]) ** 2 <= longest[rows, None] ** 2
        row, offset = np.nonzero(near)
        candidates = cell[row, offset]
        flags[candidates[_passed(cells.cells[candidates], x, y, rows[row])]] = True
    return flags


def _passed(cell: Array, x: Array, y: Array, k: npt.NDArray[np.int64]) -> Flags:
    """Return whether the track passes each cell, shape (m, 5), between rows k and k + 1."""
    cx, cy, north, east, reach = cell.T
    x0, y0 = x[k], y[k]
    dx, dy = x[k + 1] - x0, y[k + 1] - y0
    squared = dx * dx + dy * dy
    with np.errstate(divide="ignore", invalid="ignore"):
        u = np.clip(((cx - x0) * dx + (cy - y0) * dy) / squared, 0.0, 1.0)
    off_x, off_y = x0 + u * dx - cx, y0 + u * dy - cy
    advances = (squared > 0.0) & (north * dx + east * dy >= LEAST_ADVANCE * np.sqrt(squared))
    passed: Flags = advances & (off_x * off_x + off_y * off_y <= reach * reach)
    return passed


def window(cells: Cells, metres: Any) -> tuple[Any, Any]:
    """Return the first and the last cell that can be flown with the virtual point at `metres` of path."""
    first = np.ceil((metres - BEHIND) / cells.spacing - 0.5)
    last = np.floor((metres + AHEAD) / cells.spacing - 0.5)
    most = len(cells.cells) - 1
    return np.clip(first, 0, most).astype(np.int64), np.clip(last, 0, most).astype(np.int64)


def _skipped(cells: Cells, metres: Array, held: Flags) -> Flags:
    """Return which cells lie between the virtual point's place in a hold and where it continued."""
    middles = middles_of(cells)
    flags = np.zeros(len(middles), bool)
    edges = np.flatnonzero(np.diff(held.astype(np.int8), prepend=0, append=0)).tolist()
    for first, end in zip(edges[::2], edges[1::2], strict=True):
        before, after = metres[max(first - 1, 0)], metres[min(end, len(metres) - 1)]
        flags |= (middles > before) & (middles < after)
    return flags


def share_of(cells: Cells, flown: Flags, skipped: Flags | None = None, begin: float = 0.0) -> FlownShare:
    """Return the share and the stretches from the state of each cell.

    Args:
        cells: the path.
        flown: shape (n,), whether each cell was flown.
        skipped: shape (n,), whether a rejoin after a hold passed it over.
        begin: s of Eq. (1) at which the mission began.
    """
    start = float(np.interp(begin, cells.knots[:, KNOT_S], cells.knots[:, KNOT_METRES]))
    asked = middles_of(cells) >= start
    left_out = asked & ~flown & skipped if skipped is not None else np.zeros(len(flown), bool)
    counted = asked & ~left_out
    return FlownShare(
        share=float(flown[counted].mean()) if counted.any() else math.nan,
        missed=_stretches(counted & ~flown, cells.spacing),
        skipped=_stretches(left_out, cells.spacing),
    )


def _stretches(flags: Flags, spacing: float) -> tuple[Stretch, ...]:
    edges = np.flatnonzero(np.diff(flags.astype(np.int8), prepend=0, append=0)).tolist()
    return tuple(Stretch(a * spacing, b * spacing) for a, b in zip(edges[::2], edges[1::2], strict=True))
