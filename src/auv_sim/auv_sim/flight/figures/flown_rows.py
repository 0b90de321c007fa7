"""Figures of rows of a run: distances to its path, and what happens between two rows."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.path_cells import CORNER_RADIUS, Corner, apart, corners_of
from auv_sim.flight.run_record import Column, Run, SpatialRun


class FlownRows:
    """The rows of a run under way, with their distances to the path and the steps between them.

    Args:
        flown: the rows; for a path in three dimensions of a `SpatialRun`.
        path: the path of the mission, NED.

    Raises:
        TypeError: a path in three dimensions and a planar run.
    """

    def __init__(self, flown: Run, path: CompositePath | SpatialPath) -> None:
        self.subpath = flown.subpath(path.n)
        self.x, self.y = flown.track
        self._z: Column | None = None
        if isinstance(path, SpatialPath):
            if not isinstance(flown, SpatialRun):
                raise TypeError("found a planar run, expected one in three dimensions for this path")
            self._z = flown.depth
            self.distance, depth = path.closest(self.x, self.y, self._z, self.subpath)
            self.depth_error = self._z - depth
            self._planes_moved = np.degrees(np.abs(np.diff(flown.sternplanes)))
            pitch = np.where(np.isfinite(flown.theta_true), flown.theta_true, flown.theta)
            self._pitch = np.degrees(np.abs(pitch))
        else:
            self.distance = path.distance(self.x, self.y, self.subpath)
        down = None if self._z is None else np.diff(self._z)
        self._covered = apart(np.diff(self.x), np.diff(self.y), down)
        self._moved = np.degrees(np.abs(np.diff(flown.rudder)))
        self._elapsed = np.diff(flown.t)
        self._heading_error = np.degrees(flown.psi_e)

    def figures(self, rows: NDArray[np.bool_]) -> dict[str, Any]:
        """Return the figures of some rows, shape (n,), by the names of `SubpathSummary`."""
        steps = rows[:-1]
        travel, metres = _sum(self._moved[steps]), _sum(self._covered[steps])
        return {
            "duration": _sum(self._elapsed[steps]),
            "rms_distance": _rms(self.distance[rows]),
            "largest_distance": largest_of(self.distance[rows]),
            "rms_heading_error": _rms(self._heading_error[rows]),
            "rudder_travel": travel,
            "rudder_travel_per_metre": travel / metres if metres > 0.0 else math.nan,
            "distance_covered": metres,
        } | (self._vertical(rows, metres) if self._z is not None else {})

    def _vertical(self, rows: NDArray[np.bool_], metres: float) -> dict[str, Any]:
        """Return the further figures of `SpatialSubpathSummary`."""
        travel = _sum(self._planes_moved[rows[:-1]])
        return {
            "rms_depth_error": _rms(self.depth_error[rows]),
            "largest_depth_error": largest_of(np.abs(self.depth_error[rows])),
            "sternplane_travel": travel,
            "sternplane_travel_per_metre": travel / metres if metres > 0.0 else math.nan,
            "largest_pitch": largest_of(self._pitch[rows]),
        }

    def corners(
        self, path: CompositePath | SpatialPath
    ) -> tuple[list[tuple[Corner, float]], NDArray[np.bool_]]:
        """Return each corner with the largest distance near it, m, and the rows that are near none of them.

        Near is within `CORNER_RADIUS`, on the two subpaths that meet; the path may pass there again later.
        """
        corners, free = [], np.ones(len(self.x), bool)
        for corner in corners_of(path):
            down = None if self._z is None else self._z - corner.z
            near = apart(self.x - corner.x, self.y - corner.y, down) <= CORNER_RADIUS
            near &= (self.subpath == corner.number - 1) | (self.subpath == corner.number)
            corners.append((corner, largest_of(self.distance[near])))
            free &= ~near
        return corners, free


def _rms(values: Column) -> float:
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if known.size else math.nan


def largest_of(values: Column) -> float:
    """Return the largest of the values that are finite; NaN without one."""
    known = values[np.isfinite(values)]
    return float(known.max()) if known.size else math.nan


def _sum(values: Column) -> float:
    known = values[np.isfinite(values)]
    return float(known.sum()) if known.size else math.nan
