"""Fermat's spiral and its mirror, Eq. (12) and Eq. (13).

Both come from one curve, which starts at the origin without curvature and winds up:

    F(q) = c q (cos phi, sin phi),   phi = w q^2 + chi,   q in [0, 1]
    c = k sqrt(theta_end),           w = +-rho theta_end

Its speed is |dF/dq| = c sqrt(1 + 4 w^2 q^4).
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from auv_msgs_py.values.elementary import functions_of
from auv_path_following.curves.rows import FERMAT, MIRRORED
from auv_path_following.curves.segment import PathPoint

_NODES = 8
_RULE: Final = [
    (0.5 + 0.5 * float(node), 0.5 * float(weight))
    for node, weight in zip(*np.polynomial.legendre.leggauss(_NODES), strict=True)
]


class _Curve:
    """F(q), its derivatives and its length."""

    def __init__(self, k: float, theta_end: float, chi: float, rho: int) -> None:
        self._c: Final = k * math.sqrt(theta_end)
        self._w: Final = rho * theta_end
        self._chi: Final = chi
        self._4w2: Final = 4.0 * theta_end * theta_end
        # The speed, taken as a function of complex q, has branch points 0.5 / sqrt(theta_end) beside the
        # real axis. Panels not wider than half of that leave 8 nodes an error near 1e-15 of the length.
        self._panels: Final = math.ceil(4.0 * math.sqrt(theta_end))
        sums = [0.0]
        for panel in range(self._panels):
            sums.append(sums[-1] + self._stretch(panel / self._panels, (panel + 1) / self._panels))
        self._sums: Final = sums

    def _stretch(self, start: float, end: float) -> float:
        """Length between two q of one panel by Gauss-Legendre quadrature, m."""
        width = end - start
        total = 0.0
        for node, weight in _RULE:
            q2 = (start + width * node) ** 2
            total += weight * math.sqrt(1.0 + self._4w2 * q2 * q2)
        return self._c * width * total

    @property
    def numbers(self) -> tuple[float, float, float]:
        """c, w and chi."""
        return self._c, self._w, self._chi

    def length(self, q: float) -> float:
        """Length from the origin to q, m."""
        panel = min(int(q * self._panels), self._panels)
        return self._sums[panel] + self._stretch(panel / self._panels, q)

    def evaluate(self, q: Any) -> PathPoint:
        """F and its derivatives with respect to q (float or array)."""
        m = functions_of(q)
        phi = self._w * q * q + self._chi
        cos = self._c * m.cos(phi)
        sin = self._c * m.sin(phi)
        dphi = 2.0 * self._w * q
        a = q * dphi
        return PathPoint(
            q * cos,
            q * sin,
            cos - a * sin,
            sin + a * cos,
            -3.0 * dphi * sin - a * dphi * cos,
            3.0 * dphi * cos - a * dphi * sin,
        )


class FermatSpiral:
    """Fermat's spiral, Eq. (12): curvature grows from zero at its start.

    Args:
        x0, y0: where it starts (north, east), m.
        k: scale > 0, m.
        theta_end: polar angle of its end > 0, rad.
        chi0: course at its start, rad.
        rho: 1 turns to starboard, -1 to port.
    """

    kind: Final = "fermat"

    def __init__(self, x0: float, y0: float, k: float, theta_end: float, chi0: float, rho: int) -> None:
        self.x0: Final = x0
        self.y0: Final = y0
        self._curve: Final = _Curve(k, theta_end, chi0, rho)
        self.length: Final = self._curve.length(1.0)

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        f = self._curve.evaluate(t)
        return PathPoint(self.x0 + f.x, self.y0 + f.y, f.dx, f.dy, f.ddx, f.ddy)

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self.length - self._curve.length(t)

    def row(self) -> list[float]:
        """FERMAT, x0, y0, c, w, chi0."""
        return [FERMAT, self.x0, self.y0, *self._curve.numbers]


class MirroredFermatSpiral:
    """The mirrored spiral, Eq. (13): curvature falls to zero at its end.

    Args:
        x_end, y_end: where it ends (north, east), m.
        k: scale > 0, m.
        theta_end: polar angle > 0 of its start, seen from its end, rad.
        chi_end: course at its end, rad.
        rho: 1 turns to starboard, -1 to port.
    """

    kind: Final = "fermat_mirrored"

    def __init__(
        self, x_end: float, y_end: float, k: float, theta_end: float, chi_end: float, rho: int
    ) -> None:
        self.x_end: Final = x_end
        self.y_end: Final = y_end
        self._curve: Final = _Curve(k, theta_end, chi_end, -rho)
        self.length: Final = self._curve.length(1.0)

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        f = self._curve.evaluate(1.0 - t)
        # p(t) = p_end - F(1 - t): each derivative with respect to t brings one more minus.
        return PathPoint(self.x_end - f.x, self.y_end - f.y, f.dx, f.dy, -f.ddx, -f.ddy)

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self._curve.length(1.0 - t)

    def row(self) -> list[float]:
        """MIRRORED, x_end, y_end, c, w, chi_end."""
        return [MIRRORED, self.x_end, self.y_end, *self._curve.numbers]
