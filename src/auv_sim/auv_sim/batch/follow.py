"""`PathFollower.update` as a function from a state to the next one."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.types import Current, Navigation, WaterVelocity
from auv_path_following.guidance.law import LawInputs
from auv_sim.batch.compiled import compiled
from auv_sim.batch.curve import CORNER, JOINT_X, JOINT_Y, STRETCH, Curve
from auv_sim.batch.numbers import Guidance
from auv_sim.batch.path_point import evaluate
from auv_sim.batch.shared import ailos_update, los_update, path_errors, tangential_speed, wrap


class FollowerState(NamedTuple):
    """Of `VirtualPoint` (subpath i, t on it, its rate, whether the path ended) and of ILOS (its integral)."""

    i: int
    t: float
    t_rate: float
    finished: bool
    integral: float


class Guided(NamedTuple):
    """What one step of guidance says, as in `GuidanceOutput`."""

    psi_d: float
    r_d: float
    xe: float
    ye: float


@compiled
def follow(
    c: Guidance,
    curve: Curve,
    state: FollowerState,
    navigation: Navigation,
    water: WaterVelocity,
    current: Current,
    dt: float,
) -> tuple[FollowerState, Guided]:
    """One step of guidance."""
    n = len(curve.subpath)
    i, t, finished = state.i, state.t, state.finished
    if not c.compensate_current:
        current = Current(0.0, 0.0)

    t += state.t_rate * dt  # VirtualPoint.move
    if t < 0.0:
        t = 0.0
    go_on = t >= 1.0 and not finished
    if go_on:
        i, t, finished = _next(n, i)
    if not finished and _reached(c, curve, navigation, i, t):
        i, t, finished = _next(n, i)
    point = evaluate(curve, i, t)
    chi_p = math.atan2(point.dy, point.dx)
    xe, ye = path_errors(navigation, point, chi_p)

    Ur = math.hypot(water.ur, water.vr)
    beta_r = math.atan2(water.vr, water.ur)
    if Ur < c.minimum_speed:
        Ur = beta_r = 0.0
    integral = state.integral
    inputs = LawInputs(ye, chi_p, Ur, beta_r, current)
    if c.law == 0:
        psi_d = ailos_update(c.ailos, inputs, dt).psi_d
    elif c.law == 1:
        psi_d, integral = _ilos(c, inputs, integral, dt)
    else:
        psi_d = los_update(c.los, inputs, dt).psi_d

    U_P = tangential_speed(c.k, xe, navigation.psi, water, chi_p, current)
    speed = math.hypot(point.dx, point.dy)
    t_rate = U_P / speed
    if finished or (t <= 0.0 and U_P < 0.0):
        t_rate = U_P = 0.0
    if finished:
        return FollowerState(i, t, t_rate, finished, integral), Guided(navigation.psi, 0.0, xe, ye)
    squared = point.dx * point.dx + point.dy * point.dy
    kappa = (point.dx * point.ddy - point.dy * point.ddx) / (squared * math.sqrt(squared))
    return FollowerState(i, t, t_rate, finished, integral), Guided(wrap(psi_d), kappa * U_P, xe, ye)


@compiled
def _next(n: int, i: int) -> tuple[int, float, bool]:
    """`VirtualPoint.go_on`: subpath, t, whether the path ended."""
    if i + 1 >= n:
        return i, 1.0, True
    return i + 1, 0.0, False


@compiled
def _reached(c: Guidance, curve: Curve, navigation: Navigation, i: int, t: float) -> bool:
    """`CircleOfAcceptance.reached`."""
    if c.switching == 0 or i + 1 >= len(curve.subpath):
        return False
    if c.switching == 1 and curve.subpath[i, CORNER] == 0.0:
        return False
    dx, dy = curve.subpath[i, JOINT_X] - navigation.x, curve.subpath[i, JOINT_Y] - navigation.y
    return math.hypot(dx, dy) <= c.radius and t >= curve.subpath[i, STRETCH]


@compiled
def _ilos(c: Guidance, inputs: LawInputs, integral: float, dt: float) -> tuple[float, float]:
    """`Ilos.update`: psi_d and the integral."""
    Delta, sigma = c.ilos.lookahead, c.ilos.sigma
    aim = inputs.ye + sigma * integral
    integral += dt * Delta * inputs.ye / (aim * aim + Delta * Delta)
    chi_r = math.atan(-(inputs.ye + sigma * integral) / Delta)
    beta_r = inputs.beta_r if c.ilos.sideslip else 0.0
    return inputs.chi_p + chi_r - beta_r, integral
