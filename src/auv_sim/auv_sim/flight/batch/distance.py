"""Distance of a vehicle from a subpath, in compiled code."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.angles import TWO_PI
from auv_path_following.curves.closest import samples
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.rows import ARC, KIND, LINE, A, B, C, D, E, PathRows, evaluate
from auv_sim.flight.batch.compiled import compiled

_STEPS = 60
_CLOSE = 1e-13

Array = npt.NDArray[np.float64]


class Outlines(NamedTuple):
    """Points along those subpaths to which the distance has no formula.

    Attributes:
        span: shape (n, 2), begin and end of each subpath's points in `point`.
        point: shape (points, 3), t, x, y, dense enough to resolve every minimum of the distance.
    """

    span: npt.NDArray[np.int64]
    point: Array


def rows_of(path: CompositePath) -> PathRows:
    """Return a path's rows as arrays, all of them."""
    rows = path.rows
    subpath = np.array([rows.subpath[i] for i in range(path.n)])
    return PathRows(path.n, subpath, np.array(rows.piece, np.float64))


def outlines_of(path: CompositePath) -> Outlines:
    """Return a path's outlines."""
    spans: dict[int, tuple[int, int]] = {}
    points = [np.zeros((0, 3))]
    end = 0
    for i, segment in enumerate(path.segments):
        if id(segment) in spans:
            continue
        begin = end
        if abs(path.rows.subpath[i][KIND]) not in (LINE, ARC):
            t = np.linspace(0.0, 1.0, samples(segment) + 1)
            p: Any = segment.evaluate(t)
            points.append(np.stack([t, p.x, p.y], axis=1))
            end += len(t)
        spans[id(segment)] = begin, end
    return Outlines(np.array([spans[id(segment)] for segment in path.segments]), np.concatenate(points))


@compiled
def distance_to(path: PathRows, outlines: Outlines, i: int, x: float, y: float) -> float:
    """Return the closest distance to subpath i (from 0), its ends included, m; as `closest_distance`."""
    row: Any = path.subpath[i]
    kind = abs(row[KIND])
    if kind == LINE:
        ex, ey, dx, dy = x - row[A], y - row[B], row[C], row[D]
        t = min(max((ex * dx + ey * dy) / (dx * dx + dy * dy), 0.0), 1.0)
        ex, ey = ex - t * dx, ey - t * dy
        away: float = math.sqrt(ex * ex + ey * ey)
        return away
    if kind == ARC:
        ex, ey, radius, a0, sweep = x - row[A], y - row[B], row[C], row[D], row[E]
        bearing = math.atan2(ey, ex) - a0
        along = bearing % TWO_PI if sweep > 0.0 else (-bearing) % TWO_PI
        if along <= abs(sweep):
            inside: float = abs(math.sqrt(ex * ex + ey * ey) - radius)
            return inside
        a1 = a0 + sweep
        start = math.hypot(ex - radius * math.cos(a0), ey - radius * math.sin(a0))
        return min(start, math.hypot(ex - radius * math.cos(a1), ey - radius * math.sin(a1)))
    point = outlines.point
    best: float = math.inf
    first, last = outlines.span[i, 0], outlines.span[i, 1] - 1
    before = math.inf
    here = (point[first, 1] - x) ** 2 + (point[first, 2] - y) ** 2
    for k in range(first, last + 1):
        after = math.inf
        if k < last:
            after = (point[k + 1, 1] - x) ** 2 + (point[k + 1, 2] - y) ** 2
        if here <= before and here <= after:
            low, high = point[max(k - 1, first), 0], point[min(k + 1, last), 0]
            best = min(best, _valley(path, row, x, y, point[k, 0], low, high))
        before, here = here, after
    return best


@compiled
def _valley(path: PathRows, row: Any, x: float, y: float, t: float, low: float, high: float) -> float:
    """Return the least distance between t = low and t = high, by Newton's method guarded by bisection."""
    for _ in range(_STEPS):
        p_x, p_y, dx, dy, ddx, ddy = evaluate(path, row, t)
        ex, ey = p_x - x, p_y - y
        slope = ex * dx + ey * dy
        bend = dx * dx + dy * dy + ex * ddx + ey * ddy
        if slope <= 0.0:
            low = t
        if slope >= 0.0:
            high = t
        new = t - slope / bend if bend > 0.0 else -1.0
        if not low <= new <= high:
            new = 0.5 * (low + high)
        done = abs(new - t) <= _CLOSE
        t = new
        if done:
            break
    p_x, p_y, _, _, _, _ = evaluate(path, row, t)
    return math.hypot(p_x - x, p_y - y)
