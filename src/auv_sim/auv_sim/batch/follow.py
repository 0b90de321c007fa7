"""`PathFollower.update` as a function from a state to the next one."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.types import Current, Navigation, WaterVelocity
from auv_path_following.guidance.acceptance import Corner
from auv_path_following.guidance.approach import NEAR
from auv_path_following.guidance.law import LawInputs
from auv_path_following.guidance.laws import law_step
from auv_path_following.guidance.path_follower import LONGEST_STEP
from auv_path_following.paths.rows import (
    CHI_IN,
    CHI_OUT,
    CORNER,
    END,
    JOINT,
    JOINT_X,
    JOINT_Y,
    LENGTH,
    STRETCH,
    WIDEST,
    PathRows,
    evaluate,
)
from auv_path_following.paths.segment import PathPoint
from auv_sim.batch.compiled import compiled
from auv_sim.batch.numbers import Guidance
from auv_sim.batch.shared import (
    acceptance_radius,
    is_at,
    path_errors,
    saturated,
    tangential_speed,
)


class FollowerState(NamedTuple):
    """Of `PathFollower`, its `VirtualPoint` and its law.

    Attributes:
        approaching: P is on the approach, not on the path; i and t are of the approach then.
        lost: the vehicle needs another approach, which compiled code does not plan.
        joined: the vehicle has been near P on this subpath.
        i, t: subpath (from 0) and place on it.
        t_rate, metres_per_t: P's speed in t, and the path's there.
        finished: the path has ended.
        law: of the guidance law.
    """

    approaching: bool
    lost: bool
    joined: bool
    i: int
    t: float
    t_rate: float
    metres_per_t: float
    finished: bool
    law: Any


class Guided(NamedTuple):
    """What one step of guidance says, as in `GuidanceOutput`."""

    psi_d: float
    r_d: float
    xe: float
    ye: float


@compiled
def first_state(c: Guidance, approaches: bool) -> FollowerState:
    """As after `PathFollower.reset`, the approach being planned."""
    return FollowerState(approaches, False, False, 0, 0.0, 0.0, 0.0, False, c.law_begins)


@compiled
def follow(
    c: Guidance,
    approach: PathRows,
    curve: PathRows,
    state: FollowerState,
    navigation: Navigation,
    water: WaterVelocity,
    current: Current,
    dt: float,
) -> tuple[FollowerState, Guided]:
    """One step of guidance: `PathFollower.update`."""
    dt = min(dt, LONGEST_STEP)
    if not c.compensate_current:
        current = Current(0.0, 0.0)
    Ur = math.hypot(water.ur, water.vr)
    moved = _moved(c, approach, curve, state, navigation, Ur, current, dt)
    approaching, lost, joined, i, t, finished = moved
    along = approach if approaching else curve
    x, y, dx, dy, ddx, ddy = evaluate(along, along.subpath[i], t)
    point = PathPoint(x, y, dx, dy, ddx, ddy)
    chi_p = math.atan2(point.dy, point.dx)
    xe, ye = path_errors(navigation, point, chi_p)
    off = math.hypot(xe, ye)
    lost = lost or (approaching and off > c.approach_radius)
    joined = joined or (not approaching and off <= NEAR)

    beta_r = math.atan2(water.vr, water.ur)
    if Ur < c.minimum_speed:
        Ur = beta_r = 0.0
    law, out = law_step(c.law, state.law, LawInputs(ye, chi_p, Ur, beta_r, current), dt)
    psi_d = out.psi_d

    U_P = tangential_speed(c.k, saturated(xe, c.saturation), navigation.psi, water, chi_p, current)
    speed = math.hypot(point.dx, point.dy)
    t_rate = U_P / speed
    if finished or (t <= 0.0 and U_P < 0.0):
        t_rate = U_P = speed = 0.0
    after = FollowerState(approaching, lost, joined, i, t, t_rate, speed, finished, law)
    if finished:
        return after, Guided(navigation.psi, 0.0, xe, ye)
    squared = point.dx * point.dx + point.dy * point.dy
    kappa = (point.dx * point.ddy - point.dy * point.ddx) / (squared * math.sqrt(squared))
    r_d = min(max(kappa * U_P, -c.turn_rate), c.turn_rate)
    return after, Guided(wrap(psi_d), r_d, xe, ye)


@compiled
def _moved(
    c: Guidance,
    approach: PathRows,
    curve: PathRows,
    state: FollowerState,
    navigation: Navigation,
    Ur: float,
    current: Current,
    dt: float,
) -> tuple[bool, bool, bool, int, float, bool]:
    """`Progress.move`: whether approaching, lost and joined; subpath, t on it, whether the path ended."""
    along = approach if state.approaching else curve
    t = max(state.t + state.t_rate * dt, 0.0)
    if t < 1.0 or state.finished:
        i, finished, beyond = state.i, state.finished, 0.0
    else:
        i, t, finished, beyond = _next(along, state.i, (t - 1.0) * state.metres_per_t)
    if state.approaching:
        if not finished:
            return True, False, False, i, t, False
        start = evaluate(curve, curve.subpath[0], 0.0)
        x, y, psi, _ = navigation
        if not is_at(x, y, psi, start[0], start[1], math.atan2(start[3], start[2])):
            return True, True, False, i, t, False
        i, t, finished, _ = _onwards(curve, 0, beyond)
        return False, False, False, i, t, finished
    joined = state.joined and i == state.i
    if not finished and state.joined and _reached(c, curve, navigation, i, t, Ur, current):
        i, t, finished, _ = _next(curve, i, 0.0)
        joined = False
    return False, False, joined, i, t, finished


@compiled
def _onwards(curve: PathRows, i: int, way: float) -> tuple[int, float, bool, float]:
    """`VirtualPoint.advance`: subpath, t, whether the path ended, and how many metres beyond."""
    while True:
        start = evaluate(curve, curve.subpath[i], 0.0)
        t = way / math.hypot(start[2], start[3])
        if t < 1.0:
            return i, t, False, 0.0
        way = max(way - curve.subpath[i][LENGTH], 0.0)
        if i + 1 >= curve.n:
            return i, 1.0, True, way
        i += 1


@compiled
def _next(curve: PathRows, i: int, way: float) -> tuple[int, float, bool, float]:
    """`VirtualPoint.go_on`, and on by `way` metres: as `_onwards`."""
    if i + 1 >= curve.n:
        return i, 1.0, True, way
    return _onwards(curve, i + 1, way)


@compiled
def _reached(
    c: Guidance, curve: PathRows, navigation: Navigation, i: int, t: float, Ur: float, current: Current
) -> bool:
    """`CircleOfAcceptance.reached`."""
    row: Any = curve.subpath[i]
    if c.switching == 0 or row[JOINT] == END:
        return False
    if (c.switching == 1 and row[JOINT] != CORNER) or t < max(row[STRETCH], 0.5):
        return False
    radius = c.radius
    if not radius > 0.0 and row[JOINT] == CORNER:
        corner = Corner(row[CHI_IN], row[CHI_OUT], row[WIDEST])
        radius = acceptance_radius(c.cornering, corner, c.lookahead, Ur, current)
    return math.hypot(row[JOINT_X] - navigation.x, row[JOINT_Y] - navigation.y) <= radius
