"""Progress of a mission: along an approach to the path's start, then from subpath to subpath."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Current, Navigation
from auv_path_following.curves.dubins import PlanarPose
from auv_path_following.curves.rows import AFTER, LENGTH, SPEED, PathRows, evaluate
from auv_path_following.guidance.approach import NEAR, plan
from auv_path_following.guidance.rejoin import closest_ahead
from auv_path_following.guidance.switching import Circles, reached
from auv_path_following.guidance.virtual_point import VirtualPoint, advanced, moved, passed_on


class ProgressConfig(NamedTuple):
    """Configuration of P's motion.

    Attributes:
        circles: of acceptance.
        approaches: whether a vehicle away from the path's start flies there first.
        approach_radius: of an approach's turns, m.
        rejoin_reach: largest advance of P after a hold, m.
        begins_at: path parameter s at which a mission begins, Eq. (1), in [0, n).
    """

    circles: Circles
    approaches: bool
    approach_radius: float
    rejoin_reach: float
    begins_at: float


class Progress(NamedTuple):
    """State of P on the mission.

    A mission begins at one place of the path; a vehicle that is elsewhere first follows P on a Dubins path
    there. The circle of acceptance at the end of a subpath counts only once the vehicle has been within
    `NEAR` of P.

    Attributes:
        point: P: on the approach while there is one, then on the path.
        legs: number of the approach's subpaths; 0: P is on the path.
        approach: the approach's rows; `move` writes a new approach into them.
        planned: whether the approach was planned (or found unnecessary) and not lost since.
        joined: whether the vehicle has been near P on this subpath.
        x, y: position of the vehicle at the last step, NED, m.
    """

    point: VirtualPoint
    legs: int
    approach: Any
    planned: bool
    joined: bool
    x: float
    y: float


@pure
def beginning(config: ProgressConfig) -> tuple[int, float]:
    """Return the subpath on which a mission begins, and t on it."""
    i = int(config.begins_at)
    return i, config.begins_at - i


@pure
def first_progress(config: ProgressConfig, approach: Any) -> Progress:
    """Return the beginning of a mission; `approach` as of `approach.empty_approach`."""
    i, t = beginning(config)
    return Progress(VirtualPoint(i, t, 0.0, 0.0, False), 0, approach, False, False, 0.0, 0.0)


@pure
def followed(path: PathRows, legs: int, approach: Any) -> PathRows:
    """Return the rows that P is on: of the approach, or of the path."""
    return PathRows(legs, approach, path.piece) if legs > 0 else path


@pure
def approach_to_go(legs: int, approach: Any, i: int, t: float) -> float:
    """Return the remaining length of an approach, m; 0 without one."""
    if legs == 0:
        return 0.0
    row = approach[i]
    left: float = row[LENGTH] * (1.0 - t) + row[AFTER]
    return left


@pure
def move(
    config: ProgressConfig, path: PathRows, state: Progress, navigation: Navigation, Ur: float,
    current: Current, dt: float, z: float = 0.0,
) -> tuple[int, float, bool, int, bool, bool]:  # fmt: skip
    """Move P for `dt` seconds; on the path never past what the vehicle has not passed.

    Args:
        config, path, state: of the mission.
        navigation: measured pose, NED.
        Ur: speed through the water, m/s.
        current: the observer's estimate, m/s, NED.
        dt: seconds since the last step.
        z: the vehicle's depth, m; 0 on a planar path.

    Returns:
        P's subpath, t on it and whether the path has ended; number of the approach's subpaths; whether the
        vehicle has joined the subpath; whether P has reached another subpath of the path, or its end.
    """
    P, legs, approach, planned, joined, _, _ = state
    i, t, _, _, finished = P
    beyond = 0.0
    if planned:
        i, t, finished, beyond = moved(followed(path, legs, approach), P, dt)
    if not planned or (legs > 0 and finished):
        before, legs = legs, _plan(config, path, approach, navigation)
        if legs > 0:
            i, t, finished = 0, 0.0, False
        elif before > 0:
            i, t, finished = _begun(config, path, beyond)
        return i, t, finished, legs, joined, False
    if legs > 0:
        return i, t, finished, legs, joined, False
    switched = i != P.i or finished != P.finished
    x, y, _, _ = navigation
    if joined and not finished and reached(config.circles, path.subpath[i], x, y, t, Ur, current, z):
        i, t, finished, _ = passed_on(path, i, 0.0)
        switched = True
    return i, t, finished, 0, joined and not switched, switched


@pure
def _begun(config: ProgressConfig, path: PathRows, length: float) -> tuple[int, float, bool]:
    """Return P `length` metres after the mission's beginning: subpath, t, and whether the path has ended."""
    i, t = beginning(config)
    i, t, finished, _ = advanced(path, i, t * path.subpath[i][SPEED] + length)
    return i, t, finished


@pure
def _plan(config: ProgressConfig, path: PathRows, approach: Any, navigation: Navigation) -> int:
    """Plan the approach from here; return its number of subpaths, 0 where the mission begins."""
    if not config.approaches:
        return 0
    i, t = beginning(config)
    x, y, dx, dy, _, _ = evaluate(path, path.subpath[i], t)
    return plan(approach, PlanarPose(x, y, math.atan2(dy, dx)), navigation, config.approach_radius)


@pure
def settled(
    config: ProgressConfig, P: VirtualPoint, legs: int, approach: Any, joined: bool, off: float,
    navigation: Navigation,
) -> Progress:  # fmt: skip
    """Return the state after a step.

    The distance to P, `off` (m), decides whether the vehicle has joined the subpath or lost the approach.
    """
    x, y, _, _ = navigation
    if legs == 0:
        return Progress(P, legs, approach, True, joined or off <= NEAR, x, y)
    return Progress(P, legs, approach, off <= config.approach_radius, joined, x, y)


@pure
def rejoined(config: ProgressConfig, path: PathRows, state: Progress, navigation: Navigation) -> Progress:
    """Return the state after a hold: P at the closest point of the path ahead.

    The search reaches ahead 1.5 times the distance that the vehicle was carried, for the path's turns, and
    never behind, so that a neighbouring leg is not taken for this one. An approach is planned again instead.
    """
    P, legs, approach, planned, joined, x, y = state
    if legs > 0 or not planned:
        return Progress(P, legs, approach, False, joined, x, y)
    carried = math.hypot(navigation.x - x, navigation.y - y)
    reach = min(1.5 * carried + 1.0, config.rejoin_reach)
    i, t = P.i, P.t
    if not P.finished:
        i, t = closest_ahead(path, i, t, navigation.x, navigation.y, reach)
    return Progress(VirtualPoint(i, t, 0.0, 0.0, P.finished), 0, approach, True, joined and i == P.i, x, y)
