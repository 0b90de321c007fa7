"""How much of the path was really flown: the share, and the stretches that were missed.

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


class Cells(NamedTuple):
    """A path cut into cells of equal length, as plain arrays that compiled code reads as well.

    Attributes:
        spacing: length of a cell, m.
        knots: shape (m, 2), s of Eq. (1) and the metres of path before it.
        cells: shape (n, 5), the middles: x, y (NED, m), the unit tangent (north, east) and the reach (m).
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
    """How much of the path was flown, as this module defines it.

    Attributes:
        share: of the path from where the mission began, without what was skipped, 0 to 1; NaN without any.
        missed: stretches that were not flown.
        skipped: stretches that a rejoin after a hold skipped.
    """

    share: float
    missed: tuple[Stretch, ...]
    skipped: tuple[Stretch, ...]


def listed(stretches: tuple[Stretch, ...]) -> str:
    """Stretches for people; only the first of many."""
    more = len(stretches) - _LISTED
    words = [str(stretch) for stretch in stretches[:_LISTED]] + ([f"{more} more"] if more > 0 else [])
    return " and ".join(filter(None, (", ".join(words[:-1]), words[-1]))) if words else "nothing"


def percent(share: float) -> str:
    """A share of the path in percent; rounded down, because 98.996 % is less than 99 %."""
    return "-" if math.isnan(share) else f"{math.floor(1e4 * share) / 100.0:.2f} %"


def cells_of(path: CompositePath) -> Cells:
    """Cut a path into cells."""
    knots = _knots(path)
    n = max(1, math.ceil(path.length / SPACING))
    spacing = path.length / n
    s = np.interp((np.arange(n) + 0.5) * spacing, knots[:, 1], knots[:, 0])
    subpath = np.minimum(s.astype(np.int64), path.n - 1)
    cells = np.empty((n, 5))
    for i, rows in _groups(subpath):
        p: Any = path.evaluate(i, s[rows] - i)
        cells[rows, 0], cells[rows, 1], cells[rows, 2], cells[rows, 3] = p.x, p.y, p.dx, p.dy
    cells[:, 2:4] /= np.hypot(cells[:, 2], cells[:, 3])[:, None]
    cells[:, 4] = np.where(_at_corners(path, subpath, cells), REACH_AT_CORNERS, REACH)
    return Cells(spacing, knots, cells)


def _knots(path: CompositePath) -> Array:
    """Metres of path over s: exact at the joints, by the midpoint rule between them."""
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
    """The rows of each subpath that has any; `subpath` is sorted."""
    first = np.flatnonzero(np.diff(subpath, prepend=-1))
    ends = [*first[1:].tolist(), len(subpath)]
    return [(int(subpath[a]), slice(a, b)) for a, b in zip(first.tolist(), ends, strict=True)]


def _at_corners(path: CompositePath, subpath: npt.NDArray[np.int64], cells: Array) -> Flags:
    near = np.zeros(len(cells), bool)
    for joint in path.joints:
        if joint.geometric == "G0":
            first, end = np.searchsorted(subpath, (joint.index - 1, joint.index + 1))
            x, y = cells[first:end, 0], cells[first:end, 1]
            near[first:end] |= np.hypot(x - joint.x, y - joint.y) <= CORNER_RADIUS
    return near


def middles_of(cells: Cells) -> Array:
    """The middles of the cells, shape (n,), m of path."""
    middles: Array = (np.arange(len(cells.cells), dtype=np.float64) + 0.5) * cells.spacing
    return middles


def flown_share(run: Run, path: CompositePath, begin: float = 0.0) -> FlownShare:
    """How much of the path a run flew.

    Args:
        run: its rows under way, as `metrics.under_way` selects them.
        path: what it followed, NED.
        begin: s of Eq. (1) at which the mission began.
    """
    cells = cells_of(path)
    metres = np.interp(run.s, cells.knots[:, 0], cells.knots[:, 1])
    return share_of(cells, _flown(cells, metres, *run.track), _skipped(cells, metres, run.held > 0.0), begin)


def _flown(cells: Cells, metres: Array, x: Array, y: Array) -> Flags:
    """Which cells a track passes.

    Args:
        cells: the path, n cells.
        metres: shape (k,), where the virtual point is at each row, m of path.
        x, y: shape (k,), the track, NED, m.

    Returns:
        shape (n,).
    """
    flags = np.zeros(len(cells.cells), bool)
    cx, cy = np.ascontiguousarray(cells.cells[:, 0]), np.ascontiguousarray(cells.cells[:, 1])
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
    """Whether the track passes each cell, shape (m, 5), between rows k and k + 1."""
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
    """The first and the last cell that can be flown with the virtual point at `metres` of path."""
    first = np.ceil((metres - BEHIND) / cells.spacing - 0.5)
    last = np.floor((metres + AHEAD) / cells.spacing - 0.5)
    most = len(cells.cells) - 1
    return np.clip(first, 0, most).astype(np.int64), np.clip(last, 0, most).astype(np.int64)


def _skipped(cells: Cells, metres: Array, held: Flags) -> Flags:
    """Which cells lie between where the virtual point rested in a hold and where it went on."""
    middles = middles_of(cells)
    flags = np.zeros(len(middles), bool)
    edges = np.flatnonzero(np.diff(held.astype(np.int8), prepend=0, append=0)).tolist()
    for first, end in zip(edges[::2], edges[1::2], strict=True):
        before, after = metres[max(first - 1, 0)], metres[min(end, len(metres) - 1)]
        flags |= (middles > before) & (middles < after)
    return flags


def share_of(cells: Cells, flown: Flags, skipped: Flags | None = None, begin: float = 0.0) -> FlownShare:
    """The share and the stretches from what each cell is.

    Args:
        cells: the path.
        flown: shape (n,), whether each cell was flown.
        skipped: shape (n,), whether a rejoin after a hold passed it over.
        begin: s of Eq. (1) at which the mission began.
    """
    start = float(np.interp(begin, cells.knots[:, 0], cells.knots[:, 1]))
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
