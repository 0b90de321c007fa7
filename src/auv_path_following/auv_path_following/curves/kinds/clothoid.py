"""The clothoid: curvature that changes evenly along the way, as a rudder turned evenly would give."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from auv_msgs_py.values.elementary import functions_of
from auv_path_following.curves.pieces import fitted_row
from auv_path_following.curves.segment import PathPoint

#: Beyond these the Fresnel form loses digits by cancellation, and the curve is all but an arc.
_LEAST_CHANGE = 1e-6
_LARGEST_PHASE = 100.0
_NODES, _WEIGHTS = (array.tolist() for array in np.polynomial.legendre.leggauss(10))
_RULE: Final = [(0.5 + 0.5 * node, 0.5 * weight) for node, weight in zip(_NODES, _WEIGHTS, strict=True)]
#: Radians of turning that one panel of the rule integrates to rounding.
_PANEL = 1.5


class Clothoid:
    """A clothoid (Euler spiral) between two curvatures.

    Its course is chi0 + a t + b t^2 / 2 with a = kappa0 L and b = (kappa1 - kappa0) L.

    Args:
        x0, y0: where it starts (north, east), m.
        length: L > 0, m.
        chi0: course at its start, rad.
        kappa0, kappa1: curvature at its start and its end, 1/m, positive to starboard.
    """

    kind: Final = "clothoid"

    def __init__(
        self, x0: float, y0: float, length: float, chi0: float, kappa0: float, kappa1: float
    ) -> None:
        self.x0: Final = x0
        self.y0: Final = y0
        self.length: Final = length
        self.chi0: Final = chi0
        self._a: Final = kappa0 * length
        self._b: Final = (kappa1 - kappa0) * length
        steep = abs(self._b)
        self._by_fresnel: Final = steep >= _LEAST_CHANGE and self._a**2 <= _LARGEST_PHASE * steep
        if self._by_fresnel:
            # The course is phase + side (pi/2) u^2 with u = grow (t + shift).
            self._side: Final = math.copysign(1.0, self._b)
            self._grow: Final = math.sqrt(steep / math.pi)
            self._shift: Final = self._a / self._b
            phase = chi0 - 0.5 * self._a**2 / self._b
            self._cos, self._sin = math.cos(phase), math.sin(phase)
            # Here, because it takes half a second to import and few missions need it.
            from scipy.special import fresnel

            self._fresnel: Final = fresnel
            S, C = fresnel(self._grow * self._shift)
            self._S0, self._C0 = float(S), float(C)

    def _offset(self, t: Any) -> tuple[Any, Any]:
        """Integrals of cos and sin of the course from 0 to t."""
        if not self._by_fresnel:
            return self._quadrature(t)
        S, C = self._fresnel(self._grow * (t + self._shift))
        if not isinstance(t, np.ndarray):
            S, C = float(S), float(C)
        C, S = (C - self._C0) / self._grow, self._side * (S - self._S0) / self._grow
        return self._cos * C - self._sin * S, self._sin * C + self._cos * S

    def _quadrature(self, t: Any) -> tuple[Any, Any]:
        m = functions_of(t)
        panels = 1 + int((abs(self._a) + 0.5 * abs(self._b)) / _PANEL)
        width = t / panels
        north = east = 0.0 * t
        for panel in range(panels):
            for node, weight in _RULE:
                at = width * (panel + node)
                course = self.chi0 + at * (self._a + 0.5 * self._b * at)
                north = north + weight * m.cos(course)
                east = east + weight * m.sin(course)
        return width * north, width * east

    def evaluate(self, t: Any) -> PathPoint:
        """Return the point at t (float or array) in [0, 1]."""
        m = functions_of(t)
        north, east = self._offset(t)
        course = self.chi0 + t * (self._a + 0.5 * self._b * t)
        turning = self._a + self._b * t
        dx, dy = self.length * m.cos(course), self.length * m.sin(course)
        return PathPoint(
            self.x0 + self.length * north, self.y0 + self.length * east, dx, dy, -turning * dy, turning * dx
        )

    def length_to_go(self, t: float) -> float:
        """Return the length from t to the end, m."""
        return self.length * (1.0 - t)

    def row(self) -> list[float]:
        """FITTED and its pieces."""
        return fitted_row(self)
