"""The figures of a flown mission: per subpath, at the corners and as a whole."""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.flown_rows import FlownRows, largest_of
from auv_sim.flight.flown_share import Stretch, flown_share, listed, percent
from auv_sim.flight.least_share import LEAST_SHARE
from auv_sim.flight.path_cells import apart
from auv_sim.flight.run_record import Column, Run, SpatialRun

#: Time after the start from which the current estimate is judged, s.
OBSERVER_SETTLING_TIME = 15.0


@dataclass(frozen=True)
class SubpathSummary:
    """One subpath. NaN where nothing was flown or the recording lacks the signal.

    Attributes:
        number: counted from 1 as the paper does.
        kind: of the segment (``line``).
        duration: time on it, s.
        rms_distance, largest_distance: to the path, m.
        rms_heading_error: of psi_e, deg.
        rudder_travel: sum of the rudder's movements, deg.
        rudder_travel_per_metre: the same for each metre covered, deg/m.
        distance_covered: length of the track over ground, m.
    """

    number: int
    kind: str
    duration: float
    rms_distance: float
    largest_distance: float
    rms_heading_error: float
    rudder_travel: float
    rudder_travel_per_metre: float
    distance_covered: float


@dataclass(frozen=True)
class CornerSummary:
    """A joint at which the course jumps (G0).

    Attributes:
        joint: number of the subpath that ends here.
        x, y: where it is, NED, m.
        largest_distance: to the path within `CORNER_RADIUS` of the joint, on the two subpaths it joins, m.
    """

    joint: int
    x: float
    y: float
    largest_distance: float


Part = TypeVar("Part", SubpathSummary, CornerSummary)


@dataclass(frozen=True)
class MissionSummary:
    """The whole mission, from the first thrust to the end of the path. NaN where the signal is missing.

    Attributes:
        completed: whether the virtual point reached the end of the path.
        flown_share: share of the path that was flown, 0 to 1, as `flown_share` defines it.
        missed: stretches that were not flown, m of path.
        skipped: stretches that a rejoin after a hold skipped, m of path; they are not among the missed ones.
        steps: odometries in the run.
        duration: s.
        path_length, distance_covered: m.
        mean_speed: over ground, m/s.
        rms_distance, largest_distance: to the path, m.
        rms_heading_error: deg.
        rudder_travel, rudder_travel_per_metre: deg, deg/m.
        current_estimate_error: largest error of the estimate from `OBSERVER_SETTLING_TIME` after the
            start on, m/s.
        subpaths: one for each subpath of the path.
        corners: one for each G0 joint.
        largest_distance_off_corners: to the path, farther than `CORNER_RADIUS` from every G0 joint, m.
        navigation_error: largest distance of the odometry from the truth, m.
    """

    completed: bool
    flown_share: float
    missed: tuple[Stretch, ...]
    skipped: tuple[Stretch, ...]
    steps: int
    duration: float
    path_length: float
    distance_covered: float
    mean_speed: float
    rms_distance: float
    largest_distance: float
    rms_heading_error: float
    rudder_travel: float
    rudder_travel_per_metre: float
    current_estimate_error: float
    subpaths: tuple[SubpathSummary, ...]
    corners: tuple[CornerSummary, ...]
    largest_distance_off_corners: float
    navigation_error: float

    def to_json(self) -> str:
        """Return strict JSON, indented; NaN becomes null."""
        return json.dumps(without_nan(dataclasses.asdict(self)), indent=2, allow_nan=False)

    def outcome(self, least_share: float = LEAST_SHARE) -> str:
        """Return how the mission ended: complete, incomplete (too little flown), or not at the end."""
        if not self.completed:
            return "end of the path not reached"
        return "incomplete" if self.shortfall(least_share) else "complete"

    def shortfall(self, least_share: float = LEAST_SHARE) -> str:
        """Return why a mission is incomplete, with the missed stretches; empty if enough was flown."""
        if self.flown_share >= least_share:
            return ""
        return (
            f"found {percent(self.flown_share)} of the path flown,"
            f" expected at least {100.0 * least_share:g} %: missed {listed(self.missed)}"
        )

    def flown_line(self) -> str:
        """Return the flown share and the stretches that were missed or skipped, as text."""
        parts = [f"flown: {percent(self.flown_share)} of the path"]
        parts += [f"missed {listed(self.missed)}"] if self.missed else []
        parts += [f"skipped after a hold {listed(self.skipped)}"] if self.skipped else []
        return "; ".join(parts)


@dataclass(frozen=True)
class SpatialSubpathSummary(SubpathSummary):
    """One subpath in three dimensions: distances have a vertical part.

    Attributes:
        rms_depth_error, largest_depth_error: depth less that of the closest point of the path, m.
        sternplane_travel, sternplane_travel_per_metre: of the stern planes, deg, deg/m.
        largest_pitch: absolute, deg.
    """

    rms_depth_error: float
    largest_depth_error: float
    sternplane_travel: float
    sternplane_travel_per_metre: float
    largest_pitch: float


@dataclass(frozen=True)
class SpatialMissionSummary(MissionSummary):
    """The whole mission in three dimensions.

    Attributes:
        rms_depth_error, largest_depth_error: m.
        sternplane_travel, sternplane_travel_per_metre: deg, deg/m.
        largest_pitch: absolute, deg.
    """

    rms_depth_error: float
    largest_depth_error: float
    sternplane_travel: float
    sternplane_travel_per_metre: float
    largest_pitch: float


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


def farthest(parts: Sequence[Part], most: int) -> list[Part]:
    """Return the subpaths or corners on which the vehicle was farthest from the path, in the path's order.

    Args:
        parts: all of them, in the path's order.
        most: most parts to return; those that were not reached rank last.
    """
    ranked = sorted(range(len(parts)), key=lambda k: -np.nan_to_num(parts[k].largest_distance, nan=-1.0))
    return [parts[k] for k in sorted(ranked[:most])]


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


def without_nan(value: Any) -> Any:
    """Return plain data with null where a number is not finite, for strict JSON."""
    if isinstance(value, dict):
        return {key: without_nan(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [without_nan(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
