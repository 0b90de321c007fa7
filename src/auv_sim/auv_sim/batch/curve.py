"""A composite path as arrays of numbers, so that compiled code can evaluate it.

Lines and arcs keep their formulas. Every other kind of segment becomes polynomials of degree `DEGREE`, as
many as it takes to be exact to rounding: a new kind of segment needs nothing here.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
from numpy.polynomial import chebyshev

from auv_msgs_py.errors import ConfigurationError
from auv_path_following.guidance.acceptance import corner_of
from auv_path_following.guidance.switching import counts_from
from auv_path_following.paths.arc import Arc
from auv_path_following.paths.closest import samples
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.line import Line
from auv_path_following.paths.reverse import Reversed
from auv_path_following.paths.segment import Segment
from auv_path_following.paths.spline import Spline

LINE, ARC, PIECES = range(3)
DEGREE = 12
#: Largest error of a piece, as a share of the largest value of the signal on the segment.
TOLERANCE = 1e-12
_NARROWEST = 2.0**-20
_NODES = chebyshev.chebpts1(DEGREE + 1)
_CHECKS = np.linspace(-1.0, 1.0, 41)

Array = npt.NDArray[np.float64]


class Curve(NamedTuple):
    """A path of n subpaths; all arrays are read only by convention.

    Three arrays and not a dozen: compiled code counts references to each of them at every call.

    Attributes:
        subpath: shape (n, COLUMNS), one row for each subpath; its columns are named below.
        piece: shape (pieces, 2 + 6 (DEGREE + 1)), where a piece begins and 2 / its width, in t; then x, y
            and their derivatives as in `PathPoint`, the coefficients of the highest power first.
        point: shape (points, 3), t, x, y: close enough to each other to show every valley of the distance.
    """

    subpath: Array
    piece: Array
    point: Array


# Columns of `Curve.subpath`. A line: x0, y0, dx, dy; an arc: cx, cy, radius, a0, sweep; else the range of its
# pieces and of its points. Then its length, the joint at its end, whether that is G0, the t from which on its
# circle counts, and what `Corner` has of it.
KIND, A, B, C, D, E, LENGTH, JOINT_X, JOINT_Y, CORNER, STRETCH, CHI_IN, CHI_OUT, WIDEST = range(14)
COLUMNS = 14
FIRST_PIECE, END_OF_PIECES, FIRST_POINT, END_OF_POINTS = A, B, C, D
START, SCALE, TABLE = 0, 1, 2
SIGNALS = 6


def curve_of(path: CompositePath) -> Curve:
    """The path as numbers.

    Raises:
        ConfigurationError: a segment that no polynomial follows: it has a kink inside.
    """
    subpath = np.zeros((path.n, COLUMNS))
    pieces: list[Array] = [np.zeros((0, TABLE + SIGNALS * (DEGREE + 1)))]
    points: list[Array] = [np.zeros((0, 3))]
    known: dict[int, list[int]] = {}
    for row, segment in zip(subpath, path.segments, strict=True):
        if type(segment) is Line:
            start = segment.evaluate(0.0)
            row[:E] = LINE, *start[:4]
        elif type(segment) is Arc:
            row[: E + 1] = ARC, segment.cx, segment.cy, segment.radius, segment.a0, segment.a1 - segment.a0
        else:
            # A path that repeats itself holds the same segment many times.
            if id(segment) not in known:
                before = sum(map(len, pieces)), sum(map(len, points))
                where = f"segments[{path.segments.index(segment)}]"
                pieces.append(np.array(list(_pieces(segment, where))))
                t = np.linspace(0.0, 1.0, samples(segment) + 1)
                p: Any = segment.evaluate(t)
                points.append(np.stack([t, p.x, p.y], axis=1))
                known[id(segment)] = [
                    before[0], before[0] + len(pieces[-1]), before[1], before[1] + len(points[-1])
                ]  # fmt: skip
            row[:E] = PIECES, *known[id(segment)]
        row[LENGTH] = segment.length
    for i, (row, segment, joint) in enumerate(zip(subpath, path.segments, path.joints, strict=False)):
        row[JOINT_X:CHI_IN] = joint.x, joint.y, joint.geometric == "G0", counts_from(segment)
        row[CHI_IN:] = corner_of(path, i)
    return Curve(subpath, np.concatenate(pieces), np.concatenate(points))


def _knots(segment: Segment) -> list[float]:
    """Where a segment is less than smooth, in t."""
    if isinstance(segment, Reversed):
        return [1.0 - t for t in reversed(_knots(segment.segment))]
    return list(segment.inner_knots) if isinstance(segment, Spline) else []


def _pieces(segment: Segment, where: str) -> Iterator[Array]:
    """Rows of `Curve.piece` in order of t."""
    grid: Any = segment.evaluate(np.linspace(0.0, 1.0, 129))
    scale = np.array([np.max(np.abs(signal)) for signal in grid])
    # A derivative that is zero throughout comes with rounding of the size of the others.
    allowed = TOLERANCE * np.maximum(scale, 1e-3 * scale.max())[:, None]
    knots = [0.0, *_knots(segment), 1.0]
    stack = [(a, b) for a, b in zip(knots[-2::-1], knots[:0:-1], strict=True)]
    while stack:
        a, b = stack.pop()
        values = _signals(segment, a, b, _NODES)
        series = chebyshev.chebfit(_NODES, values.T, DEGREE)
        errors = np.abs(chebyshev.chebval(_CHECKS, series) - _signals(segment, a, b, _CHECKS))
        if np.all(errors <= allowed):
            powers = np.zeros((SIGNALS, DEGREE + 1))
            for row, its_series in zip(powers, series.T, strict=True):
                coefficients = chebyshev.cheb2poly(its_series)
                row[DEGREE + 1 - len(coefficients) :] = coefficients[::-1]
            yield np.array([a, 2.0 / (b - a), *powers.ravel()])
        elif b - a < _NARROWEST:
            raise ConfigurationError(where, f"a kink at t = {a:.6g}", "a curve that is smooth inside")
        else:
            middle = 0.5 * (a + b)
            stack += [(middle, b), (a, middle)]


def _signals(segment: Segment, a: float, b: float, u: Array) -> Array:
    """The six signals at u in [-1, 1] of a piece; inside it, so that a knot is seen from the right side."""
    t = np.clip(0.5 * (a + b) + 0.5 * (b - a) * u, a, np.nextafter(b, a))
    return np.array(np.broadcast_arrays(*segment.evaluate(t)))
