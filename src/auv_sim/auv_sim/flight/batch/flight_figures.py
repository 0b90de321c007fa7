"""The figures of many flights, a row each."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from auv_sim.flight.batch import tally

Column = npt.NDArray[np.float64]

#: Units of the figures with one number a flight; the others have none.
UNITS = {
    "duration": "s",
    "rms_distance": "m",
    "largest_distance": "m",
    "late_rms_distance": "m",
    "late_largest_distance": "m",
    "off_corners_rms_distance": "m",
    "off_corners_largest_distance": "m",
    "time_to_path": "s",
    "rms_heading_error": "deg",
    "distance_covered": "m",
    "rudder_travel": "deg",
    "rudder_travel_per_metre": "deg/m",
    "rms_rudder_rate": "deg/s",
    "largest_rudder_rate": "deg/s",
    "late_rms_yaw_rate": "deg/s",
    "current_estimate_error": "m/s",
    "last_x": "m",
    "last_y": "m",
    "rms_depth_error": "m",
    "largest_depth_error": "m",
    "steady_rms_depth_error": "m",
    "steady_largest_depth_error": "m",
    "late_rms_pitch_rate": "deg/s",
    "largest_pitch": "deg",
    "sternplane_travel": "deg",
    "sternplane_travel_per_metre": "deg/m",
    "last_z": "m",
}


@dataclass(frozen=True, eq=False)
class Flights:
    """One row for each flight. Every column has shape (n,); NaN where a flight ended before.

    Distances are to the path and in m, as in `flight.metrics`; `subpath_*` have shape (n, most subpaths).

    Attributes:
        completed: whether the end of the path was reached.
        flown_share: share of the path that was flown, 0 to 1, as `flight.flown_share` defines it.
        finite: whether the state stayed finite; a flight ends where it does not.
        steps: odometries.
        duration: s.
        progress: s of Eq. (1) at the end, in [0, number of subpaths].
        rms_distance, largest_distance: over the whole flight.
        late_rms_distance, late_largest_distance: from `time_to_path` on.
        off_corners_rms_distance, off_corners_largest_distance: farther than `path_cells.CORNER_RADIUS` from
            every corner.
        time_to_path: time until the path was joined, as `tally.ARRIVED` defines it, s.
        rms_heading_error: deg.
        distance_covered: m.
        rudder_travel: deg; rudder_travel_per_metre: deg/m.
        rms_rudder_rate, largest_rudder_rate: of the command, deg/s.
        late_rms_yaw_rate: as measured, from `tally.calm_time` on, deg/s.
        saturated: share of the commands at the stop.
        current_estimate_error: the largest after the observer has settled, m/s.
        last_x, last_y: last position, NED, m.
        subpath_rms_distance, subpath_largest_distance, subpath_duration: of each subpath (m, m, s).
    """

    completed: npt.NDArray[np.bool_]
    flown_share: Column
    finite: npt.NDArray[np.bool_]
    steps: npt.NDArray[np.int64]
    duration: Column
    progress: Column
    rms_distance: Column
    largest_distance: Column
    late_rms_distance: Column
    late_largest_distance: Column
    off_corners_rms_distance: Column
    off_corners_largest_distance: Column
    time_to_path: Column
    rms_heading_error: Column
    distance_covered: Column
    rudder_travel: Column
    rudder_travel_per_metre: Column
    rms_rudder_rate: Column
    largest_rudder_rate: Column
    late_rms_yaw_rate: Column
    saturated: Column
    current_estimate_error: Column
    last_x: Column
    last_y: Column
    subpath_rms_distance: Column
    subpath_largest_distance: Column
    subpath_duration: Column

    def __len__(self) -> int:
        return len(self.steps)

    @classmethod
    def joined(cls, parts: Sequence[tuple[Sequence[int], dict[str, Any]]], number: int) -> Flights:
        """Return all flights in their order; `SpatialFlights` if one of them is in three dimensions.

        Args:
            parts: places of some flights, and their figures by name, see `figures_of`.
            number: of all flights.
        """
        columns: dict[str, Any] = {}
        made = SpatialFlights if any("last_z" in figures for _, figures in parts) else cls
        for field in dataclasses.fields(made):
            blocks = [
                (places, np.asarray(figures[field.name]))
                for places, figures in parts
                if field.name in figures
            ]
            kind = _KINDS.get(field.name, np.float64)
            shape: tuple[int, ...] = (number,)
            if field.name in _OF_SUBPATHS:
                shape = (number, max((block.shape[1] for _, block in blocks), default=0))
            column = np.full(shape, np.nan if kind is np.float64 else 0, kind)
            for places, block in blocks:
                if block.ndim == 2:
                    column[np.asarray(places)[:, None], np.arange(block.shape[1])] = block
                else:
                    column[places] = block
            columns[field.name] = column
        return made(**columns)


@dataclass(frozen=True, eq=False)
class SpatialFlights(Flights):
    """Flights of which some are in three dimensions; the further figures are NaN for the others.

    A depth error is the depth less that of the closest point of the path. The steady ones count from
    `spatial_tally.SETTLING_TIME` after `time_to_path` on, farther than `path_cells.CORNER_RADIUS` from every
    corner.

    Attributes:
        rms_depth_error, largest_depth_error: over the whole flight.
        steady_rms_depth_error, steady_largest_depth_error: settled on the path, away from corners.
        late_rms_pitch_rate: true, from `tally.calm_time` on, deg/s.
        largest_pitch: absolute, deg.
        sternplane_travel: deg; sternplane_travel_per_metre: deg/m.
        last_z: last depth, m.
        subpath_rms_depth_error: of each subpath, m.
    """

    rms_depth_error: Column
    largest_depth_error: Column
    steady_rms_depth_error: Column
    steady_largest_depth_error: Column
    late_rms_pitch_rate: Column
    largest_pitch: Column
    sternplane_travel: Column
    sternplane_travel_per_metre: Column
    last_z: Column
    subpath_rms_depth_error: Column


_OF_SUBPATHS = (
    "subpath_rms_distance",
    "subpath_largest_distance",
    "subpath_duration",
    "subpath_rms_depth_error",
)
_KINDS: dict[str, Any] = {"completed": np.bool_, "finite": np.bool_, "steps": np.int64}


def figures_of(ends: Column, whole: Column, subpaths: Column, dt: Column) -> dict[str, Any]:
    """Return the figures of n flights of m subpaths from their tallies, by the names of `Flights`.

    Args:
        ends: shape (n, ENDS), how each ended, see `tally`.
        whole: shape (n, FLIGHT_TALLIES).
        subpaths: shape (n, m, SUBPATH_TALLIES).
        dt: shape (n,), between two odometries, s.
    """
    rows = subpaths[:, :, tally.ROWS]
    counted = rows.sum(axis=1)
    covered = subpaths[:, :, tally.COVERED].sum(axis=1)
    travel = np.degrees(subpaths[:, :, tally.TRAVEL].sum(axis=1))
    finite = ends[:, tally.FINITE] > 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        return {
            "completed": finite & (ends[:, tally.S] >= subpaths.shape[1]),
            "flown_share": ends[:, tally.SHARE],
            "finite": finite,
            "steps": ends[:, tally.ODOMETRIES].astype(np.int64),
            "duration": (ends[:, tally.ODOMETRIES] - 1.0) * dt,
            "progress": ends[:, tally.S],
            "rms_distance": root_mean(subpaths[:, :, tally.SQUARES].sum(axis=1), counted),
            "largest_distance": _known(subpaths[:, :, tally.LARGEST].max(axis=1)),
            "late_rms_distance": root_mean(whole[:, tally.LATE_SQUARES], whole[:, tally.LATE_ROWS]),
            "late_largest_distance": _known(whole[:, tally.LATE_LARGEST]),
            **_of_straights(whole),
            "time_to_path": whole[:, tally.TIME_TO_PATH],
            "rms_heading_error": np.degrees(
                root_mean(subpaths[:, :, tally.HEADING_SQUARES].sum(axis=1), counted)
            ),
            "distance_covered": covered,
            "rudder_travel": travel,
            "rudder_travel_per_metre": np.where(covered > 0.0, travel / covered, np.nan),
            **_of_steering(whole),
            "current_estimate_error": _known(whole[:, tally.ESTIMATE_ERROR]),
            "last_x": ends[:, tally.LAST_X],
            "last_y": ends[:, tally.LAST_Y],
            "subpath_rms_distance": np.sqrt(subpaths[:, :, tally.SQUARES] / rows),
            "subpath_largest_distance": np.where(rows > 0, subpaths[:, :, tally.LARGEST], np.nan),
            "subpath_duration": np.where(rows > 0, subpaths[:, :, tally.DURATION], np.nan),
        }


def _of_straights(whole: Column) -> dict[str, Any]:
    """Return the figures away from corners."""
    return {
        "off_corners_rms_distance": root_mean(whole[:, tally.FREE_SQUARES], whole[:, tally.FREE_ROWS]),
        "off_corners_largest_distance": _known(whole[:, tally.FREE_LARGEST]),
    }


def _of_steering(whole: Column) -> dict[str, Any]:
    """Return the figures of commands and of the late yaw rate."""
    commands = whole[:, tally.COMMANDS]
    return {
        "rms_rudder_rate": np.degrees(root_mean(whole[:, tally.RATE_SQUARES], commands)),
        "largest_rudder_rate": np.degrees(whole[:, tally.RATE_LARGEST]),
        "late_rms_yaw_rate": np.degrees(root_mean(whole[:, tally.YAW_SQUARES], whole[:, tally.CALM_ROWS])),
        "saturated": np.where(commands > 0.0, whole[:, tally.SATURATED] / commands, np.nan),
    }


def root_mean(squares: Column, count: Column) -> Column:
    """Return the root of the mean square; NaN where nothing was counted."""
    return np.asarray(np.where(count > 0, np.sqrt(squares / count), np.nan))


def _known(values: Column) -> Column:
    return np.where(np.isfinite(values), values, np.nan)
