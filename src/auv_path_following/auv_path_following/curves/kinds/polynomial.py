"""A polynomial of any degree in each axis."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
from numpy.polynomial import Polynomial as Series

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.arc_length import ArcLength
from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.segment import PathPoint

#: Least speed that a curve may have, as a share of its length: below, it stands still or turns on the spot.
STANDSTILL = 1e-6


class Polynomial:
    """x(t) and y(t), each a polynomial in t.

    Args:
        north, east: coefficients of 1, t, t^2, ... in each axis, m.

    Raises:
        ConfigurationError: the curve stands still somewhere on [0, 1], so that its course is not defined; or
            its terms cancel so far that little is left of their digits.
    """

    kind: Final = "polynomial"

    def __init__(self, north: Sequence[float], east: Sequence[float]) -> None:
        self._x: Final = _with_derivatives(north)
        self._y: Final = _with_derivatives(east)
        self._arc: Final = ArcLength(lambda t: self.evaluate(t).speed)
        self.length: Final = self._arc.total
        t = slowest(Series(north), Series(east))
        if not self.evaluate(t).speed > STANDSTILL * max(self.length, 1e-9):
            raise ConfigurationError(
                "polynomial", f"a curve that stands still at t = {t:.4g}", "one that always goes on"
            )
        # Made here, so that a curve that cannot be followed is refused before a mission and not in it.
        self._row: Final = fitted_row(self)

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        x, dx, ddx = _horner(self._x, t)
        y, dy, ddy = _horner(self._y, t)
        return PathPoint(x, y, dx, dy, ddx, ddy)

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self._arc.to_go(t)

    def row(self) -> list[float]:
        """FITTED and its pieces."""
        return list(self._row)


def slowest(north: Any, east: Any) -> float:
    """The t in [0, 1] at which a polynomial curve is slowest.

    Args:
        north, east: the curve as `numpy.polynomial.Polynomial`.
    """
    squared = north.deriv() ** 2 + east.deriv() ** 2
    roots = np.real(squared.deriv().trim(1e-300).roots())
    candidates = np.concatenate(([0.0, 1.0], roots[(roots > 0.0) & (roots < 1.0)]))
    return float(candidates[np.argmin(squared(candidates))])


def _with_derivatives(coefficients: Sequence[float]) -> tuple[tuple[float, ...], ...]:
    """Coefficients of the polynomial and its two derivatives, highest power first, as plain floats."""
    series = Series(coefficients)
    return tuple(tuple(map(float, s.coef[::-1])) for s in (series, series.deriv(), series.deriv(2)))


def _horner(rows: tuple[tuple[float, ...], ...], t: Any) -> list[Any]:
    values = []
    for row in rows:
        value = 0.0 * t + row[0]
        for coefficient in row[1:]:
            value = value * t + coefficient
        values.append(value)
    return values
