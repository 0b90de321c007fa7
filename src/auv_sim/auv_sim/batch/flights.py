"""The figures of many flights, one row each."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from auv_sim.batch import tally
from auv_sim.batch.flight import End

Column = npt.NDArray[np.float64]

#: Units of the figures that are one number for each flight; what is not here has none.
UNITS = {
    "duration": "s",
    "rms_distance": "m",
    "largest_distance": "m",
    "late_rms_distance": "m",
    "late_largest_distance": "m",
    "time_to_path": "s",
    "rms_heading_error": "deg",
    "distance_covered": "m",
    "rudder_travel": "deg",
    "rudder_travel_per_metre": "deg/m",
    "rms_rudder_rate": "deg/s",
    "largest_rudder_rate": "deg/s",
    "current_estimate_error": "m/s",
    "last_x": "m",
    "last_y": "m",
}


@dataclass(frozen=True, eq=False)
class Flights:
    """One row for each flight. Every column has shape (n,); NaN where a flight never came so far.

    Distances are to the path and in m, as in `analysis.metrics`; `subpath_*` have shape (n, most subpaths).

    Attributes:
        completed: whether the end of the path was reached.
        flown_share: share of the path that was flown, 0 to 1, as `analysis.flown_share` defines it.
        finite: whether the state stayed finite; a flight in which it did not has ended there.
        steps: odometries.
        duration: s.
        progress: s of Eq. (1) at the end, in [0, number of subpaths].
        rms_distance, largest_distance: over the whole flight.
        late_rms_distance, late_largest_distance: from `time_to_path` on.
        time_to_path: when the path was joined, as `tally.ARRIVED` defines it, s.
        rms_heading_error: deg.
        distance_covered: m.
        rudder_travel: deg; rudder_travel_per_metre: deg/m.
        rms_rudder_rate, largest_rudder_rate: of the command, deg/s.
        saturated: share of the commands that stood at the stop.
        current_estimate_error: the largest after the observer has settled, m/s.
        last_x, last_y: where it ended, NED, m.
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
    time_to_path: Column
    rms_heading_error: Column
    distance_covered: Column
    rudder_travel: Column
    rudder_travel_per_metre: Column
    rms_rudder_rate: Column
    largest_rudder_rate: Column
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
    def from_rows(cls, rows: Sequence[dict[str, Any]]) -> Flights:
        """From the figures of each flight, see `figures_of`."""
        columns: dict[str, Any] = {}
        for field in dataclasses.fields(cls):
            values = [row[field.name] for row in rows]
            columns[field.name] = _ragged(values) if field.name in _OF_SUBPATHS else np.array(values)
        return cls(**columns)


_OF_SUBPATHS = ("subpath_rms_distance", "subpath_largest_distance", "subpath_duration")


def figures_of(end: End, whole: Column, subpaths: Column, share: float, dt: float) -> dict[str, Any]:
    """A flight's figures from its tallies and its flown share, by the names of `Flights`."""
    n = len(subpaths)
    rows = subpaths[:, tally.ROWS]
    counted, late = float(rows.sum()), float(whole[tally.LATE_ROWS])
    commands = float(whole[tally.COMMANDS])
    covered = float(subpaths[:, tally.COVERED].sum())
    travel = math.degrees(float(subpaths[:, tally.TRAVEL].sum()))
    squares = float(subpaths[:, tally.SQUARES].sum())
    with np.errstate(divide="ignore", invalid="ignore"):
        subpath_rms = np.sqrt(subpaths[:, tally.SQUARES] / rows)
    return {
        "completed": bool(end.finite and end.s >= n),
        "flown_share": share,
        "finite": bool(end.finite),
        "steps": int(end.rows),
        "duration": (end.rows - 1) * dt,
        "progress": float(end.s),
        "rms_distance": _root(squares, counted),
        "largest_distance": _known(float(subpaths[:, tally.LARGEST].max())),
        "late_rms_distance": _root(float(whole[tally.LATE_SQUARES]), late),
        "late_largest_distance": _known(float(whole[tally.LATE_LARGEST])),
        "time_to_path": float(whole[tally.TIME_TO_PATH]),
        "rms_heading_error": math.degrees(_root(float(subpaths[:, tally.HEADING_SQUARES].sum()), counted)),
        "distance_covered": covered,
        "rudder_travel": travel,
        "rudder_travel_per_metre": travel / covered if covered > 0.0 else math.nan,
        "rms_rudder_rate": math.degrees(_root(float(whole[tally.RATE_SQUARES]), commands)),
        "largest_rudder_rate": math.degrees(float(whole[tally.RATE_LARGEST])),
        "saturated": float(whole[tally.SATURATED]) / commands if commands > 0.0 else math.nan,
        "current_estimate_error": _known(float(whole[tally.ESTIMATE_ERROR])),
        "last_x": float(end.state.x),
        "last_y": float(end.state.y),
        "subpath_rms_distance": subpath_rms,
        "subpath_largest_distance": np.where(rows > 0, subpaths[:, tally.LARGEST], np.nan),
        "subpath_duration": np.where(rows > 0, subpaths[:, tally.DURATION], np.nan),
    }


def _root(squares: float, count: float) -> float:
    return math.sqrt(squares / count) if count > 0 else math.nan


def _known(value: float) -> float:
    return value if math.isfinite(value) else math.nan


def _ragged(values: Sequence[Column]) -> Column:
    widest = max((len(value) for value in values), default=0)
    table = np.full((len(values), widest), np.nan)
    for row, value in enumerate(values):
        table[row, : len(value)] = value
    return table
