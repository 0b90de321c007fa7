"""Find the point of the path at which a vehicle continues after a hold: the closest one ahead."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure
from auv_path_following.curves.rows import PathRows, evaluate

#: Spacing of the coarse search, m.
_SPACING = 0.5
#: Smallest step in t: rounding of the reach must not cause more steps.
_LEAST_STEP = 1e-9
#: Halvings of the spacing afterwards.
_REFINEMENTS = 12


@pure
def closest_ahead(path: PathRows, i: int, t: float, x: float, y: float, reach: float) -> tuple[int, float]:
    """Return the closest point of the next `reach` metres of path; never one behind (i, t).

    The whole path is never searched: where it returns to itself, P must not skip a part of it.

    Args:
        path: the path.
        i, t: of the virtual point: subpath (from 0) and t in [0, 1] on it.
        x, y: position of the vehicle, NED, m.
        reach: length of path to search, m, measured by chords of 0.5 m.
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
