"""Figures of many flights of one mission: of each flight, and of all together."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.metrics import summarise, under_way
from auv_sim.flight.run_record import Column, Run


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
    )


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
    "rudder_rate",
)  # fmt: skip


def _of_known(figure: Callable[[Column], Any], column: Column) -> float:
    """Return a figure of the finite numbers, NaN without any: a flight may end before its first corner."""
    known = column[np.isfinite(column)]
    return float(figure(known)) if known.size else math.nan


def _kept(trial: Trial, limit: float, least_share: float) -> bool:
    return trial.completed and trial.largest_distance <= limit and trial.flown_share >= least_share


def together(trials: Sequence[Trial], limit: float, least_share: float) -> list[Together]:
    """Return a row for each set of gains, in order of appearance.

    Args:
        trials: the flights.
        limit: for `largest_distance`, m.
        least_share: for `flown_share`.
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
                within=sum(_kept(trial, limit, least_share) for trial in mine),
                flown_share=min(trial.flown_share for trial in mine),
                median={name: _of_known(np.median, column) for name, column in columns.items()},
                worst={name: _of_known(np.max, column) for name, column in columns.items()},
            )
        )
    return rows
