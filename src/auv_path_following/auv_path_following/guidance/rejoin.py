"""Where on the path a vehicle goes on after it had to hold: ahead of where it held, and near."""

from __future__ import annotations

import math

from auv_path_following.paths.composite import CompositePath

#: Distance between the points that are looked at first, m.
_SPACING = 0.5
#: No step is smaller than this, in t: what rounding leaves of the reach is not worth one.
_LEAST_STEP = 1e-9
#: Halvings of that distance afterwards.
_REFINEMENTS = 12


def closest_ahead(
    path: CompositePath, i: int, t: float, x: float, y: float, reach: float
) -> tuple[int, float]:
    """The closest point of the next `reach` metres of path; never one behind (i, t).

    The whole path is never searched: where it comes back to itself, the vehicle must not be taken for one
    that has flown more of it than it has.

    Args:
        path: the path.
        i, t: where the virtual point is: subpath (from 0) and t in [0, 1] on it.
        x, y: where the vehicle is, NED, m.
        reach: how far ahead to look along the path, m.
    """
    furthest = max(path.distance_to_go(i, t) - reach, 0.0)
    best, best_squared = (i, t), _squared(path, i, t, x, y)
    at_i, at_t = i, t
    while (to_go := path.distance_to_go(at_i, at_t)) > furthest:
        at_i, at_t = _further(path, at_i, at_t, min(_SPACING, to_go - furthest))
        squared = _squared(path, at_i, at_t, x, y)
        if squared < best_squared:
            best, best_squared = (at_i, at_t), squared
        if at_i + 1 == path.n and at_t >= 1.0:
            break
    return _refined(path, best, (i, t), furthest, x, y)


def _further(path: CompositePath, i: int, t: float, step: float) -> tuple[int, float]:
    """A step along the path, of so many metres if the path's speed does not change on the way."""
    ahead = t + max(step / max(path.evaluate(i, t).speed, 1e-9), _LEAST_STEP)
    if ahead < 1.0:
        return i, ahead
    return (i + 1, 0.0) if i + 1 < path.n else (i, 1.0)


def _refined(
    path: CompositePath,
    best: tuple[int, float],
    first: tuple[int, float],
    furthest: float,
    x: float,
    y: float,
) -> tuple[int, float]:
    """`best` moved, within its subpath and reach, to where the tangent is across the way to the vehicle."""
    i, t = best
    lowest = first[1] if i == first[0] else 0.0
    step = _SPACING / max(path.evaluate(i, t).speed, 1e-9)
    squared = _squared(path, i, t, x, y)
    for _ in range(_REFINEMENTS):
        step *= 0.5
        for other in (max(t - step, lowest), min(t + step, 1.0)):
            other_squared = _squared(path, i, other, x, y)
            if other_squared < squared and path.distance_to_go(i, other) >= furthest:
                t, squared = other, other_squared
    return i, t


def _squared(path: CompositePath, i: int, t: float, x: float, y: float) -> float:
    point = path.evaluate(i, t)
    return math.pow(point.x - x, 2) + math.pow(point.y - y, 2)
