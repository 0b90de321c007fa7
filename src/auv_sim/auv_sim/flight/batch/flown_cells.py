"""Cells of the path that a flight passes: the compiled side of `flight.flown_share`."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from auv_sim.flight.batch.compiled import compiled
from auv_sim.flight.flown_share import AHEAD, BEHIND, LEAST_ADVANCE
from auv_sim.flight.path_cells import (
    CELL_DOWN,
    CELL_EAST,
    CELL_NORTH,
    CELL_REACH,
    CELL_X,
    CELL_Y,
    CELL_Z,
    KNOT_METRES,
    KNOT_S,
    Cells,
)

#: North, east, down, m.
Place = tuple[float, float, float]


@compiled
def pass_cells(
    cells: Cells, flown: npt.NDArray[np.bool_], s: float, x0: float, y0: float, x1: float, y1: float
) -> None:
    """Mark the cells that one step of the track passes.

    Args:
        cells: the path.
        flown: shape (cells,); written.
        s: of the virtual point at the begin of the step, Eq. (1).
        x0, y0, x1, y1: begin and end of the step, NED, m.
    """
    metres = _metres_at(cells, s)
    dx, dy = x1 - x0, y1 - y0
    squared = dx * dx + dy * dy
    if not (squared > 0.0 and math.isfinite(squared)):
        return
    least = LEAST_ADVANCE * math.sqrt(squared)
    first = max(math.ceil((metres - BEHIND) / cells.spacing - 0.5), 0)
    last = min(math.floor((metres + AHEAD) / cells.spacing - 0.5), len(flown) - 1)
    middle = cells.cells
    for k in range(first, last + 1):
        if flown[k] or middle[k, CELL_NORTH] * dx + middle[k, CELL_EAST] * dy < least:
            continue
        cx, cy, reach = middle[k, CELL_X], middle[k, CELL_Y], middle[k, CELL_REACH]
        u = min(max(((cx - x0) * dx + (cy - y0) * dy) / squared, 0.0), 1.0)
        off_x, off_y = x0 + u * dx - cx, y0 + u * dy - cy
        flown[k] = off_x * off_x + off_y * off_y <= reach * reach


@compiled
def pass_cells_in_space(
    cells: Cells, flown: npt.NDArray[np.bool_], s: float, begin: Place, end: Place
) -> None:
    """Mark the cells that one step of the track passes in three dimensions.

    Args:
        cells, flown, s: as of `pass_cells`.
        begin, end: of the step, NED, m.
    """
    metres = _metres_at(cells, s)
    x0, y0, z0 = begin
    dx, dy, dz = end[0] - x0, end[1] - y0, end[2] - z0
    squared = dx * dx + dy * dy + dz * dz
    if not (squared > 0.0 and math.isfinite(squared)):
        return
    least = LEAST_ADVANCE * math.sqrt(squared)
    first = max(math.ceil((metres - BEHIND) / cells.spacing - 0.5), 0)
    last = min(math.floor((metres + AHEAD) / cells.spacing - 0.5), len(flown) - 1)
    middle = cells.cells
    for k in range(first, last + 1):
        if flown[k]:
            continue
        advance = middle[k, CELL_NORTH] * dx + middle[k, CELL_EAST] * dy + middle[k, CELL_DOWN] * dz
        if advance < least:
            continue
        cx, cy, cz, reach = middle[k, CELL_X], middle[k, CELL_Y], middle[k, CELL_Z], middle[k, CELL_REACH]
        u = min(max(((cx - x0) * dx + (cy - y0) * dy + (cz - z0) * dz) / squared, 0.0), 1.0)
        off_x, off_y, off_z = x0 + u * dx - cx, y0 + u * dy - cy, z0 + u * dz - cz
        flown[k] = off_x * off_x + off_y * off_y + off_z * off_z <= reach * reach


@compiled
def _metres_at(cells: Cells, s: float) -> float:
    """Return the metres of path before s, as `numpy.interp` does."""
    knots = cells.knots
    low, high = 0, len(knots) - 1
    while high - low > 1:
        centre = (low + high) // 2
        if s >= knots[centre, KNOT_S]:
            low = centre
        else:
            high = centre
    begin, end = knots[low], knots[high]
    share = min(max((s - begin[KNOT_S]) / (end[KNOT_S] - begin[KNOT_S]), 0.0), 1.0)
    return float(begin[KNOT_METRES] + share * (end[KNOT_METRES] - begin[KNOT_METRES]))
