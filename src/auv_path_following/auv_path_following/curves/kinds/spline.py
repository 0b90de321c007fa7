"""A cubic spline through points: one subpath, twice continuously differentiable all along."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.polynomial import Polynomial as Series

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.arc_length import ArcLength
from auv_path_following.curves.kinds.polynomial import STANDSTILL, slowest
from auv_path_following.curves.rows import CUBIC
from auv_path_following.curves.segment import PathPoint


class Spline:
    """A cubic spline; t grows with the straight distance between the points.

    Args:
        points: at least two (north, east), m, neighbours not in one place.
        chi_start, chi_end: courses at its ends, rad; without one that end is without curvature.
        chords: widths of t between the points up to a factor; None for their straight distances (m).

    Raises:
        ConfigurationError: neighbours in one place, or a curve that stands still somewhere.
    """

    kind: Final = "spline"

    def __init__(
        self,
        points: Sequence[tuple[float, float]],
        chi_start: float | None = None,
        chi_end: float | None = None,
        chords: Sequence[float] | None = None,
    ) -> None:
        way = np.asarray(points, float)
        straight = np.hypot(*np.diff(way, axis=0).T)
        widths: Any = straight if chords is None else np.asarray(chords, float)
        if not np.all(straight > 1e-9):
            number = int(np.argmin(straight))
            found = f"points[{number}] and points[{number + 1}] in one place"
            raise ConfigurationError("spline", found, "points that differ")
        knots = np.concatenate(([0.0], np.cumsum(widths)))
        total = float(knots[-1])
        knots /= total
        ends = []
        for chi in (chi_start, chi_end):
            along = (
                (1, (total * math.cos(chi), total * math.sin(chi))) if chi is not None else (2, (0.0, 0.0))
            )
            ends.append(along)
        # Here, because it takes half a second to import and few missions need it.
        from scipy.interpolate import CubicSpline

        fitted = CubicSpline(knots, way, bc_type=tuple(ends))
        self.pieces: Final = len(widths)
        self.inner_knots: Final[list[float]] = knots[1:-1].tolist()
        self._knots: Final[list[float]] = knots[:-1].tolist()
        # c[power, piece, axis], highest power first.
        self._rows: Final[list[list[float]]] = np.moveaxis(fitted.c, 2, 0).reshape(8, -1).T.tolist()
        self._inner_array: Final = np.array(self.inner_knots)
        self._knots_array: Final = np.array(self._knots)
        self._table: Final = np.array(self._rows).T
        self._arc: Final = ArcLength(lambda t: self.evaluate(t).speed, len(self._knots))
        self.length: Final = self._arc.total
        self._check_motion(np.diff(knots))

    def _check_motion(self, widths: Any) -> None:
        for k, (row, width) in enumerate(zip(self._rows, widths, strict=True)):
            scale = width ** np.arange(4)
            t = slowest(Series(row[3::-1] * scale), Series(row[:3:-1] * scale))
            if not self.evaluate(self._knots[k] + t * float(width)).speed > STANDSTILL * self.length:
                found = f"a curve that stands still between points[{k}] and points[{k + 1}]"
                raise ConfigurationError("spline", found, "points that do not turn straight back")

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        row: Any
        if isinstance(t, np.ndarray):
            piece = np.searchsorted(self._inner_array, t, side="right")
            u, row = t - self._knots_array[piece], self._table[:, piece]
        else:
            index = bisect_right(self.inner_knots, t)
            u, row = t - self._knots[index], self._rows[index]
        a, b, c, d, e, f, g, h = row
        return PathPoint(
            ((a * u + b) * u + c) * u + d,
            ((e * u + f) * u + g) * u + h,
            (3.0 * a * u + 2.0 * b) * u + c,
            (3.0 * e * u + 2.0 * f) * u + g,
            6.0 * a * u + 2.0 * b,
            6.0 * e * u + 2.0 * f,
        )

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self._arc.to_go(t)

    def row(self) -> list[float]:
        """CUBIC and its pieces: the t at the start of each and its eight coefficients."""
        pieces = zip(self._knots, self._rows, strict=True)
        return [CUBIC, *(number for start, row in pieces for number in (start, *row))]
