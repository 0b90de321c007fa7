"""Judges a flown mission against its path: per subpath, at the corners and as a whole."""

from __future__ import annotations

import math

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.figures.flown_rows import FlownRows, largest_of
from auv_sim.flight.figures.mission_summary import (
    CornerSummary,
    MissionSummary,
    SpatialMissionSummary,
    SpatialSubpathSummary,
    SubpathSummary,
)
from auv_sim.flight.flown_share import flown_share
from auv_sim.flight.path_cells import apart
from auv_sim.flight.run_record import Column, Run, SpatialRun

#: Time after the start from which the current estimate is judged, s.
OBSERVER_SETTLING_TIME = 15.0


def summarise(run: Run, path: CompositePath | SpatialPath, begin: float = 0.0) -> MissionSummary:
    """Judge a run against the path it followed, by the true positions where they are known.

    Only the rows under way count (see `under_way`). Averages are over rows. What happens between two
    rows belongs to the subpath of the earlier one.

    Args:
        run: the flown mission; for a path in three dimensions a `SpatialRun`.
        path: the path of that mission, NED. That of one in three dimensions, or its plan.
        begin: s of Eq. (1) at which the mission began.

    Returns:
        The figures; of a path in three dimensions a `SpatialMissionSummary`.
    """
    flown = under_way(run, path.n)
    part = flown_share(flown, path, begin)
    rows = FlownRows(flown, path)
    whole = rows.figures(np.ones(flown.steps, bool))
    corners, free = rows.corners(path)
    of_mission, of_subpath = _classes(path)
    return of_mission(
        completed=bool((run.s >= path.n).any()),
        flown_share=part.share,
        missed=part.missed,
        skipped=part.skipped,
        steps=run.steps,
        path_length=path.length,
        mean_speed=whole["distance_covered"] / whole["duration"] if whole["duration"] > 0.0 else math.nan,
        current_estimate_error=_current_estimate_error(flown),
        subpaths=tuple(
            of_subpath(number=k + 1, kind=kind, **rows.figures(rows.subpath == k))
            for k, kind in enumerate(_kinds(path))
        ),
        corners=tuple(CornerSummary(corner.number, corner.x, corner.y, off) for corner, off in corners),
        largest_distance_off_corners=largest_of(rows.distance[free]),
        navigation_error=largest_of(_navigation_errors(flown)),
        **whole,
    )


def _classes(path: CompositePath | SpatialPath) -> tuple[type[MissionSummary], type[SubpathSummary]]:
    if isinstance(path, SpatialPath):
        return SpatialMissionSummary, SpatialSubpathSummary
    return MissionSummary, SubpathSummary


def _kinds(path: CompositePath | SpatialPath) -> list[str]:
    if isinstance(path, SpatialPath):
        return [subpath.plan.kind for subpath in path.subpaths]
    return [segment.kind for segment in path.segments]


def _navigation_errors(flown: Run) -> Column:
    dx, dy = flown.x_true - flown.x, flown.y_true - flown.y
    return apart(dx, dy, flown.z_true - flown.z if isinstance(flown, SpatialRun) else None)


def under_way(run: Run, n: int) -> Run:
    """Return the rows in which the mission runs.

    From the first row with a known s (and with thrust, where the thrust is known) to the one in which s
    reaches the end of the path.

    Args:
        run: the flown mission.
        n: number of subpaths of the path.
    """
    started = np.isfinite(run.s)
    if np.isfinite(run.thrust_cmd).any():
        started &= run.thrust_cmd > 0.0
    if not started.any():
        return run.select(slice(0, 0))
    first = int(np.argmax(started))
    arrived = np.flatnonzero(run.s[first:] >= n)
    last = first + int(arrived[0]) if arrived.size else run.steps - 1
    flown = run.select(slice(first, last + 1))
    return flown.select(np.isfinite(flown.s))


def _current_estimate_error(flown: Run) -> float:
    if not flown.steps:
        return math.nan
    settled = flown.t - flown.t[0] >= OBSERVER_SETTLING_TIME
    down = flown.Vz_est - flown.Vz_true if isinstance(flown, SpatialRun) else None
    return largest_of(apart(flown.Vx_est - flown.Vx_true, flown.Vy_est - flown.Vy_true, down)[settled])


def root_mean_square(values: Column) -> float:
    """Return the root mean square; NaN of nothing."""
    return float(np.sqrt(np.mean(values**2))) if values.size else math.nan
