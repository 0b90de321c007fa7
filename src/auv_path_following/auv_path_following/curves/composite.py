"""The path as a whole: subpaths in a row under one scalar s in [0, n], Eq. (1)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.closest import closest_distance
from auv_path_following.curves.rows import PathRows
from auv_path_following.curves.segment import PathPoint, Segment
from auv_path_following.curves.subpaths import Subpaths

Array = npt.NDArray[np.float64]

#: Largest step of the course that still counts as continuous (G1), rad.
ANGLE_TOLERANCE = 1e-3
#: Largest step of the curvature that still counts as continuous (G2), 1/m: a radius of 10 km.
CURVATURE_TOLERANCE = 1e-4
#: Largest step of dp/ds (C1) and d2p/ds2 (C2), as a share of the larger |dp/ds| at the joint.
DERIVATIVE_TOLERANCE = 1e-3


@dataclass(frozen=True)
class Joint:
    """Where one subpath ends and the next one starts, and how smoothly.

    Attributes:
        index: number of the subpath that ends here, counted from 1 as the paper does.
        x, y: where it is (start of the next subpath), NED, m.
        gap: distance between the end and the start that should be one, m.
        chi_in, chi_out: courses before and after it, rad.
        angle_step: how far the course jumps, rad in [-pi, pi), positive to starboard.
        curvature_step: how far the curvature jumps, 1/m.
        geometric: G0 connected, G1 course continuous too, G2 curvature continuous too.
        parametric: C0 connected, C1 dp/ds continuous too, C2 d2p/ds2 continuous too.
    """

    index: int
    x: float
    y: float
    gap: float
    chi_in: float
    chi_out: float
    angle_step: float
    curvature_step: float
    geometric: Literal["G0", "G1", "G2"]
    parametric: Literal["C0", "C1", "C2"]


class CompositePath:
    """Subpaths in a row; subpath i (from 0) owns s in [i, i + 1). Immutable; evaluation costs O(1).

    Args:
        segments: the subpaths in the order in which they are followed.
        tolerance: largest gap allowed at a joint, m.

    Raises:
        ConfigurationError: there is no subpath, or a joint does not meet (with the gap in metres).
    """

    def __init__(self, segments: Iterable[Segment], tolerance: float = 1e-3) -> None:
        self.segments: Final = tuple(segments)
        self.n: Final = len(self.segments)
        if not self.segments:
            raise ConfigurationError("segments", "an empty path", "at least one segment")
        self.joints: Final = tuple(
            _joint(number, before.evaluate(1.0), after.evaluate(0.0))
            for number, (before, after) in enumerate(itertools.pairwise(self.segments), start=1)
        )
        for joint in self.joints:
            # Written so that a gap of NaN is refused as well.
            if not joint.gap <= tolerance:
                raise ConfigurationError(
                    f"segments[{joint.index}]",
                    f"a gap of {joint.gap:.6g} m at joint {joint.index}, where it should start at "
                    f"the end of segments[{joint.index - 1}]",
                    f"a gap of at most {tolerance:g} m",
                )
        lengths = [segment.length for segment in self.segments]
        self.length: Final = math.fsum(lengths)
        self._after: Final = tuple(itertools.accumulate(reversed(lengths[1:]), initial=0.0))[::-1]

    def evaluate(self, i: int, t: float) -> PathPoint:
        """The point at t in [0, 1] of subpath i (from 0)."""
        return self.segments[i].evaluate(t)

    @cached_property
    def rows(self) -> PathRows:
        """The path as numbers."""
        subpaths = Subpaths(self.segments, self.joints, self._after)
        return PathRows(self.n, subpaths, subpaths.piece)

    def at(self, s: float) -> PathPoint:
        """The point at s, Eq. (1); s is held within [0, n]."""
        s = min(max(s, 0.0), float(self.n))
        i = min(int(s), self.n - 1)
        return self.segments[i].evaluate(s - i)

    def distance_to_go(self, i: int, t: float) -> float:
        """Length of path from t of subpath i (from 0) to the end of the path, m."""
        return self.segments[i].length_to_go(t) + self._after[i]

    @property
    def start_pose(self) -> tuple[float, float, float]:
        """Where the path starts and with which course: x, y (m), chi_p (rad), NED."""
        p = self.segments[0].evaluate(0.0)
        return p.x, p.y, p.chi

    def polyline(self, spacing: float) -> tuple[Array, Array, Array]:
        """The path as points of Eq. (2), the ends of all subpaths among them, for drawing and publishing.

        Args:
            spacing: largest length of path between neighbours, m.

        Returns:
            x, y (NED, m) and s, each of shape (m,).
        """
        xs, ys, ss = [], [], []
        for i, segment in enumerate(self.segments):
            fastest = float(np.max(segment.evaluate(np.linspace(0.0, 1.0, 65)).speed))
            t = np.linspace(0.0, 1.0, max(1, math.ceil(fastest / spacing)) + 1)
            # The end of a subpath is the start of the next one: keep it once.
            t = t if i == self.n - 1 else t[:-1]
            p: Any = segment.evaluate(t)
            xs.append(p.x)
            ys.append(p.y)
            ss.append(i + t)
        return np.concatenate(xs), np.concatenate(ys), np.concatenate(ss)

    def distance(self, x: Array, y: Array, i: npt.NDArray[Any]) -> Array:
        """How far a track is from the path, near the subpath that was being followed.

        Args:
            x, y: shape (n,), NED, m.
            i: shape (n,), subpath followed at each sample, from 0; it and its neighbours are searched.

        Returns:
            closest distance, shape (n,), m, not negative; NaN where x or y is not finite.
        """
        followed = np.asarray(i)
        order = np.argsort(followed, kind="stable")
        in_order = followed[order]
        result = np.full(len(x), np.inf)
        # Only subpaths near which there are samples, each with its own: the path may have many thousands.
        for j in np.unique(np.concatenate([in_order + step for step in (-1, 0, 1)])):
            if 0 <= j < self.n:
                first, last = np.searchsorted(in_order, (j - 1, j + 2))
                near = order[first:last]
                found = closest_distance(self.segments[j], x[near], y[near])
                result[near] = np.minimum(result[near], found)
        return result


def _joint(number: int, end: PathPoint, start: PathPoint) -> Joint:
    chi_in, chi_out = end.chi, start.chi
    angle_step = wrap(chi_out - chi_in)
    curvature_step = start.kappa - end.kappa
    geometric: Literal["G0", "G1", "G2"] = "G0"
    if abs(angle_step) <= ANGLE_TOLERANCE:
        geometric = "G2" if abs(curvature_step) <= CURVATURE_TOLERANCE else "G1"
    allowed = DERIVATIVE_TOLERANCE * max(start.speed, end.speed)
    parametric: Literal["C0", "C1", "C2"] = "C0"
    if math.hypot(start.dx - end.dx, start.dy - end.dy) <= allowed:
        parametric = "C2" if math.hypot(start.ddx - end.ddx, start.ddy - end.ddy) <= allowed else "C1"
    return Joint(
        index=number,
        x=start.x,
        y=start.y,
        gap=math.hypot(start.x - end.x, start.y - end.y),
        chi_in=chi_in,
        chi_out=chi_out,
        angle_step=angle_step,
        curvature_step=curvature_step,
        geometric=geometric,
        parametric=parametric,
    )
