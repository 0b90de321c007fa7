"""Sampling of a segment: few points on lines and arcs, more where the curvature varies."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.segment import PathPoint, Segment

Array = npt.NDArray[np.float64]

_INTERVALS = {"line": 1, "arc": 16, "fermat": 64, "fermat_mirrored": 64, "clothoid": 64, "spiral": 64}
_INTERVALS_OF_OTHERS = 512
_INTERVALS_OF_A_PIECE = 16


def look(segment: Segment) -> tuple[Array, PathPoint]:
    """Return enough values of t to resolve a segment's curvature, and its points there.

    Args:
        segment: any segment.

    Returns:
        t of shape (m,), from 0 to 1, and the points (arrays of that shape).
    """
    inner = segment.segment if isinstance(segment, Reversed) else segment
    if isinstance(inner, Spline):
        intervals = _INTERVALS_OF_A_PIECE * inner.pieces
    else:
        intervals = _INTERVALS.get(segment.kind, _INTERVALS_OF_OTHERS)
    t = _even(intervals)
    return t, segment.evaluate(t)


@lru_cache(maxsize=64)
def _even(intervals: int) -> Array:
    t = np.linspace(0.0, 1.0, intervals + 1)
    t.flags.writeable = False
    return t


def tightest(segment: Segment) -> tuple[float, float]:
    """Find the point of largest curvature.

    Args:
        segment: any segment.

    Returns:
        t there, and the curvature (1/m, positive to starboard).
    """
    t, point = look(segment)
    for _ in range(4):
        k = int(np.argmax(np.abs(point.kappa)))
        best = float(t[k]), float(np.asarray(point.kappa)[k])
        t = np.linspace(t[max(k - 1, 0)], t[min(k + 1, len(t) - 1)], 33)
        point = segment.evaluate(t)
    return best


def last_stretch(segment: Segment) -> float:
    """Return the t from which on the way to the end is at most half a circle: pi/2 times the straight line.

    All of a line, the last half turn of an arc: an earlier passage near the end does not count.
    """
    if segment.kind == "line":
        return 0.0
    t, p = look(segment)
    x, y = np.asarray(p.x), np.asarray(p.y)
    pieces = np.hypot(np.diff(x), np.diff(y))
    to_go = np.append(np.cumsum(pieces[::-1])[::-1], 0.0)
    astray = np.flatnonzero(to_go > 0.5 * math.pi * np.hypot(x[-1] - x, y[-1] - y))
    return float(t[astray[-1] + 1]) if len(astray) else 0.0


def polygon(segment: Segment, error: float) -> tuple[Array, Array]:
    """Return a segment as straight pieces.

    Args:
        segment: any segment.
        error: approximate distance of the pieces from it, m.

    Returns:
        north and east, each of shape (m,), m, from its start to its end.
    """
    if segment.kind == "line":
        t = np.array([0.0, 1.0])
    else:
        _, point = look(segment)
        bend = float(np.max(np.abs(np.asarray(point.kappa)) * np.asarray(point.speed) ** 2))
        t = np.linspace(0.0, 1.0, 2 + math.ceil(math.sqrt(bend / (8.0 * error))))
    p: Any = segment.evaluate(t)
    return p.x, p.y
