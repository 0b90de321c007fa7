"""The laws with a state, as functions from a state to the next one.

The same formulas in the same order as in the classes named; a test holds both together over whole missions.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.types import Current, Navigation, WaterVelocity
from auv_path_following.control.controller import HeadingInputs
from auv_sim.batch.compiled import compiled
from auv_sim.batch.numbers import Autopilot, Observer, Plant
from auv_sim.batch.shared import accelerations, approach, derivative, moved, rudder_gain, rudder_rate
from auv_sim.plant.remus import PlantState

_LONGEST_SWAY_STEP = 0.05


class ObserverState(NamedTuple):
    """Of `CurrentObserver`: whether it has seen a measurement, the last one, errors and estimate."""

    seen: bool
    x: float
    y: float
    wx: float
    wy: float
    ex: float
    ey: float
    Vx: float
    Vy: float


@compiled
def observe(
    c: Observer, state: ObserverState, navigation: Navigation, water: WaterVelocity, dt: float
) -> ObserverState:
    """`CurrentObserver.update`."""
    x, y = navigation.x, navigation.y
    cos_psi, sin_psi = math.cos(navigation.psi), math.sin(navigation.psi)
    wx = cos_psi * water.ur - sin_psi * water.vr
    wy = sin_psi * water.ur + cos_psi * water.vr
    if not (state.seen and dt > 0.0):
        return ObserverState(True, x, y, wx, wy, state.ex, state.ey, state.Vx, state.Vy)
    dx = (x - state.x) / dt - 0.5 * (wx + state.wx)
    dy = (y - state.y) / dt - 0.5 * (wy + state.wy)
    gap_x, gap_y = state.Vx - dx, state.Vy - dy
    return ObserverState(
        True,
        x,
        y,
        wx,
        wy,
        c.f11 * state.ex + c.f12 * gap_x,
        c.f11 * state.ey + c.f12 * gap_y,
        dx + c.f21 * state.ex + c.f22 * gap_x,
        dy + c.f21 * state.ey + c.f22 * gap_y,
    )


class AutopilotState(NamedTuple):
    """Of `HeadingAutopilot`, its reference model and its controller, whichever that is.

    begun: whether there was an update; r, r_d: its rates; lag, r_dot: the filter behind dr/dt; angle,
    turning, acceleration: the shaped reference; rudder: what was commanded last; integral: PID's; vr: SMC's
    sway.
    """

    begun: bool
    r: float
    r_d: float
    lag: float
    r_dot: float
    angle: float
    turning: float
    acceleration: float
    rudder: float
    integral: float
    vr: float


@compiled
def steer(
    c: Autopilot, state: AutopilotState, navigation: Navigation, psi_d: float, r_d: float, dt: float
) -> AutopilotState:
    """`HeadingAutopilot.update` while a mission runs; the new state holds the rudder."""
    r = navigation.r
    psi_e = wrap(navigation.psi - psi_d)
    lag, r_dot, r_d_dot = state.lag, state.r_dot, 0.0
    if not state.begun:
        dt = 0.0
    elif dt > 0.0:
        lag, r_dot = _derivative(c.bandwidth, lag, r_dot, (r - state.r) / dt, dt)
        r_d_dot = (r_d - state.r_d) / dt
    error, wanted_r, wanted_r_dot = psi_e, r_d, r_d_dot
    angle, turning, acceleration = state.angle, state.turning, state.acceleration
    if c.shaped:
        angle, turning, acceleration = _shape(c, state, navigation, psi_d, r_d, dt)
        error, wanted_r, wanted_r_dot = wrap(navigation.psi - angle), turning, acceleration
    inputs = HeadingInputs(error, r, r_dot, wanted_r, wanted_r_dot, 0.0)
    rudder, integral, vr = state.rudder, state.integral, state.vr
    if c.controller == 0:
        rate = rudder_rate(c.nism, inputs)[0]
        rudder = min(max(rudder + rate * dt, -c.max_angle), c.max_angle)
    elif c.controller == 1:
        rudder, integral = _pid(c, rudder, integral, inputs, dt)
    else:
        rudder, vr = _smc(c, rudder, vr, inputs, dt)
    return AutopilotState(True, r, r_d, lag, r_dot, angle, turning, acceleration, rudder, integral, vr)


@compiled
def _derivative(w: float, lag: float, rate: float, slope: float, dt: float) -> tuple[float, float]:
    """`Derivative.update`: its lag and dr/dt."""
    if not w > 0.0:
        return 0.0, slope
    decay = math.exp(-w * dt)
    e, e_rate = lag - 2.0 * slope / w, slope - rate
    rise = (e_rate + w * e) * dt
    return 2.0 * slope / w + (e + rise) * decay, slope - (e_rate - w * rise) * decay


@compiled
def _shape(
    c: Autopilot, state: AutopilotState, navigation: Navigation, psi_d: float, r_d: float, dt: float
) -> tuple[float, float, float]:
    """`ReferenceModel.update`: angle, rate and acceleration of the shaped reference."""
    rate, largest, jerk = c.limits
    angle, turning, held = state.angle, state.turning, state.acceleration
    if state.begun:
        angle, turning = angle + turning * dt + 0.5 * held * dt * dt, turning + held * dt
    else:
        angle, turning = navigation.psi, navigation.r
    g = c.reference.config
    wanted = min(max(r_d + approach(c.reference, wrap(psi_d - angle), largest), -rate), rate)
    pull = 4.0 * g.damping**2 * g.bandwidth * (wanted - turning)
    pull = min(max(pull, -largest), largest)
    change = jerk * dt
    return wrap(angle), turning, held + min(max(pull - held, -change), change)


@compiled
def _limited(c: Autopilot, angle: float, wanted: float, dt: float) -> float:
    """`RudderLimiter.limit`."""
    reach = c.max_rate * dt
    wanted = min(max(wanted, -c.max_angle), c.max_angle)
    return angle + min(max(wanted - angle, -reach), reach)


@compiled
def _pid(
    c: Autopilot, angle: float, integral: float, inputs: HeadingInputs, dt: float
) -> tuple[float, float]:
    """`Pid.update`: rudder and integral."""
    g = c.pid
    error = min(max(inputs.psi_e, -g.largest_error), g.largest_error)
    integral += g.ki * error * dt
    wanted = g.kp * error + integral + g.kd * (inputs.r - inputs.r_d)
    rudder = _limited(c, angle, wanted, dt)
    if g.ki > 0.0 and dt > 0.0:
        integral += (rudder - wanted) * min(dt / max(g.kd / g.kp, dt), 1.0)
    return rudder, integral


@compiled
def _smc(c: Autopilot, angle: float, vr: float, inputs: HeadingInputs, dt: float) -> tuple[float, float]:
    """`Smc.update`: rudder and sway."""
    g, ur = c.smc, c.model.cruise
    if ur <= 0.0:
        return _limited(c, angle, 0.0, dt), vr
    sway_push, turn = rudder_gain(c.model, ur)
    substeps = max(1, math.ceil(dt / _LONGEST_SWAY_STEP - 1e-9))
    for _ in range(substeps):
        vr += (accelerations(c.model, ur, vr, inputs.r)[0] + sway_push * angle) * dt / substeps
    lean = g.slope * inputs.psi_e
    sigma = inputs.r - inputs.r_d + min(max(lean, -g.largest_rate), g.largest_rate)
    push = -g.gain * min(max(sigma / g.boundary, -1.0), 1.0)
    slope = g.slope if abs(lean) < g.largest_rate else 0.0
    wanted = inputs.r_d_dot - slope * (inputs.r - inputs.r_d)
    equivalent = (wanted - accelerations(c.model, ur, vr, inputs.r)[1]) / turn
    return _limited(c, angle, equivalent + push / turn, dt), vr


@compiled
def advance(
    c: Plant, state: PlantState, rudder: float, command: float, thrust: float, dt: float, current: Current
) -> tuple[PlantState, float]:
    """`RemusPlant.advance` with its `RudderServo`: the state and the rudder's angle after `dt` seconds."""
    target = min(max(command, -c.max_angle), c.max_angle)
    substeps = max(1, math.ceil(dt / c.max_step - 1e-9))
    h = dt / substeps
    for _ in range(substeps):
        reach_half, reach = c.max_rate * (0.5 * h), c.max_rate * h
        half = rudder + min(max(target - rudder, -reach_half), reach_half)
        end = rudder + min(max(target - rudder, -reach), reach)
        k1 = derivative(c.dynamics, state, rudder, thrust, current)
        k2 = derivative(c.dynamics, moved(state, k1, 0.5 * h), half, thrust, current)
        k3 = derivative(c.dynamics, moved(state, k2, 0.5 * h), half, thrust, current)
        k4 = derivative(c.dynamics, moved(state, k3, h), end, thrust, current)
        state = PlantState(
            state.x + h / 6.0 * (k1[0] + 2.0 * (k2[0] + k3[0]) + k4[0]),
            state.y + h / 6.0 * (k1[1] + 2.0 * (k2[1] + k3[1]) + k4[1]),
            state.psi + h / 6.0 * (k1[2] + 2.0 * (k2[2] + k3[2]) + k4[2]),
            state.ur + h / 6.0 * (k1[3] + 2.0 * (k2[3] + k3[3]) + k4[3]),
            state.vr + h / 6.0 * (k1[4] + 2.0 * (k2[4] + k3[4]) + k4[4]),
            state.r + h / 6.0 * (k1[5] + 2.0 * (k2[5] + k3[5]) + k4[5]),
        )
        rudder = end
    return state, rudder
