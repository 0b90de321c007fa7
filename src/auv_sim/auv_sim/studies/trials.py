"""Figures of many flights of one mission: of each flight, and of all together."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.metrics import summarise, under_way
from auv_sim.flight.path_cells import CORNER_RADIUS
from auv_sim.flight.run_record import Column, Run, SpatialRun

#: Time in which a vehicle joins the path and learns the current; its depth is judged afterwards, s.
JOINING_TIME = 30.0


@dataclass(frozen=True)
class Trial:
    """One flight, judged by the vehicle's true position.

    Attributes:
        params: which gains: the file, or the name of a shipped one.
        seed: of the sea.
        completed: whether the end of the path was reached.
        flown_share: share of the path that was flown, 0 to 1.
        duration: s.
        largest_distance: to the path away from G0 corners, m.
        largest_at_corners: to the path near them, m; NaN where there is none.
        rms_distance: to the path, m.
        navigation_error: largest distance of the odometry from the truth, m.
        rudder_travel: for each metre covered, deg/m.
        rudder_rate: rms, deg/s.
        largest_depth_error: true depth against the requested one, from `JOINING_TIME` on and away from G0
            corners, m; NaN for a vehicle in the plane.
        planes_travel: of the stern planes for each metre covered, deg/m; NaN for a vehicle in the plane.
    """

    params: str
    seed: int
    completed: bool
    flown_share: float
    duration: float
    largest_distance: float
    largest_at_corners: float
    rms_distance: float
    navigation_error: float
    rudder_travel: float
    rudder_rate: float
    largest_depth_error: float = math.nan
    planes_travel: float = math.nan


def judge(run: Run, path: CompositePath, params: str, seed: int) -> Trial:
    """Return the figures of one flight.

    Args:
        run: as flown.
        path: what it followed, NED.
        params, seed: gains and seed of the flight.
    """
    summary = summarise(run, path)
    flown = under_way(run, path.n)
    rate = np.degrees(np.diff(flown.rudder)) / np.diff(flown.t)
    corners = [corner.largest_distance for corner in summary.corners]
    depth_error, planes = _in_depth(flown, path) if isinstance(flown, SpatialRun) else (math.nan, math.nan)
    return Trial(
        params=params,
        seed=seed,
        completed=summary.completed,
        flown_share=summary.flown_share,
        duration=summary.duration,
        largest_distance=summary.largest_distance_off_corners,
        largest_at_corners=max(corners, default=math.nan),
        rms_distance=summary.rms_distance,
        navigation_error=summary.navigation_error,
        rudder_travel=summary.rudder_travel_per_metre,
        rudder_rate=float(np.sqrt(np.mean(rate**2))) if rate.size else math.nan,
        largest_depth_error=depth_error,
        planes_travel=planes,
    )


def _in_depth(flown: SpatialRun, path: CompositePath) -> tuple[float, float]:
    """Return the largest depth error (m) and the travel of the stern planes for each metre (deg/m)."""
    x, y = flown.track
    judged = flown.t - flown.t[:1] >= JOINING_TIME
    for joint in path.joints:
        if joint.geometric == "G0":
            judged &= np.hypot(x - joint.x, y - joint.y) > CORNER_RADIUS
    error = np.abs(np.where(np.isfinite(flown.z_true), flown.z_true, flown.z) - flown.depth_d)[judged]
    covered = float(np.hypot(np.diff(x), np.diff(y)).sum())
    travel = float(np.degrees(np.abs(np.diff(flown.sternplanes))).sum())
    return _of_known(np.max, error), travel / covered if covered > 0.0 else math.nan


@dataclass(frozen=True)
class Together:
    """All flights with one set of gains: medians, and the worst.

    Attributes:
        params: which gains.
        flights, completed, within: how many; how many reached the end of the path; how many of those kept the
            limit and flew enough of it.
        flown_share: the smallest share of the path that was flown, 0 to 1.
        median, worst: figure of `Trial` -> its value, of the flights that have one.
    """

    params: str
    flights: int
    completed: int
    within: int
    flown_share: float
    median: dict[str, float]
    worst: dict[str, float]


FIGURES = (
    "duration", "largest_distance", "largest_at_corners", "rms_distance", "navigation_error", "rudder_travel",
    "rudder_rate", "largest_depth_error", "planes_travel",
)  # fmt: skip


def _of_known(figure: Callable[[Column], Any], column: Column) -> float:
    """Return a figure of the finite numbers, NaN without any: a flight may end before its first corner."""
    known = column[np.isfinite(column)]
    return float(figure(known)) if known.size else math.nan


def _kept(trial: Trial, limit: float, least_share: float, depth_limit: float) -> bool:
    is_near = trial.largest_distance <= limit and not trial.largest_depth_error > depth_limit
    return trial.completed and is_near and trial.flown_share >= least_share


def together(
    trials: Sequence[Trial], limit: float, least_share: float, depth_limit: float = math.inf
) -> list[Together]:
    """Return a row for each set of gains, in order of appearance.

    Args:
        trials: the flights.
        limit: for `largest_distance`, m.
        least_share: for `flown_share`.
        depth_limit: for `largest_depth_error`, m.
    """
    rows = []
    for params in dict.fromkeys(trial.params for trial in trials):
        mine = [trial for trial in trials if trial.params == params]
        columns = {name: np.array([getattr(trial, name) for trial in mine]) for name in FIGURES}
        rows.append(
            Together(
                params=params,
                flights=len(mine),
                completed=sum(trial.completed for trial in mine),
                within=sum(_kept(trial, limit, least_share, depth_limit) for trial in mine),
                flown_share=min(trial.flown_share for trial in mine),
                median={name: _of_known(np.median, column) for name, column in columns.items()},
                worst={name: _of_known(np.max, column) for name, column in columns.items()},
            )
        )
    return rows
