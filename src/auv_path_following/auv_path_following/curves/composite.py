"""The composite path: consecutive subpaths under one scalar s in [0, n], Eq. (1)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from functools import cached_property
from typing import Any, Final

import numpy as np
import numpy.typing as npt

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.closest import closest_distance
from auv_path_following.curves.joints import joint_between
from auv_path_following.curves.rows import PathRows
from auv_path_following.curves.segment import PathPoint, Segment
from auv_path_following.curves.subpaths import Subpaths

Array = npt.NDArray[np.float64]


class CompositePath:
    """Consecutive subpaths; subpath i (from 0) covers s in [i, i + 1). Immutable; evaluation costs O(1).

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
            joint_between(number, before.evaluate(1.0), after.evaluate(0.0))
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
        """Return the point at t in [0, 1] of subpath i (from 0)."""
        return self.segments[i].evaluate(t)

    @cached_property
    def rows(self) -> PathRows:
        """The path as rows of numbers."""
        subpaths = Subpaths(self.segments, self.joints, self._after)
        return PathRows(self.n, subpaths, subpaths.piece)

    def at(self, s: float) -> PathPoint:
        """Return the point at s, Eq. (1), bounded to [0, n]."""
        s = min(max(s, 0.0), float(self.n))
        i = min(int(s), self.n - 1)
        return self.segments[i].evaluate(s - i)

    def distance_to_go(self, i: int, t: float) -> float:
        """Return the length of path from t of subpath i (from 0) to the end of the path, m."""
        return self.segments[i].length_to_go(t) + self._after[i]

    @property
    def start_pose(self) -> tuple[float, float, float]:
        """Start of the path: x, y (m) and chi_p (rad), NED."""
        p = self.segments[0].evaluate(0.0)
        return p.x, p.y, p.chi

    def polyline(self, spacing: float) -> tuple[Array, Array, Array]:
        """Return the path as points of Eq. (2), all joints included, for drawing and publishing.

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
        """Return the distance of a track from the path, near the subpath followed.

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
