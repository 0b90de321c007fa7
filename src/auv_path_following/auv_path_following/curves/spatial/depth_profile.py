"""Depth over the horizontal length of a path: constant, or ramps between knots."""

from __future__ import annotations

import bisect
import itertools
import math
from collections.abc import Sequence
from typing import Final, Literal, NamedTuple, get_args

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.spatial_point import Profile, linear_ramp, smooth_ramp

#: How the depth goes from knot to knot.
RampKind = Literal["smooth", "linear"]
_RAMPS = {"linear": linear_ramp, "smooth": smooth_ramp}
#: Largest slope of a ramp, in units of D/L, and its largest rate, in units of D/L^2.
STEEPEST = {"linear": 1.0, "smooth": 1.875}
#: Points in [-1, 1] and weights of the Gauss quadrature.
_GAUSS: Final = tuple(zip(*(array.tolist() for array in np.polynomial.legendre.leggauss(32)), strict=True))
_SHARPEST = {"linear": 0.0, "smooth": 10.0 / math.sqrt(3.0)}


class Knot(NamedTuple):
    """Horizontal length from the path's start (m), and the depth there (m, positive down)."""

    way: float
    depth: float


class DepthProfile:
    """Depth over horizontal length.

    Args:
        knots: at least two, of increasing length, the first at 0.
        kind: of the ramps between them. A smooth one has slope and curvature 0 at both ends.

    Raises:
        ConfigurationError: with the knot, what was found and what was expected.
    """

    def __init__(self, knots: Sequence[tuple[float, float]], kind: RampKind = "smooth") -> None:
        if kind not in get_args(RampKind):
            raise ConfigurationError("kind", f"'{kind}'", " or ".join(get_args(RampKind)))
        if len(knots) < 2:
            raise ConfigurationError("knots", f"{len(knots)} of them", "at least two")
        self.kind: Final = kind
        self.knots: Final = tuple(Knot(float(way), float(depth)) for way, depth in knots)
        for number, knot in enumerate(self.knots):
            if not (math.isfinite(knot.way) and math.isfinite(knot.depth) and knot.depth >= 0.0):
                expected = "a length and a depth of 0 m or more, positive down"
                raise ConfigurationError(f"knots[{number}]", f"({knot.way:g}, {knot.depth:g})", expected)
        if self.knots[0].way != 0.0:
            raise ConfigurationError("knots[0]", f"{self.knots[0].way:g} m", "0: where the path starts")
        for number, (before, after) in enumerate(itertools.pairwise(self.knots), start=1):
            if not after.way > before.way:
                found, expected = f"{after.way:g} m behind {before.way:g} m", "lengths that increase"
                raise ConfigurationError(f"knots[{number}]", found, expected)
        self._ways: Final = [knot.way for knot in self.knots]

    @classmethod
    def constant(cls, depth: float, length: float) -> DepthProfile:
        """Return one depth (m) for a path of a horizontal length (m)."""
        return cls([(0.0, depth), (length, depth)], "linear")

    @property
    def length(self) -> float:
        """Horizontal length from the first knot to the last, m."""
        return self.knots[-1].way

    def at(self, way: float, owner: int | None = None) -> Profile:
        """Return depth (m), slope, and rate of the slope (1/m).

        At a knot two ramps meet and their slopes may differ: `owner` says which one is meant.

        Args:
            way: horizontal length from the path's start, m.
            owner: index of the ramp; without one it is the ramp that begins there.
        """
        if owner is None:
            owner = min(max(bisect.bisect_right(self._ways, way) - 1, 0), len(self.knots) - 2)
        before, after = self.knots[owner], self.knots[owner + 1]
        ramp = _RAMPS[self.kind]
        return ramp(before.depth, after.depth, after.way - before.way, way - before.way)

    def stretch(self, middle: float, half: float, owner: int) -> float:
        """Return the integral of sqrt(1 + slope^2) over a stretch of one ramp, over half its width.

        It is called once a step, so the slope stands here once more: that of Eq. (3D-11).

        Args:
            middle, half: of the stretch, horizontal length, m: its middle, and half its width.
            owner: index of the ramp.
        """
        before, after = self.knots[owner], self.knots[owner + 1]
        length = after.way - before.way
        mean = (after.depth - before.depth) / length
        if self.kind == "linear":
            return 2.0 * math.sqrt(1.0 + mean * mean)
        begin, total = middle - before.way, 0.0
        for node, weight in _GAUSS:
            e = (begin + half * node) / length
            slope = mean * (30.0 * e * e * (1.0 - e) * (1.0 - e))
            total += weight * math.sqrt(1.0 + slope * slope)
        return total

    def reversed(self) -> DepthProfile:
        """Return the profile of the same path followed from its end to its start."""
        return DepthProfile([(self.length - way, depth) for way, depth in self.knots[::-1]], self.kind)

    def steepest(self) -> tuple[float, int]:
        """Return the largest |slope| and the index of its ramp."""
        slopes = [
            STEEPEST[self.kind] * abs(after.depth - before.depth) / (after.way - before.way)
            for before, after in itertools.pairwise(self.knots)
        ]
        return max(slopes), slopes.index(max(slopes))

    def sharpest(self) -> tuple[float, int]:
        """Return the largest |rate of the slope|, 1/m, inside a ramp, and the index of that ramp."""
        bends = [
            _SHARPEST[self.kind] * abs(after.depth - before.depth) / (after.way - before.way) ** 2
            for before, after in itertools.pairwise(self.knots)
        ]
        return max(bends), bends.index(max(bends))

    def least_length(self, depth: float, steepest: float, radius: float) -> float:
        """Return the length of a ramp that would do, m.

        Args:
            depth: difference of depth, m.
            steepest: largest slope allowed.
            radius: least radius allowed of its vertical curvature, m; a linear ramp has none inside.
        """
        by_slope = STEEPEST[self.kind] * abs(depth) / steepest
        return max(by_slope, math.sqrt(_SHARPEST[self.kind] * abs(depth) * radius))
