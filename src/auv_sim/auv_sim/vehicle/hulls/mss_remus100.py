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
from auv_sim.vehicle.hulls.mss_cross_flow import cross_flow, cylinder_drag
from auv_sim.vehicle.hulls.mss_particulars import DIAMETER, IX, IY, LENGTH, MASS, RHO, WEIGHT, ZG, A, B
from auv_sim.vehicle.hulls.mss_propeller import propeller_loads, revolutions_for
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

#: Lift and drag of the body.
_AREA = 0.7 * LENGTH * DIAMETER
_ASPECT = DIAMETER * DIAMETER / _AREA
_LIFT = math.pi * _ASPECT / (1.0 + math.sqrt(1.0 + (0.5 * _ASPECT) ** 2))
_DRAG = 0.42 * math.pi * B * B / _AREA
#: Fins: area of a pair, m^2, and slopes of their lift.
_FIN_AREA, _RUDDER_LIFT, _PLANE_LIFT = 2.0 * 0.00665, 0.5, 0.7


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
