"""The path at one place, and how far a vehicle is from it: the compiled side of `curve`."""

from __future__ import annotations

import math

from auv_msgs_py.angles import TWO_PI
from auv_path_following.paths.segment import PathPoint
from auv_sim.batch.compiled import compiled
from auv_sim.batch.curve import (
    ARC,
    DEGREE,
    END_OF_PIECES,
    END_OF_POINTS,
    FIRST_PIECE,
    FIRST_POINT,
    KIND,
    LINE,
    SCALE,
    START,
    TABLE,
    A,
    B,
    C,
    Curve,
    D,
    E,
)

_STEPS = 60
_CLOSE = 1e-13


@compiled
def evaluate(curve: Curve, i: int, t: float) -> PathPoint:
    """The point at t in [0, 1] of subpath i (from 0), as `CompositePath.evaluate`."""
    row = curve.subpath
    if row[i, KIND] == LINE:
        dx, dy = row[i, C], row[i, D]
        return PathPoint(row[i, A] + dx * t, row[i, B] + dy * t, dx, dy, 0.0, 0.0)
    if row[i, KIND] == ARC:
        sweep = row[i, E]
        a = row[i, D] + t * sweep
        north = row[i, C] * math.cos(a)
        east = row[i, C] * math.sin(a)
        turn = -sweep * sweep
        return PathPoint(
            row[i, A] + north, row[i, B] + east, -sweep * east, sweep * north, turn * north, turn * east
        )
    piece = curve.piece
    low, high = int(row[i, FIRST_PIECE]), int(row[i, END_OF_PIECES])
    while high - low > 1:
        centre = (low + high) // 2
        if t >= piece[centre, START]:
            low = centre
        else:
            high = centre
    u = (t - piece[low, START]) * piece[low, SCALE] - 1.0
    x = y = dx = dy = ddx = ddy = 0.0
    for k in range(TABLE, TABLE + DEGREE + 1):
        x = x * u + piece[low, k]
        y = y * u + piece[low, k + DEGREE + 1]
        dx = dx * u + piece[low, k + 2 * (DEGREE + 1)]
        dy = dy * u + piece[low, k + 3 * (DEGREE + 1)]
        ddx = ddx * u + piece[low, k + 4 * (DEGREE + 1)]
        ddy = ddy * u + piece[low, k + 5 * (DEGREE + 1)]
    return PathPoint(x, y, dx, dy, ddx, ddy)


@compiled
def distance_to(curve: Curve, i: int, x: float, y: float) -> float:
    """Closest distance to subpath i (from 0), its ends included, m; as `closest_distance`."""
    row = curve.subpath
    if row[i, KIND] == LINE:
        ex, ey, dx, dy = x - row[i, A], y - row[i, B], row[i, C], row[i, D]
        t = min(max((ex * dx + ey * dy) / (dx * dx + dy * dy), 0.0), 1.0)
        ex, ey = ex - t * dx, ey - t * dy
        away: float = math.sqrt(ex * ex + ey * ey)
        return away
    if row[i, KIND] == ARC:
        ex, ey, radius, a0, sweep = x - row[i, A], y - row[i, B], row[i, C], row[i, D], row[i, E]
        bearing = math.atan2(ey, ex) - a0
        along = bearing % TWO_PI if sweep > 0.0 else (-bearing) % TWO_PI
        if along <= abs(sweep):
            inside: float = abs(math.sqrt(ex * ex + ey * ey) - radius)
            return inside
        a1 = a0 + sweep
        start = math.hypot(ex - radius * math.cos(a0), ey - radius * math.sin(a0))
        return min(start, math.hypot(ex - radius * math.cos(a1), ey - radius * math.sin(a1)))
    point = curve.point
    best: float = math.inf
    first, last = int(row[i, FIRST_POINT]), int(row[i, END_OF_POINTS]) - 1
    before = math.inf
    here = (point[first, 1] - x) ** 2 + (point[first, 2] - y) ** 2
    for k in range(first, last + 1):
        after = math.inf
        if k < last:
            after = (point[k + 1, 1] - x) ** 2 + (point[k + 1, 2] - y) ** 2
        if here <= before and here <= after:
            low, high = point[max(k - 1, first), 0], point[min(k + 1, last), 0]
            best = min(best, _valley(curve, i, x, y, point[k, 0], low, high))
        before, here = here, after
    return best


@compiled
def _valley(curve: Curve, i: int, x: float, y: float, t: float, low: float, high: float) -> float:
    """The least distance between t = low and t = high: Newton's method, held inside by bisection."""
    for _ in range(_STEPS):
        p = evaluate(curve, i, t)
        ex, ey = p.x - x, p.y - y
        slope = ex * p.dx + ey * p.dy
        bend = p.dx * p.dx + p.dy * p.dy + ex * p.ddx + ey * p.ddy
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
    p = evaluate(curve, i, t)
    return math.hypot(p.x - x, p.y - y)
