"""Distance of a vehicle from a subpath in three dimensions, in compiled code.

Level lines and arcs, and straight slopes, have formulas. On other subpaths the closest place is tracked from
odometry to odometry: it lies in a stretch of the subpath outside of which every place was at least `beyond`
away at the last search of the whole subpath, less the way that the vehicle has covered since.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.rows import ARC, KIND, LINE, PathRows
from auv_path_following.curves.spatial.closest_in_space import coarse_places
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_rows import SpatialRows, evaluate_spatial, spatial_rows
from auv_path_following.curves.spatial.spatial_segment import DEPTH_WIDTH
from auv_sim.flight.batch.compiled import compiled
from auv_sim.flight.batch.distance import Outlines, distance_to

_STEPS = 60
#: From a step of this size on, the place is where its first and second derivative lead.
_CLOSE = 1e-6
#: Half of the tracked stretch, in intervals of the sampling.
_REACH = 2
#: The closest place is tracked while the distance bends at least this much, in shares of |p'|^2: near a
#: centre of curvature all places are about as close.
_LEAST_BEND = 0.5
#: More than the way between two samples, in units of their straight distance.
_LONGER = 1.05

#: Columns of `SpatialOutlines.rule`: how a distance is found, and the depth of a level subpath, m.
RULE, LEVEL_DEPTH = range(2)
LEVEL, STRAIGHT, SEARCHED = map(float, range(3))

Array = npt.NDArray[np.float64]


class SpatialOutlines(NamedTuple):
    """How to find distances to each subpath, and points along those that are searched.

    Attributes:
        plan: of the path seen from above, for level lines and arcs; without points.
        rule: shape (n, 2), RULE and LEVEL_DEPTH.
        span: shape (n, 2), begin and end of each subpath's points in `point`.
        point: shape (points, 4), t, x, y, z, dense enough to resolve every minimum of the distance.
        apart: shape (n,), longest way between neighbouring points, m.
    """

    plan: Outlines
    rule: Array
    span: npt.NDArray[np.int64]
    point: Array
    apart: Array


class Nearest(NamedTuple):
    """The tracked place on the subpath that is followed.

    Attributes:
        t, low, high: the closest place, and the stretch that it lies in.
        beyond: no place outside of the stretch is closer than this, m; negative: not known.
    """

    t: float
    low: float
    high: float
    beyond: float


UNTRACKED = Nearest(0.0, 0.0, 1.0, -1.0)


def spatial_arrays_of(path: SpatialPath) -> SpatialRows:
    """Return a path's rows as arrays."""
    plan, depth, piece = spatial_rows(path)
    arrays = PathRows(plan.n, np.array(plan.subpath), np.array(plan.piece, np.float64))
    return SpatialRows(arrays, np.array(depth), np.array(piece))


def spatial_outlines_of(path: SpatialPath) -> SpatialOutlines:
    """Return a path's outlines."""
    rule, spans, points = np.zeros((path.n, 2)), [], [np.zeros((0, 4))]
    known: dict[int, tuple[int, int, float]] = {}
    end = 0
    for i, subpath in enumerate(path.subpaths):
        rule[i] = _rule_of(abs(path.plan.rows.subpath[i][KIND]), subpath.depth_pieces)
        if rule[i, RULE] == SEARCHED and id(subpath) not in known:
            t = coarse_places(subpath)
            p: Any = path.sampled(i, t)
            points.append(np.stack([t, p.x, p.y, p.z], axis=1))
            chords = np.sqrt((np.diff(points[-1][:, 1:], axis=0) ** 2).sum(axis=1))
            known[id(subpath)] = end, end + len(t), _LONGER * float(chords.max())
            end += len(t)
        spans.append(known.get(id(subpath), (0, 0, 0.0)))
    span = np.array([(first, after) for first, after, _ in spans], np.int64)
    plan = Outlines(np.zeros_like(span), np.zeros((0, 3)))
    gaps = np.array([gap for _, _, gap in spans])
    return SpatialOutlines(plan, rule, span, np.concatenate(points), gaps)


def _rule_of(kind: float, pieces: list[float]) -> tuple[float, float]:
    """Return RULE and LEVEL_DEPTH of a subpath with a kind in the plan and pieces of depth."""
    *curved, slope, depth = pieces[2:DEPTH_WIDTH]
    if kind not in (LINE, ARC) or len(pieces) > DEPTH_WIDTH or any(curved):
        return SEARCHED, 0.0
    if slope == 0.0:
        return LEVEL, depth
    return (STRAIGHT if kind == LINE else SEARCHED), 0.0


@compiled
def off_subpath(
    path: SpatialRows, outlines: SpatialOutlines, nearest: Nearest, i: int, x: float, y: float, z: float,
    covered: float,
) -> tuple[Nearest, float, float]:  # fmt: skip
    """Return the distance from subpath i (from 0), its ends included, and how far below its closest place.

    Args:
        path, outlines: of the path.
        nearest: tracked on this subpath; `UNTRACKED` to search all of it.
        i: the subpath.
        x, y, z: the vehicle, NED, m.
        covered: at most this far from where `nearest` was found, m.

    Returns:
        `nearest` at this place, distance and depth less that of the path, m.
    """
    rule = outlines.rule[i, RULE]
    if rule == LEVEL:
        below = z - outlines.rule[i, LEVEL_DEPTH]
        level = distance_to(path.plan, outlines.plan, i, x, y)
        return nearest, math.sqrt(level * level + below * below), below
    if rule == STRAIGHT:
        p = evaluate_spatial(path, i, 0.0)
        dx, dy, dz = p.dx, p.dy, p.dz
        ex, ey, ez = x - p.x, y - p.y, z - p.z
        t = min(max((ex * dx + ey * dy + ez * dz) / (dx * dx + dy * dy + dz * dz), 0.0), 1.0)
        ex, ey, ez = ex - t * dx, ey - t * dy, ez - t * dz
        return nearest, math.sqrt(ex * ex + ey * ey + ez * ez), ez
    beyond = nearest.beyond - covered
    t, distance, below, is_bent = nearest.t, math.inf, 0.0, False
    if beyond > 0.0:
        t, distance, below, is_bent = _valley(path, i, x, y, z, t, nearest.low, nearest.high)
    if is_bent and distance <= beyond:
        return Nearest(t, nearest.low, nearest.high, beyond), distance, below
    return _searched(path, outlines, i, x, y, z)


@compiled
def _searched(
    path: SpatialRows, outlines: SpatialOutlines, i: int, x: float, y: float, z: float
) -> tuple[Nearest, float, float]:
    """Search all of a subpath: refine every minimum of its sampling."""
    point, first, last = outlines.point, outlines.span[i, 0], outlines.span[i, 1] - 1
    best_t, best, best_below, best_k = 0.0, math.inf, 0.0, first
    before, here = math.inf, _squared_to(point, first, x, y, z)
    for k in range(first, last + 1):
        after = _squared_to(point, k + 1, x, y, z) if k < last else math.inf
        if here <= before and here <= after:
            low, high = point[max(k - 1, first), 0], point[min(k + 1, last), 0]
            t, distance, below, _ = _valley(path, i, x, y, z, point[k, 0], low, high)
            if distance < best:
                best_t, best, best_below, best_k = t, distance, below, k
        before, here = here, after
    low_k, high_k = max(best_k - _REACH, first), min(best_k + _REACH, last)
    closest = math.inf
    for k in range(first, last + 1):
        if (k <= low_k and low_k > first) or (k >= high_k and high_k < last):
            closest = min(closest, _squared_to(point, k, x, y, z))
    # A place between two samples is at most half of their distance from one of them.
    beyond = math.sqrt(closest) - 0.5 * outlines.apart[i]
    return Nearest(best_t, point[low_k, 0], point[high_k, 0], beyond), best, best_below


@compiled
def _squared_to(point: Array, k: int, x: float, y: float, z: float) -> float:
    ex, ey, ez = point[k, 1] - x, point[k, 2] - y, point[k, 3] - z
    return float(ex * ex + ey * ey + ez * ez)


@compiled
def _valley(
    path: SpatialRows, i: int, x: float, y: float, z: float, t: float, low: float, high: float
) -> tuple[float, float, float, bool]:
    """Find the closest place between t = low and t = high, by Newton's method guarded by bisection.

    Returns:
        t, distance, depth less that of the path (m), and whether the distance bends clearly there.
    """
    may_start, may_end = low == 0.0, high == 1.0
    for _ in range(_STEPS):
        p = evaluate_spatial(path, i, t)
        ex, ey, ez = x - p.x, y - p.y, z - p.z
        slope = -(ex * p.dx + ey * p.dy + ez * p.dz)
        speed = p.dx * p.dx + p.dy * p.dy + p.dz * p.dz
        bend = speed - (ex * p.ddx + ey * p.ddy + ez * p.ddz)
        if slope <= 0.0:
            low = t
        if slope >= 0.0:
            high = t
        new = t - slope / bend if bend > 0.0 else -1.0
        if not low <= new <= high:
            new = 0.5 * (low + high)
            # An end of the subpath is tried once: bisection would take many steps to reach it.
            if may_start and slope > 0.0:
                new, may_start = 0.0, False
            elif may_end and slope < 0.0:
                new, may_end = 1.0, False
        step = new - t
        t = new
        if abs(step) <= _CLOSE:
            break
    half = 0.5 * step * step
    ex -= p.dx * step + p.ddx * half
    ey -= p.dy * step + p.ddy * half
    ez -= p.dz * step + p.ddz * half
    return t, math.sqrt(ex * ex + ey * ey + ez * ez), ez, bend >= _LEAST_BEND * speed
