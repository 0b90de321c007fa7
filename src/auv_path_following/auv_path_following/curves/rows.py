"""A path as numbers: one row for each subpath, and the one function that evaluates it.

Guidance reads the rows as tuples, compiled code the same numbers as arrays. A segment gives its kind and its
numbers (`Segment.row`); kinds without a formula here come in pieces, see `pieces`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from auv_msgs_py.values.pure import pure

#: Kinds of rows. A negative kind is followed from its end to its start.
LINE, ARC, FERMAT, MIRRORED, SPIRAL, CUBIC, FITTED = map(float, range(1, 8))

# Columns of a row. The numbers of a kind, A to F:
#   LINE             x0, y0, dx, dy; Eq. (10)
#   ARC              cx, cy, radius, a0, sweep; Eq. (11)
#   FERMAT           x0, y0, c, w, chi0; Eq. (12), see `fermat`
#   MIRRORED         x_end, y_end, c, w, chi_end; Eq. (13)
#   SPIRAL           cx, cy, radius0, growth, a0, sweep
#   CUBIC, FITTED    where its first piece begins in `PathRows.piece`, number of pieces
# Then its length, the length of path after it and |dp/dt| at its start (m). Then the joint at its end: its
# kind (below), its position (m), the t of the last stretch to it, both courses there (rad), half the shorter
# subpath, its depth (m; 0 in a planar path).
KIND, A, B, C, D, E, F, LENGTH, AFTER, SPEED, JOINT, JOINT_X, JOINT_Y, STRETCH = range(14)
CHI_IN, CHI_OUT, WIDEST, JOINT_Z = range(14, 18)
COLUMNS = 18
#: Values of JOINT: the end of the path; a joint at which the course is continuous; a corner (G0).
END, SMOOTH, CORNER = map(float, range(3))

#: Numbers of a cubic piece: the t at its start, then four coefficients of t - start for each axis.
CUBIC_WIDTH = 9
#: Coefficients of each axis of a fitted piece, highest power first.
TERMS = 15
#: Numbers of a fitted piece: the t at its start and 2 / its width, then its coefficients of u in [-1, 1].
FITTED_WIDTH = 2 + 2 * TERMS

Row = Sequence[float]
#: x, y, dx, dy, ddx, ddy: the fields of a `PathPoint` as a plain tuple.
Point = tuple[float, float, float, float, float, float]


class PathRows(NamedTuple):
    """A path of n subpaths; read only.

    Attributes:
        n: number of subpaths.
        subpath: `Row` of each subpath, by its index from 0; compiled: an array of shape (n, COLUMNS).
        piece: numbers of all pieces, one after another; compiled: an array.
    """

    n: int
    subpath: Any
    piece: Any


@pure
def curvature(dx: float, dy: float, ddx: float, ddy: float) -> float:
    """Return the curvature, Eq. (8), 1/m, positive where the path turns to starboard."""
    squared = dx * dx + dy * dy
    return (dx * ddy - dy * ddx) / (squared * math.sqrt(squared))


@pure
def evaluate(path: PathRows, row: Any, t: float) -> Point:
    """Return the point at t in [0, 1] of a subpath of `path`, as `Segment.evaluate`: NED, m.

    Kinds with a formula are bit-identical to the segment, fitted pieces within `pieces.TOLERANCE`.
    """
    kind = row[KIND]
    if kind > 0.0:
        return _onwards(path, row, kind, t)
    x, y, dx, dy, ddx, ddy = _onwards(path, row, -kind, 1.0 - t)
    return x, y, -dx, -dy, ddx, ddy


@pure
def _onwards(path: PathRows, row: Any, kind: float, t: float) -> Point:
    if kind == LINE:
        dx, dy = row[C], row[D]
        return row[A] + dx * t, row[B] + dy * t, dx, dy, 0.0, 0.0
    if kind == ARC:
        radius, sweep = row[C], row[E]
        a = row[D] + t * sweep
        north, east = radius * math.cos(a), radius * math.sin(a)
        turn = -sweep * sweep
        return row[A] + north, row[B] + east, -sweep * east, sweep * north, turn * north, turn * east
    if kind == FERMAT:
        x, y, dx, dy, ddx, ddy = _fermat(row, t)
        return row[A] + x, row[B] + y, dx, dy, ddx, ddy
    if kind == MIRRORED:
        x, y, dx, dy, ddx, ddy = _fermat(row, 1.0 - t)
        return row[A] - x, row[B] - y, dx, dy, -ddx, -ddy
    if kind == SPIRAL:
        return _spiral(row, t)
    if kind == CUBIC:
        return _cubic(path.piece, row, t)
    return _fitted(path.piece, row, t)


@pure
def _fermat(row: Any, q: float) -> Point:
    c, w = row[C], row[D]
    phi = w * q * q + row[E]
    cos, sin = c * math.cos(phi), c * math.sin(phi)
    dphi = 2.0 * w * q
    a = q * dphi
    return (
        q * cos,
        q * sin,
        cos - a * sin,
        sin + a * cos,
        -3.0 * dphi * sin - a * dphi * cos,
        3.0 * dphi * cos - a * dphi * sin,
    )


@pure
def _spiral(row: Any, t: float) -> Point:
    growth, sweep = row[D], row[F]
    a, radius = row[E] + t * sweep, row[C] + t * growth
    cos, sin = math.cos(a), math.sin(a)
    turn, twice = radius * sweep, 2.0 * growth * sweep
    pull = turn * sweep
    return (
        row[A] + radius * cos,
        row[B] + radius * sin,
        growth * cos - turn * sin,
        growth * sin + turn * cos,
        -twice * sin - pull * cos,
        twice * cos - pull * sin,
    )


@pure
def _piece_at(piece: Any, row: Any, width: int, t: float) -> int:
    """Return where the piece that holds t begins in `piece`."""
    first = int(row[A])
    low, high = 0, int(row[B])
    while high - low > 1:
        middle = (low + high) // 2
        if t >= piece[first + width * middle]:
            low = middle
        else:
            high = middle
    return first + width * low


@pure
def _cubic(piece: Any, row: Any, t: float) -> Point:
    k = _piece_at(piece, row, CUBIC_WIDTH, t)
    u = t - piece[k]
    a, b, c, d = piece[k + 1], piece[k + 2], piece[k + 3], piece[k + 4]
    e, f, g, h = piece[k + 5], piece[k + 6], piece[k + 7], piece[k + 8]
    return (
        ((a * u + b) * u + c) * u + d,
        ((e * u + f) * u + g) * u + h,
        (3.0 * a * u + 2.0 * b) * u + c,
        (3.0 * e * u + 2.0 * f) * u + g,
        6.0 * a * u + 2.0 * b,
        6.0 * e * u + 2.0 * f,
    )


@pure
def _fitted(piece: Any, row: Any, t: float) -> Point:
    """Evaluate a polynomial and both derivatives by one Horner scheme for each axis."""
    first = _piece_at(piece, row, FITTED_WIDTH, t)
    scale = piece[first + 1]
    u = (t - piece[first]) * scale - 1.0
    x = dx = half_ddx = y = dy = half_ddy = 0.0
    for k in range(first + 2, first + 2 + TERMS):
        half_ddx = half_ddx * u + dx
        dx = dx * u + x
        x = x * u + piece[k]
        half_ddy = half_ddy * u + dy
        dy = dy * u + y
        y = y * u + piece[k + TERMS]
    twice = 2.0 * scale * scale
    return x, y, dx * scale, dy * scale, half_ddx * twice, half_ddy * twice
