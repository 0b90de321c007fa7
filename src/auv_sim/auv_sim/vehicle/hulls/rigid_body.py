"""The motion of a rigid body in six degrees of freedom: attitude as a quaternion, Runge-Kutta, the surface.

Frames are NED and FRD: z is depth, a positive pitch is bow up. Linear velocities are through the water.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.attitude import angles_of_quaternion, quaternion_of
from auv_msgs_py.values.pure import pure


class BodyState(NamedTuple):
    """x, y, z (m, NED); quaternion w, i, j, k from FRD to NED; ur, vr, wr (m/s); p, q, r (rad/s)."""

    x: float
    y: float
    z: float
    qw: float
    qi: float
    qj: float
    qk: float
    ur: float
    vr: float
    wr: float
    p: float
    q: float
    r: float


class Fins(NamedTuple):
    """Angles of the fins, rad: a positive rudder turns to port, positive stern planes put the bow down."""

    rudder: float
    sternplanes: float


#: Forces X, Y, Z (N) and moments K, M, N (N m) about the origin of the body axes.
Loads = tuple[float, float, float, float, float, float]
#: Three components: of a velocity or a current.
Vector = tuple[float, float, float]
#: Rates of (ur, vr, wr, p, q, r).
Accelerations = tuple[float, float, float, float, float, float]


def body_at(x: float, y: float, z: float, phi: float, theta: float, psi: float, surge: float) -> BodyState:
    """Return a body that moves ahead through the water without turning."""
    return BodyState(x, y, z, *quaternion_of(phi, theta, psi), surge, 0.0, 0.0, 0.0, 0.0, 0.0)


@pure
def angles_of(state: BodyState) -> tuple[float, float, float]:
    """Return roll, pitch and heading (phi, theta, psi), rad, each in (-pi, pi]: Eq. (3D-2)."""
    return angles_of_quaternion(state.qw, state.qi, state.qj, state.qk)


@pure
def to_world(
    qw: float, qi: float, qj: float, qk: float, u: float, v: float, w: float
) -> tuple[float, float, float]:
    """Turn a vector from FRD to NED: R (u, v, w) of Eq. (3D-1)."""
    # v + 2 qw (q x v) + 2 q x (q x v)
    a, b, c = 2.0 * (qj * w - qk * v), 2.0 * (qk * u - qi * w), 2.0 * (qi * v - qj * u)
    return (
        u + qw * a + qj * c - qk * b,
        v + qw * b + qk * a - qi * c,
        w + qw * c + qi * b - qj * a,
    )


@pure
def to_body(
    qw: float, qi: float, qj: float, qk: float, x: float, y: float, z: float
) -> tuple[float, float, float]:
    """Turn a vector from NED to FRD, the inverse of `to_world`."""
    return to_world(qw, -qi, -qj, -qk, x, y, z)


@pure
def body_slope(
    state: BodyState, accelerations: Accelerations, current: tuple[float, float, float]
) -> BodyState:
    """Return the rates of a state: Eqs. (3D-1), (3D-2).

    Args:
        state: where the body is and how it moves.
        accelerations: rates of its velocities.
        current: Vx, Vy, Vz, m/s, NED.
    """
    _, _, _, qw, qi, qj, qk, ur, vr, wr, p, q, r = state
    x, y, z = to_world(qw, qi, qj, qk, ur, vr, wr)
    Vx, Vy, Vz = current
    ud, vd, wd, pd, qd, rd = accelerations
    return BodyState(
        x + Vx,
        y + Vy,
        z + Vz,
        0.5 * (-qi * p - qj * q - qk * r),
        0.5 * (qw * p + qj * r - qk * q),
        0.5 * (qw * q + qk * p - qi * r),
        0.5 * (qw * r + qi * q - qj * p),
        ud,
        vd,
        wd,
        pd,
        qd,
        rd,
    )


@pure
def advanced(state: BodyState, slope: BodyState, h: float) -> BodyState:
    """Return state + h slope."""
    return BodyState(
        state.x + h * slope.x,
        state.y + h * slope.y,
        state.z + h * slope.z,
        state.qw + h * slope.qw,
        state.qi + h * slope.qi,
        state.qj + h * slope.qj,
        state.qk + h * slope.qk,
        state.ur + h * slope.ur,
        state.vr + h * slope.vr,
        state.wr + h * slope.wr,
        state.p + h * slope.p,
        state.q + h * slope.q,
        state.r + h * slope.r,
    )


@pure
def after_runge_kutta(
    state: BodyState, k1: BodyState, k2: BodyState, k3: BodyState, k4: BodyState, dt: float
) -> BodyState:
    """Return the state after one step of fourth order, with the quaternion of length 1 again."""
    sixth, third = dt / 6.0, dt / 3.0
    end = advanced(advanced(advanced(advanced(state, k1, sixth), k2, third), k3, third), k4, sixth)
    scale = 1.0 / math.sqrt(end.qw * end.qw + end.qi * end.qi + end.qj * end.qj + end.qk * end.qk)
    return BodyState(
        end.x,
        end.y,
        end.z,
        end.qw * scale,
        end.qi * scale,
        end.qj * scale,
        end.qk * scale,
        end.ur,
        end.vr,
        end.wr,
        end.p,
        end.q,
        end.r,
    )
