"""Where on the path a vehicle goes on after it had to hold: ahead of where it held, and near."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure
from auv_path_following.curves.rows import PathRows, evaluate

#: Distance between the points that are looked at first, m.
_SPACING = 0.5
#: No step is smaller than this, in t: what rounding leaves of the reach is not worth one.
_LEAST_STEP = 1e-9
#: Halvings of that distance afterwards.
_REFINEMENTS = 12


@pure
def closest_ahead(path: PathRows, i: int, t: float, x: float, y: float, reach: float) -> tuple[int, float]:
    """Return the closest point of the next `reach` metres of path; never one behind (i, t).

    The whole path is never searched: where it comes back to itself, the vehicle must not be taken for one
    that has flown more of it than it has.

    Args:
        path: the path.
        i, t: where the virtual point is: subpath (from 0) and t in [0, 1] on it.
        x, y: where the vehicle is, NED, m.
        reach: how far ahead to look along the path, m, measured by chords of half a metre.
    """
    best_i, best_t, best_speed, best = i, t, 0.0, math.inf
    at_i, at_t, left = i, t, reach
    last_x, last_y, _, _, _, _ = evaluate(path, path.subpath[i], t)
    while True:
        at_x, at_y, dx, dy, _, _ = evaluate(path, path.subpath[at_i], at_t)
        speed = max(math.hypot(dx, dy), 1e-9)
        left -= math.hypot(at_x - last_x, at_y - last_y)
        squared = math.pow(at_x - x, 2) + math.pow(at_y - y, 2)
        if squared < best:
            best_i, best_t, best_speed, best = at_i, at_t, speed, squared
        if left <= 0.0 or (at_i + 1 == path.n and at_t >= 1.0):
            break
        last_x, last_y = at_x, at_y
        at_t += max(min(_SPACING, left) / speed, _LEAST_STEP)
        if at_t >= 1.0 and at_i + 1 < path.n:
            at_i, at_t = at_i + 1, 0.0
        at_t = min(at_t, 1.0)
    lowest = t if best_i == i else 0.0
    highest = at_t if best_i == at_i else 1.0
    row, step = path.subpath[best_i], _SPACING / best_speed
    for _ in range(_REFINEMENTS):
        step *= 0.5
        for other in (max(best_t - step, lowest), min(best_t + step, highest)):
            at_x, at_y, _, _, _, _ = evaluate(path, row, other)
            squared = math.pow(at_x - x, 2) + math.pow(at_y - y, 2)
            if squared < best:
                best_t, best = other, squared
    return best_i, best_t
