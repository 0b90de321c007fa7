"""The REMUS 100 of Fossen's Marine Systems Simulator (MSS) in six degrees of freedom.

Another hull than Prestero's: spheroid added mass, linear damping, lift and drag of the body, cross-flow drag
by strips, a propeller by open-water data. The signs of the fins are those of this suite: a positive rudder
turns to port, positive planes put the bow down. The published model is kept with its peculiarities, which
comments name. The propeller takes a thrust in N, as that of every other hull does, and turns as fast as gives
it: a command means the same on all hulls, and the roll moment is that of the revolutions.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.hulls.remus_6dof import BodyInputs
from auv_sim.vehicle.hulls.rigid_body import (
    Accelerations,
    BodyState,
    Loads,
    Vector,
    advanced,
    after_runge_kutta,
    body_slope,
    to_body,
)

LENGTH, DIAMETER = 1.6, 0.19  # m
#: Densities of the water in the published model: for body and strips; for added mass, lift and fins.
RHO_BODY, RHO = 1025.0, 1026.0
#: Semi-axes of the spheroid, m; it is a little larger than the hull.
A, B = 1.0096 * LENGTH / 2.0, 1.0096 * DIAMETER / 2.0
ZG = 0.02  # m, centre of gravity below the centre of buoyancy
_SINE = math.sin(math.radians(63.446827)) ** 2
GRAVITY = 9.7803253359 * (1.0 + 0.00193185265241 * _SINE) / math.sqrt(1.0 - 0.00669437999013 * _SINE)
MASS = 4.0 / 3.0 * math.pi * RHO_BODY * A * B * B
WEIGHT = MASS * GRAVITY
IX, IY = 0.4 * MASS * B * B, 0.2 * MASS * (A * A + B * B)  # kg m^2, about the centre of gravity
#: Lift and drag of the body.
_AREA = 0.7 * LENGTH * DIAMETER
_ASPECT = DIAMETER * DIAMETER / _AREA
_LIFT = math.pi * _ASPECT / (1.0 + math.sqrt(1.0 + (0.5 * _ASPECT) ** 2))
_DRAG = 0.42 * math.pi * B * B / _AREA
#: Fins: area of a pair, m^2, and slopes of their lift.
_FIN_AREA, _RUDDER_LIFT, _PLANE_LIFT = 2.0 * 0.00665, 0.5, 0.7
PROPELLER = 0.14  # m, diameter
#: Strips of the cross-flow drag: their number and their width, m.
STRIPS, _WIDTH = 21, LENGTH / 20.0
#: Reduction of the drag for the finite length, below and above the critical Reynolds number (DNV-RP-C205):
#: linear in length over diameter between 5 and 10.
_FINITE_SLOW = 0.62 + 0.06 * (LENGTH / DIAMETER - 5.0) / 5.0
_FINITE_FAST = 0.80 + 0.02 * (LENGTH / DIAMETER - 5.0) / 5.0
#: Drag of a smooth cylinder over the Reynolds number (thousands), as DNV-RP-C205 has it.
_REYNOLDS = (
    10.2110, 15.5435, 24.4349, 35.7199, 60.8808, 86.1747, 118.0864, 149.2623,
    214.7089, 230.9404, 271.5814, 297.0982, 325.2520, 361.9428, 409.7982, 475.3024,
    524.7350, 578.9219, 638.2929, 744.0464, 853.2376, 1068.6857, 1393.3814, 1831.8504,
)  # fmt: skip
_CYLINDER = (
    1.20769, 1.20369, 1.20823, 1.21060, 1.21093, 1.20901, 1.21134, 1.21148,
    1.21171, 1.20109, 1.16918, 1.11163, 1.00926, 0.89411, 0.70855, 0.53155,
    0.40785, 0.32683, 0.28422, 0.29711, 0.32280, 0.38909, 0.47033, 0.53878,
)  # fmt: skip


class MssRemus100(NamedTuple):
    """Configuration of the hull: the added mass of a spheroid.

    Attributes:
        added_surge, added_sway: kg; heave has the same as sway.
        added_roll, added_pitch: kg m^2; yaw has the same as pitch.
    """

    added_surge: float
    added_sway: float
    added_roll: float
    added_pitch: float


def mss_remus100() -> MssRemus100:
    """Return the hull, with the added mass of a spheroid by Imlay (1961)."""
    mass = 4.0 / 3.0 * math.pi * RHO * A * B * B
    squared = 1.0 - (B / A) ** 2  # of the eccentricity
    e = math.sqrt(squared)
    logarithm = math.log((1.0 + e) / (1.0 - e))
    alpha = 2.0 * (1.0 - squared) / e**3 * (0.5 * logarithm - e)
    beta = 1.0 / squared - (1.0 - squared) * logarithm / (2.0 * e**3)
    turning = (
        squared**2 * (beta - alpha) / ((2.0 - squared) * (2.0 * squared - (2.0 - squared) * (beta - alpha)))
    )
    return MssRemus100(
        mass * alpha / (2.0 - alpha),
        mass * beta / (2.0 - beta),
        0.3 * 0.4 * mass * B * B,
        turning * 0.2 * mass * (A * A + B * B),
    )


@pure
def cylinder_drag(speed: float) -> float:
    """Return the drag coefficient of the hull across the flow.

    Args:
        speed: across the hull, m/s.
    """
    reynolds = speed * LENGTH / 1.0e-6
    finite_length = _FINITE_SLOW if reynolds < 2.0e5 else _FINITE_FAST
    thousands = 1.0e-3 * reynolds
    if thousands <= _REYNOLDS[0]:
        return finite_length * _CYLINDER[0]
    for k in range(1, len(_REYNOLDS)):
        if thousands < _REYNOLDS[k]:
            share = (thousands - _REYNOLDS[k - 1]) / (_REYNOLDS[k] - _REYNOLDS[k - 1])
            return finite_length * (_CYLINDER[k - 1] + share * (_CYLINDER[k] - _CYLINDER[k - 1]))
    return finite_length * _CYLINDER[-1]


@pure
def cross_flow(velocity: float, rate: float, coefficient: float) -> tuple[float, float]:
    """Return force (N) and moment (N m) of the drag across the hull, strip by strip.

    Args:
        velocity: across the hull, m/s: vr or wr.
        rate: r or q, rad/s, that adds x times itself (the published model has +x q in heave, too).
        coefficient: of the drag.
    """
    scale = -0.5 * RHO_BODY * DIAMETER * coefficient * _WIDTH
    force = moment = 0.0
    for k in range(STRIPS):
        x = -0.5 * LENGTH + k * _WIDTH
        flow = velocity + x * rate
        strip = scale * abs(flow) * flow
        force += strip
        moment += x * strip
    return force, moment


@pure
def propeller_loads(revolutions: float, speed: float) -> tuple[float, float]:
    """Return thrust (N) and roll moment (N m), as the published model scales them.

    Args:
        revolutions: 1/s, ahead.
        speed: over ground, m/s; 0.944 of it arrives at the propeller.
    """
    advance = 0.944 * speed / PROPELLER
    n = abs(revolutions)
    thrust = RHO * PROPELLER**4 * (0.4566 * n * revolutions + (0.1798 - 0.4566) / 0.6632 * advance * n)
    moment = RHO * PROPELLER**5 * (0.0700 * n * revolutions + (0.0312 - 0.0700) / 0.6632 * advance * n)
    return 0.9 * thrust, moment / 10.0


@pure
def revolutions_for(thrust: float, speed: float) -> float:
    """Return the revolutions, 1/s, that give a thrust (N, at least 0) at a speed over ground (m/s)."""
    square = 0.9 * RHO * PROPELLER**4 * 0.4566
    linear = 0.9 * RHO * PROPELLER**3 * (0.1798 - 0.4566) / 0.6632 * 0.944 * speed
    return (-linear + math.sqrt(linear * linear + 4.0 * square * max(thrust, 0.0))) / (2.0 * square)


@pure
def inertial_loads(hull: MssRemus100, state: BodyState) -> Loads:
    """Return what the Coriolis terms of rigid body and added mass take from the equations of motion."""
    u, v, w, p, q, r = state.ur, state.vr, state.wr, state.p, state.q, state.r
    # The rigid body about its centre of gravity: m omega x v_g, moved to the origin.
    gu, gv = u + q * ZG, v - p * ZG
    fx, fy, fz = MASS * (q * w - r * gv), MASS * (r * gu - p * w), MASS * (p * gv - q * gu)
    # Added mass. The published model leaves out its Munk moments in pitch and yaw.
    sway, heave = hull.added_sway * v, hull.added_sway * w
    roll, pitch, yaw = hull.added_roll * p, hull.added_pitch * q, hull.added_pitch * r
    return (
        -fx,
        -fy + heave * p,
        -fz - sway * p,
        ZG * fy - (heave * v - sway * w + yaw * q - pitch * r),
        -ZG * fx - (IX - IY) * r * p + yaw * p - roll * r,
        -(IY - IX) * p * q - pitch * p + roll * q,
    )


@pure
def damping_loads(hull: MssRemus100, state: BodyState, ground: Vector) -> Loads:
    """Return the linear damping and the moments of the weight; the hull is neutrally buoyant.

    In surge the published model has sqrt(u + v^2) for the speed over ground; it is kept.
    """
    down_x, down_y, _ = to_body(state.qw, state.qi, state.qj, state.qk, 0.0, 0.0, 1.0)
    sway_mass = MASS + hull.added_sway
    roll_mass = IX + MASS * ZG * ZG + hull.added_roll
    pitch_mass = IY + MASS * ZG * ZG + hull.added_pitch
    speed = math.sqrt(max(ground[0] + ground[1] * ground[1], 0.0))
    return (
        -(MASS + hull.added_surge) / 20.0 * math.exp(-3.0 * speed) * state.ur,
        -sway_mass / 20.0 * state.vr,
        -sway_mass / 20.0 * state.wr,
        -roll_mass * 2.0 * 0.3 * math.sqrt(WEIGHT * ZG / roll_mass) * state.p - ZG * WEIGHT * down_y,
        -pitch_mass * 2.0 * 0.8 * math.sqrt(WEIGHT * ZG / pitch_mass) * state.q + ZG * WEIGHT * down_x,
        -(IY + hull.added_pitch) * state.r,
    )


@pure
def flow_loads(state: BodyState) -> Loads:
    """Return lift and drag of the body in its vertical plane, and the drag of the flow across it."""
    u, v, w = state.ur, state.vr, state.wr
    alpha = math.atan2(w, u)
    dynamic = 0.5 * RHO * (u * u + v * v + w * w) * _AREA
    lift = dynamic * _LIFT * alpha
    drag = dynamic * (_DRAG + (_LIFT * alpha) ** 2 / (0.3 * math.pi * _ASPECT))
    coefficient = cylinder_drag(math.sqrt(v * v + w * w))
    side, turn = cross_flow(v, state.r, coefficient)
    up, tip = cross_flow(w, state.q, coefficient)
    X = lift * math.sin(alpha) - drag * math.cos(alpha)
    return X, side, up - drag * math.sin(alpha) - lift * math.cos(alpha), 0.0, tip, turn


@pure
def fin_loads(state: BodyState, rudder: float, planes: float) -> Loads:
    """Return what the fins at the stern give; positive planes put the bow down."""
    u, v, w = state.ur, state.vr, state.wr
    flow = 0.5 * RHO * _FIN_AREA
    side = flow * (u * u + v * v) * _RUDDER_LIFT * rudder
    up = -flow * (u * u + w * w) * _PLANE_LIFT * planes
    return -side * rudder + up * planes, side, up, 0.0, A * up, -A * side


@pure
def mss_accelerations(
    hull: MssRemus100,
    state: BodyState,
    rudder: float,
    planes: float,
    revolutions: float,
    ground: Vector,
) -> Accelerations:
    """Return the rates of (ur, vr, wr, p, q, r).

    Args:
        hull: its added mass.
        state: with velocities through the water.
        rudder: rad, positive to port.
        planes: rad, positive bow down.
        revolutions: of the propeller, 1/s.
        ground: velocity over ground in body axes, m/s: damping ahead and propeller go by it.
    """
    X1, Y1, Z1, K1, M1, N1 = inertial_loads(hull, state)
    X2, Y2, Z2, K2, M2, N2 = damping_loads(hull, state, ground)
    X3, Y3, Z3, _, M3, N3 = flow_loads(state)
    X4, Y4, Z4, _, M4, N4 = fin_loads(state, rudder, planes)
    gx, gy, gz = ground
    thrust, torque = propeller_loads(revolutions, math.sqrt(gx * gx + gy * gy + gz * gz))
    X, Y, K, M = X1 + X2 + X3 + X4 + thrust, Y1 + Y2 + Y3 + Y4, K1 + K2 + torque, M1 + M2 + M3 + M4
    # The mass matrix couples surge with pitch and sway with roll, by m zg.
    arm, surge_mass, sway_mass = MASS * ZG, MASS + hull.added_surge, MASS + hull.added_sway
    roll_mass = IX + MASS * ZG * ZG + hull.added_roll
    pitch_mass = IY + MASS * ZG * ZG + hull.added_pitch
    across, along = surge_mass * pitch_mass - arm * arm, sway_mass * roll_mass - arm * arm
    return (
        (pitch_mass * X - arm * M) / across,
        (roll_mass * Y + arm * K) / along,
        (Z1 + Z2 + Z3 + Z4) / sway_mass,
        (sway_mass * K + arm * Y) / along,
        (surge_mass * M - arm * X) / across,
        (N1 + N2 + N3 + N4) / (IY + hull.added_pitch),
    )


@pure
def mss_slope(
    hull: MssRemus100,
    state: BodyState,
    rudder: float,
    planes: float,
    thrust: float,
    current: Vector,
) -> BodyState:
    """Return the rates of the state; the propeller turns as fast as the thrust demands."""
    x, y, z = to_body(state.qw, state.qi, state.qj, state.qk, current[0], current[1], current[2])
    ground = (state.ur + x, state.vr + y, state.wr + z)
    speed = math.sqrt(ground[0] * ground[0] + ground[1] * ground[1] + ground[2] * ground[2])
    revolutions = revolutions_for(thrust, speed)
    return body_slope(state, mss_accelerations(hull, state, rudder, planes, revolutions, ground), current)


@pure
def mss_remus100_step(
    config: MssRemus100, state: BodyState, inputs: BodyInputs, dt: float
) -> tuple[BodyState, BodyState]:
    """One Runge-Kutta step; the output is the state."""
    rudder, planes, thrust, current = inputs
    half = 0.5 * dt
    k1 = mss_slope(config, state, rudder[0], planes[0], thrust, current)
    k2 = mss_slope(config, advanced(state, k1, half), rudder[1], planes[1], thrust, current)
    k3 = mss_slope(config, advanced(state, k2, half), rudder[1], planes[1], thrust, current)
    k4 = mss_slope(config, advanced(state, k3, dt), rudder[2], planes[2], thrust, current)
    state = after_runge_kutta(state, k1, k2, k3, k4, dt)
    return state, state
