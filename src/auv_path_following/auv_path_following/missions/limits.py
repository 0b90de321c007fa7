"""The limits of a mission: area, distance from the path, depth, duration, speeds. No ROS, no clock."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import dispatched, numbers, numbers_of, pure
from auv_path_following.missions.mission_state import (
    DEPTH_ERROR,
    DURATION,
    GEOFENCE,
    GROUND_SPEED,
    MAX_DEPTH,
    MIN_ALTITUDE,
    NO_REASON,
    PATH_DISTANCE,
    PATH_SPEED,
    Reason,
)
from auv_path_following.missions.speed_window import NO_MARKS, Marks, covered, marked

Point = tuple[float, float]


@numbers
@settings
class LimitsConfig:
    """Limits that end a mission. 0 is no limit; of parameters and mission file the stricter value counts."""

    path_distance: float = setting(
        0.0, "largest distance from the virtual point, once the vehicle was within it; 0: any", unit="m",
        ge=0.0, live=True,
    )  # fmt: skip
    duration: float = setting(0.0, "longest mission; 0: any", unit="s", ge=0.0, live=True)
    ground_speed: float = setting(
        0.0, "lowest speed over ground; 0: any. Below it the current is too strong", unit="m/s",
        ge=0.0, live=True,
    )  # fmt: skip
    ground_speed_window: float = setting(
        30.0, "time over which the speed over ground is averaged", unit="s", ge=2.0, le=3600.0, live=True
    )
    path_speed: float = setting(
        0.0,
        "lowest speed of the virtual point along the path, once it has advanced that far within one window;"
        " 0: any. Below it the vehicle moves, but does not follow",
        unit="m/s", ge=0.0, live=True,
    )  # fmt: skip
    path_speed_window: float = setting(
        60.0, "time over which the speed along the path is averaged", unit="s", ge=2.0, le=3600.0, live=True
    )

    max_depth: float = setting(
        0.0, "largest depth; 0: 5 % more than depth.max of the vehicle file", unit="m", ge=0.0, live=True
    )
    min_altitude: float = setting(0.0, "lowest altitude above ground; 0: any", unit="m", ge=0.0, live=True)
    depth_error: float = setting(
        0.0, "largest difference of the depth from the path's, once it was within it; 0: any", unit="m",
        ge=0.0, live=True,
    )  # fmt: skip

    def stricter(self, other: LimitsConfig) -> LimitsConfig:
        """Return the limits where both apply; a window belongs to the higher speed."""
        ground = other if other.ground_speed > self.ground_speed else self
        along = other if other.path_speed > self.path_speed else self
        return dataclasses.replace(
            self,
            path_distance=_stricter(self.path_distance, other.path_distance),
            duration=_stricter(self.duration, other.duration),
            ground_speed=ground.ground_speed,
            ground_speed_window=ground.ground_speed_window,
            path_speed=along.path_speed,
            path_speed_window=along.path_speed_window,
            max_depth=_stricter(self.max_depth, other.max_depth),
            min_altitude=max(self.min_altitude, other.min_altitude),
            depth_error=_stricter(self.depth_error, other.depth_error),
        )


def _stricter(one: float, other: float) -> float:
    return min(one, other) if one and other else one or other


class MissionLimits(NamedTuple):
    """Configuration: the limits, and the corners (north, east), m, of the geofence."""

    values: LimitsConfig
    geofence: Any


class NoLimits(NamedTuple):
    """Configuration of a flight without limits: not even its time is counted."""


class LimitsState(NamedTuple):
    """State of the limits of one mission.

    Attributes:
        elapsed: s.
        has_been_near: whether the vehicle has been within `path_distance`.
        most_to_go: largest distance to go so far, m.
        has_followed: whether the virtual point has advanced as far as `path_speed` says in one window.
        places, to_go: marks of the position, and of the distance to go.
        has_been_at_depth: whether the vehicle has been within `depth_error`.
    """

    elapsed: float = 0.0
    has_been_near: bool = False
    most_to_go: float = -math.inf
    has_followed: bool = False
    places: Marks = NO_MARKS
    to_go: Marks = NO_MARKS
    has_been_at_depth: bool = False


#: The state at the beginning of a mission.
BEGINNING = LimitsState()


class LimitsInputs(NamedTuple):
    """What the limits judge at one measurement.

    Attributes:
        x, y, z: position, NED, m; z is 0 for a planar vehicle.
        off_path: distance from the virtual point, m.
        depth_error: distance below the requested depth, m; 0 for a planar vehicle.
        altitude: above the bottom, m; infinite where it is not measured.
        to_go: path from the virtual point to the end, m.
        holds: whether the mission holds; then only its time, depth and altitude count.
        rests: whether the vehicle rested until now; then the speed windows begin again.
    """

    x: float
    y: float
    z: float
    off_path: float
    depth_error: float
    altitude: float
    to_go: float
    holds: bool
    rests: bool


def prepare(config: LimitsConfig, geofence: Sequence[Point] = ()) -> MissionLimits:
    """Return the configuration of the limits.

    Args:
        config: the limits.
        geofence: corners (north, east), m; empty for no geofence.
    """
    return MissionLimits(numbers_of(config), tuple((float(x), float(y)) for x, y in geofence))


@pure
def no_limits(
    config: NoLimits, state: LimitsState, inputs: LimitsInputs, dt: float
) -> tuple[LimitsState, Reason]:
    """Never end a mission."""
    return state, NO_REASON


@pure
def limits(
    config: MissionLimits, state: LimitsState, inputs: LimitsInputs, dt: float
) -> tuple[LimitsState, Reason]:
    """Return the reason why a mission must end, or `NO_REASON`. Constant in time."""
    c = config.values
    elapsed, has_been_near, most_to_go, has_followed, places, along, has_been_at_depth = state
    elapsed += dt
    reason = NO_REASON
    x, y, z, off_path, depth_error, altitude, to_go, holds, rests = inputs
    if rests:
        places, along = NO_MARKS, NO_MARKS
    if c.duration > 0.0 and elapsed > c.duration:
        reason = Reason(DURATION, elapsed, 0.0, c.duration)
    elif c.max_depth > 0.0 and z > c.max_depth:  # a vehicle may sink while it holds
        reason = Reason(MAX_DEPTH, z, 0.0, c.max_depth)
    elif c.min_altitude > 0.0 and altitude < c.min_altitude:
        reason = Reason(MIN_ALTITUDE, altitude, 0.0, c.min_altitude)
    elif not holds:
        is_near = off_path <= c.path_distance
        if c.path_distance > 0.0 and has_been_near and not is_near:
            reason = Reason(PATH_DISTANCE, off_path, 0.0, c.path_distance)
        elif len(config.geofence) > 0 and not inside(config.geofence, x, y):
            reason = Reason(GEOFENCE, x, y, 0.0)
        elif has_been_at_depth and abs(depth_error) > c.depth_error > 0.0:
            reason = Reason(DEPTH_ERROR, abs(depth_error), 0.0, c.depth_error)
        else:
            places, reason = _over_ground(c, places, x, y, dt)
            if c.path_speed > 0.0 and not rests:
                most_to_go = max(most_to_go, to_go)
                if has_followed and reason.cause == NO_REASON.cause:
                    along, reason = _along(c, along, to_go, dt)
                advanced = most_to_go - to_go >= c.path_speed * c.path_speed_window
                has_followed = has_followed or advanced
        has_been_near = has_been_near or (is_near and c.path_distance > 0.0)
        has_been_at_depth = has_been_at_depth or abs(depth_error) <= c.depth_error
    state = LimitsState(elapsed, has_been_near, most_to_go, has_followed, places, along, has_been_at_depth)
    return state, reason


@pure
def _over_ground(c: LimitsConfig, marks: Marks, x: float, y: float, dt: float) -> tuple[Marks, Reason]:
    """Judge the speed over ground."""
    if c.ground_speed > 0.0:
        marks, is_full = marked(marks, x, y, dt, c.ground_speed_window)
        if is_full:
            way, time = covered(marks), marks.times[-1] - marks.times[0]
            if way / time < c.ground_speed:
                return marks, Reason(GROUND_SPEED, way / time, time, c.ground_speed)
    return marks, NO_REASON


@pure
def _along(c: LimitsConfig, marks: Marks, to_go: float, dt: float) -> tuple[Marks, Reason]:
    """Judge the speed along the path."""
    marks, is_full = marked(marks, to_go, 0.0, dt, c.path_speed_window)
    if is_full:
        time = marks.times[-1] - marks.times[0]
        speed = (marks.xs[0] - marks.xs[-1]) / time
        if speed < c.path_speed:
            return marks, Reason(PATH_SPEED, speed, time, c.path_speed)
    return marks, NO_REASON


limits_step = dispatched({NoLimits: no_limits, MissionLimits: limits})


@pure
def inside(polygon: Any, x: float, y: float) -> bool:
    """Return whether a point is in a polygon (corners in order, implicitly closed): even-odd rule."""
    result = False
    bx, by = polygon[len(polygon) - 1][0], polygon[len(polygon) - 1][1]
    for k in range(len(polygon)):
        ax, ay = polygon[k][0], polygon[k][1]
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            result = not result
        bx, by = ax, ay
    return result
