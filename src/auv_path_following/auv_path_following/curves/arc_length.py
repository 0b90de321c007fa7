"""Length along a curve whose speed is known but whose length has no formula."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

_NODES, _WEIGHTS = (array.tolist() for array in np.polynomial.legendre.leggauss(8))
_RULE: Final = [(0.5 + 0.5 * node, 0.5 * weight) for node, weight in zip(_NODES, _WEIGHTS, strict=True)]
_AT = np.array([node for node, _ in _RULE])
_WEIGHT = np.array([weight for _, weight in _RULE])

_RELATIVE_ERROR = 1e-13
_MOST_PANELS = 1 << 14


class ArcLength:
    """Integral of the speed over t, by 8-node Gauss-Legendre on equal panels.

    The panels are halved until the total no longer changes, at a relative 1e-13. A lookup costs one panel.

    Args:
        speed: |dp/dt| (m) of t in [0, 1]; takes a float or an array.
        panels: initial number, e.g. one for each piece of a spline.
    """

    def __init__(self, speed: Callable[[Any], Any], panels: int = 1) -> None:
        self._speed: Final = speed
        sums = self._panel_lengths(panels)
        while panels < _MOST_PANELS:
            finer = self._panel_lengths(2 * panels)
            settled = abs(finer.sum() - sums.sum()) <= _RELATIVE_ERROR * finer.sum()
            panels, sums = 2 * panels, finer
            if settled:
                break
        self._panels: Final = panels
        self._sums: Final[list[float]] = [0.0, *np.cumsum(sums).tolist()]
        self.total: Final = self._sums[-1]

    def _panel_lengths(self, panels: int) -> Any:
        t = (np.arange(panels)[:, None] + _AT) / panels
        return self._speed(t) @ _WEIGHT / panels

    def until(self, t: float) -> float:
        """Return the length from 0 to t, m."""
        panel = min(max(int(t * self._panels), 0), self._panels - 1)
        start = panel / self._panels
        width = t - start
        rest = sum(weight * self._speed(start + width * node) for node, weight in _RULE)
        return self._sums[panel] + width * float(rest)

    def to_go(self, t: float) -> float:
        """Return the length from t to 1, m."""
        return self.total - self.until(t)
