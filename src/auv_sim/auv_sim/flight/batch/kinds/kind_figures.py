"""What is counted in a flight by the kind of its path, and the figures that its tallies give."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.batch import tally
from auv_sim.flight.batch.flight_figures import Column, figures_of, root_mean
from auv_sim.flight.batch.kinds.spatial_tally import (
    DEPTH_LARGEST,
    DEPTH_SQUARES,
    LAST_Z,
    PITCH_SQUARES,
    PLANES_TRAVEL,
    SINE_OF_PITCH,
    SPATIAL_ENDS,
    SPATIAL_FLIGHT_TALLIES,
    SPATIAL_SUBPATH_TALLIES,
    STEADY_LARGEST,
    STEADY_ROWS,
    STEADY_SQUARES,
)


def tallies_of(n: int, path: CompositePath | SpatialPath) -> tuple[Any, Any, Any]:
    """Return the tallies of n flights of a path, of their subpaths, and their ends: not yet reset."""
    if isinstance(path, SpatialPath):
        sizes = SPATIAL_FLIGHT_TALLIES, SPATIAL_SUBPATH_TALLIES, SPATIAL_ENDS
    else:
        sizes = tally.FLIGHT_TALLIES, tally.SUBPATH_TALLIES, tally.ENDS
    return np.empty((n, sizes[0])), np.empty((n, path.n, sizes[1])), np.empty((n, sizes[2]))


def figures_by(path: CompositePath | SpatialPath) -> Callable[..., dict[str, Any]]:
    """Return the function that makes figures of the tallies of flights of a path, see `figures_of`."""
    return spatial_figures_of if isinstance(path, SpatialPath) else figures_of


def spatial_figures_of(ends: Column, whole: Column, subpaths: Column, dt: Column) -> dict[str, Any]:
    """Return the figures of flights in three dimensions, by the names of `SpatialFlights`."""
    rows = subpaths[:, :, tally.ROWS]
    counted, travel = rows.sum(axis=1), np.degrees(subpaths[:, :, PLANES_TRAVEL].sum(axis=1))
    covered, steady = subpaths[:, :, tally.COVERED].sum(axis=1), whole[:, STEADY_ROWS]
    sine = np.minimum(subpaths[:, :, SINE_OF_PITCH].max(axis=1), 1.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return figures_of(ends, whole, subpaths, dt) | {
            "rms_depth_error": root_mean(subpaths[:, :, DEPTH_SQUARES].sum(axis=1), counted),
            "largest_depth_error": np.where(counted > 0, subpaths[:, :, DEPTH_LARGEST].max(axis=1), np.nan),
            "steady_rms_depth_error": root_mean(whole[:, STEADY_SQUARES], steady),
            "steady_largest_depth_error": np.where(steady > 0, whole[:, STEADY_LARGEST], np.nan),
            "late_rms_pitch_rate": np.degrees(root_mean(whole[:, PITCH_SQUARES], whole[:, tally.CALM_ROWS])),
            "largest_pitch": np.where(counted > 0, np.degrees(np.arcsin(sine)), np.nan),
            "sternplane_travel": travel,
            "sternplane_travel_per_metre": np.where(covered > 0.0, travel / covered, np.nan),
            "last_z": ends[:, LAST_Z],
            "subpath_rms_depth_error": np.sqrt(subpaths[:, :, DEPTH_SQUARES] / rows),
        }
