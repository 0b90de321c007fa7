"""Finds where a path crosses itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from auv_path_following.curves.outline import polygon
from auv_path_following.curves.segment import Segment

Array = npt.NDArray[np.float64]

#: Largest distance of the outline from the curve, m.
_ERROR = 0.02
#: Share of a piece: crossings nearer to its end belong to its neighbour.
_END = 1e-9
#: Pieces that meet at a smaller angle run along each other, rad: the rest is rounding.
_PARALLEL = 1e-9
_ROWS = 256
#: Comparisons of pieces after which the search ends: a circle flown a thousand times has far more pairs.
_MOST_COMPARISONS = 20_000_000


class Crossing(NamedTuple):
    """Two subpaths (numbered from 1, the earlier one first) that cross at (x, y), m; both may be the same."""

    first: int
    second: int
    x: float
    y: float


def crossings(segments: Sequence[Segment], most: int = 1000) -> list[Crossing]:
    """Return the points in which subpaths cross; running along each other is no crossing.

    The search is bounded: on a path with very many subpaths in one place it ends before the last pair.

    Args:
        segments: the subpaths in order, each once.
        most: number of crossings after which the search ends.
    """
    outlines = [np.column_stack(polygon(segment, _ERROR)) for segment in segments]
    found: list[Crossing] = []
    comparisons = 0
    for i, j in _neighbours(outlines):
        comparisons += len(outlines[i]) * len(outlines[j])
        if comparisons > _MOST_COMPARISONS:
            break
        for x, y in _between(outlines[i], outlines[j], i == j):
            found.append(Crossing(i + 1, j + 1, x, y))
            if len(found) >= most:
                return sorted(found)
    return sorted(found)


def _neighbours(outlines: list[Array]) -> Iterator[tuple[int, int]]:
    """Yield pairs (i <= j) whose bounding boxes overlap.

    The boxes lie along the direction in which most of the path runs: the legs of a survey have thin boxes
    then, whatever its heading, and few of them overlap.
    """
    steps = np.concatenate([np.diff(outline, axis=0) for outline in outlines])
    # Lengths squared and twice the angle: both ways along a line are one direction.
    doubled = np.sum((steps[:, 0] + 1j * steps[:, 1]) ** 2 / (np.hypot(*steps.T) + 1e-12))
    angle = 0.5 * float(np.angle(doubled))
    axes = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    low, high = (np.array([end(outline @ axes, axis=0) for outline in outlines]) for end in (np.min, np.max))
    order = np.argsort(low[:, 1], kind="stable")
    low, high = low[order], high[order]
    until = np.searchsorted(low[:, 1], high[:, 1], side="right")
    for a in range(len(order)):
        rest = slice(a, until[a])
        overlap = (low[rest, 0] <= high[a, 0]) & (high[rest, 0] >= low[a, 0])
        for b in np.flatnonzero(overlap):
            i, j = int(order[a]), int(order[a + b])
            yield min(i, j), max(i, j)


def _between(one: Array, other: Array, same: bool) -> Iterator[tuple[float, float]]:
    """Yield the proper crossings of two chains of pieces, shape (n, 2), m."""
    if same and len(one) < 4:
        return
    q, s = other[:-1], np.diff(other, axis=0)
    for start in range(0, len(one) - 1, _ROWS):
        p = one[:-1][start : start + _ROWS, None, :]
        r = np.diff(one, axis=0)[start : start + _ROWS, None, :]
        gap = q[None, :, :] - p
        across = r[..., 0] * s[:, 1] - r[..., 1] * s[:, 0]
        across[np.abs(across) <= _PARALLEL * np.hypot(r[..., 0], r[..., 1]) * np.hypot(*s.T)] = np.nan
        with np.errstate(divide="ignore", invalid="ignore"):
            u = (gap[..., 0] * s[:, 1] - gap[..., 1] * s[:, 0]) / across
            v = (gap[..., 0] * r[..., 1] - gap[..., 1] * r[..., 0]) / across
        hit = (u > _END) & (u < 1.0 - _END) & (v > _END) & (v < 1.0 - _END)
        rows, columns = np.nonzero(hit)
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            if same and column <= start + row + 1:
                continue
            x, y = p[row, 0] + u[row, column] * r[row, 0]
            yield float(x), float(y)
