"""The share of the path that was flown, and the stretches that were missed.

The path counts as equal cells of at most `SPACING` of path length, see `path_cells`. A cell is flown when,
between two consecutive rows of the run under way,

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

A path in three dimensions is measured the same way: lengths, distances and tangents have a third component,
and a joint at which only the elevation jumps is a corner as well.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.path_cells import (
    CELL_DOWN,
    CELL_REACH,
    CELL_X,
    CELL_Y,
    CELL_Z,
    KNOT_METRES,
    KNOT_S,
    REACH_AT_CORNERS,
    Cells,
    cells_of,
    middles_of,
)
from auv_sim.flight.run_record import Run, SpatialRun

Array = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

#: How far ahead of the virtual point and how far behind it a cell can be flown, m of path.
AHEAD: Final = 10.0
BEHIND: Final = 30.0
#: Least advance along the path per metre of track: a track across the path or against it flies nothing of it.
LEAST_ADVANCE: Final = 0.1
_CHUNK = 2048
_LISTED = 6


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


def flown_share(run: Run, path: CompositePath | SpatialPath, begin: float = 0.0) -> FlownShare:
    """Return the share of the path that a run flew.

    Args:
        run: its rows under way, as `metrics.under_way` selects them; for a path in three dimensions a
            `SpatialRun`.
        path: what it followed, NED.
        begin: s of Eq. (1) at which the mission began.
    """
    cells = cells_of(path)
    metres = np.interp(run.s, cells.knots[:, KNOT_S], cells.knots[:, KNOT_METRES])
    z = run.depth if isinstance(path, SpatialPath) and isinstance(run, SpatialRun) else None
    return share_of(
        cells, _flown(cells, metres, *run.track, z), _skipped(cells, metres, run.held > 0.0), begin
    )


def _flown(cells: Cells, metres: Array, x: Array, y: Array, z: Array | None = None) -> Flags:
    """Return which cells a track passes.

    Args:
        cells: the path, n cells.
        metres: shape (k,), where the virtual point is at each row, m of path.
        x, y, z: shape (k,), the track, NED, m; without z in the plane.

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
        flags[candidates[_passed(cells.cells[candidates], x, y, z, rows[row])]] = True
    return flags


def _passed(cell: Array, x: Array, y: Array, z: Array | None, k: npt.NDArray[np.int64]) -> Flags:
    """Return whether the track passes each cell, shape (m, 5) or (m, 7), between rows k and k + 1."""
    cx, cy, north, east, reach = cell.T[: CELL_REACH + 1]
    x0, y0 = x[k], y[k]
    dx, dy = x[k + 1] - x0, y[k + 1] - y0
    squared, ahead, along = dx * dx + dy * dy, (cx - x0) * dx + (cy - y0) * dy, north * dx + east * dy
    if z is not None:
        cz, z0 = cell[:, CELL_Z], z[k]
        dz = z[k + 1] - z0
        squared, ahead, along = squared + dz * dz, ahead + (cz - z0) * dz, along + cell[:, CELL_DOWN] * dz
    with np.errstate(divide="ignore", invalid="ignore"):
        u = np.clip(ahead / squared, 0.0, 1.0)
    off_x, off_y = x0 + u * dx - cx, y0 + u * dy - cy
    off = off_x * off_x + off_y * off_y
    if z is not None:
        off += (z0 + u * dz - cz) ** 2
    advances = (squared > 0.0) & (along >= LEAST_ADVANCE * np.sqrt(squared))
    passed: Flags = advances & (off <= reach * reach)
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
