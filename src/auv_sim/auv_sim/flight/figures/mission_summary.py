"""The figures of a flown mission as they are kept: of the whole, of each subpath, of each corner."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from auv_msgs_py.values.strict_json import without_nan
from auv_sim.flight.flown_share import Stretch, listed, percent
from auv_sim.flight.least_share import LEAST_SHARE


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
        current_estimate_error: largest error of the estimate from `metrics.OBSERVER_SETTLING_TIME` after the
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


def farthest(parts: Sequence[Part], most: int) -> list[Part]:
    """Return the subpaths or corners on which the vehicle was farthest from the path, in the path's order.

    Args:
        parts: all of them, in the path's order.
        most: most parts to return; those that were not reached rank last.
    """
    ranked = sorted(range(len(parts)), key=lambda k: -np.nan_to_num(parts[k].largest_distance, nan=-1.0))
    return [parts[k] for k in sorted(ranked[:most])]
