"""REMUS in six degrees of freedom: Eqs. (3D-3), (3D-4), after Prestero (2001).

The state is the velocity through the water, so a constant current adds no term. The origin of the body axes
is the centre of buoyancy.

Errata of the printed coefficients, which config/vehicles/remus100_6dof.yaml keeps and
remus100_6dof_corrected.yaml corrects: Yvv = -1310 is ten times Zww on a body of revolution, whose own strip
formula gives -132; Mrp and Npq are 4.86 where their definitions Kpd - Nrd and Mqd - Kpd give 4.81; only Kpp
damps roll, although four fins give Kup = -0.7 kg m/rad.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import numbers_of, pure
from auv_path_following.vehicle import Hull
from auv_path_following.vertical_hull import immersed_share
from auv_sim.vehicle.actuator import Deflection
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

#: Rows of a 3 x 3 matrix, one after the other.
Matrix = tuple[float, float, float, float, float, float, float, float, float]
#: Rudder and stern planes during a step (rad), thrust (N), current Vx, Vy, Vz (m/s, NED).
BodyInputs = tuple[Deflection, Deflection, float, Vector]


class Remus6dof(NamedTuple):
    """Configuration of a hull.

    Attributes:
        planar, vertical: the coefficients of `Hull` and `VerticalHull` as named tuples of numbers.
        surge_heave_pitch, sway_roll_yaw: the two halves of the inverse of the mass matrix.
        radius: of the hull, m; at the surface buoyancy acts on its immersed share.
    """

    planar: Any
    vertical: Any
    surge_heave_pitch: Matrix
    sway_roll_yaw: Matrix
    radius: float


def remus_6dof_of(hull: Hull) -> Remus6dof:
    """Return the configuration of a hull.

    Raises:
        ConfigurationError: the hull has no coefficients of heave, roll and pitch.
    """
    h, v = hull, hull.vertical
    if v is None:
        raise ConfigurationError("hull.vertical", "nothing", "coefficients of heave, roll and pitch")
    surge_heave_pitch = [
        [h.m - h.Xud, 0.0, h.m * v.zg],
        [0.0, h.m - v.Zwd, -h.m * v.xg - v.Zqd],
        [h.m * v.zg, -h.m * v.xg - v.Mwd, v.Iyy - v.Mqd],
    ]
    sway_roll_yaw = [
        [h.m - h.Yvd, -h.m * v.zg, h.m * v.xg - h.Yrd],
        [-h.m * v.zg, v.Ixx - v.Kpd, 0.0],
        [h.m * v.xg - h.Nvd, 0.0, h.Izz - h.Nrd],
    ]
    return Remus6dof(
        numbers_of(hull),
        numbers_of(v),
        _inverse(surge_heave_pitch),
        _inverse(sway_roll_yaw),
        0.5 * v.diameter,
    )


def _inverse(matrix: list[list[float]]) -> Matrix:
    a, b, c, d, e, f, g, h, i = np.linalg.inv(matrix).ravel().tolist()
    return a, b, c, d, e, f, g, h, i


@pure
def remus_loads(hull: Remus6dof, state: BodyState, rudder: float, planes: float, thrust: float) -> Loads:
    """Return the right-hand side of Eq. (3D-4)."""
    h, c = hull.planar, hull.vertical
    u, v, w, p, q, r = state.ur, state.vr, state.wr, state.p, state.q, state.r
    m, W, xg, zg = h.m, c.W, c.xg, c.zg
    # Down, in body axes: (-sin theta, cos theta sin phi, cos theta cos phi).
    down_x, down_y, down_z = to_body(state.qw, state.qi, state.qj, state.qk, 0.0, 0.0, 1.0)
    heavy = W - c.B * immersed_share(state.z, hull.radius)
    X = (
        heavy * down_x + h.Xuu * u * abs(u) + (c.Xwq - m) * w * q + (c.Xqq + m * xg) * q * q
        + (h.Xvr + m) * v * r + (h.Xrr + m * xg) * r * r - m * zg * p * r + thrust
    )  # fmt: skip
    Y = (
        heavy * down_y + h.Yvv * v * abs(v) + h.Yrr * r * abs(r) + h.Yuv * u * v + (c.Ywp + m) * w * p
        + (h.Yur - m) * u * r + (c.Ypq - m * xg) * p * q - m * zg * q * r + h.Yuud * u * u * rudder
    )  # fmt: skip
    Z = (
        heavy * down_z + c.Zww * w * abs(w) + c.Zqq * q * abs(q) + c.Zuw * u * w + (c.Zuq + m) * u * q
        + (c.Zvp - m) * v * p + (c.Zrp - m * xg) * r * p + m * zg * (p * p + q * q) + c.Zuud * u * u * planes
    )  # fmt: skip
    K = (
        -zg * W * down_y + c.Kpp * p * abs(p) + c.Kup * abs(u) * p - (h.Izz - c.Iyy) * q * r
        - m * zg * (w * p - u * r) + c.Kprop * thrust
    )  # fmt: skip
    M = (
        zg * W * down_x - xg * W * down_z + c.Mww * w * abs(w) + c.Mqq * q * abs(q) + c.Muq * u * q
        + c.Muw * u * w + c.Mvp * v * p + (c.Mrp - (c.Ixx - h.Izz)) * r * p + m * zg * (v * r - w * q)
        + m * xg * (v * p - u * q) + c.Muud * u * u * planes
    )  # fmt: skip
    N = (
        xg * W * down_y + h.Nvv * v * abs(v) + h.Nrr * r * abs(r) + h.Nur * u * r + h.Nuv * u * v
        + c.Nwp * w * p + (c.Npq - (c.Iyy - c.Ixx)) * p * q + m * xg * (w * p - u * r)
        + h.Nuud * u * u * rudder
    )  # fmt: skip
    return X, Y, Z, K, M, N


@pure
def remus_accelerations(
    hull: Remus6dof, state: BodyState, rudder: float, planes: float, thrust: float
) -> Accelerations:
    """Return the rates of (ur, vr, wr, p, q, r): Eq. (3D-3)."""
    X, Y, Z, K, M, N = remus_loads(hull, state, rudder, planes, thrust)
    a, b = hull.surge_heave_pitch, hull.sway_roll_yaw
    return (
        a[0] * X + a[1] * Z + a[2] * M,
        b[0] * Y + b[1] * K + b[2] * N,
        a[3] * X + a[4] * Z + a[5] * M,
        b[3] * Y + b[4] * K + b[5] * N,
        a[6] * X + a[7] * Z + a[8] * M,
        b[6] * Y + b[7] * K + b[8] * N,
    )


@pure
def remus_slope(
    hull: Remus6dof,
    state: BodyState,
    rudder: float,
    planes: float,
    thrust: float,
    current: Vector,
) -> BodyState:
    """Return the rates of the state at fixed fins, thrust and current."""
    return body_slope(state, remus_accelerations(hull, state, rudder, planes, thrust), current)


@pure
def remus_6dof_step(
    config: Remus6dof, state: BodyState, inputs: BodyInputs, dt: float
) -> tuple[BodyState, BodyState]:
    """One Runge-Kutta step; the output is the state."""
    rudder, planes, thrust, current = inputs
    half = 0.5 * dt
    k1 = remus_slope(config, state, rudder[0], planes[0], thrust, current)
    k2 = remus_slope(config, advanced(state, k1, half), rudder[1], planes[1], thrust, current)
    k3 = remus_slope(config, advanced(state, k2, half), rudder[1], planes[1], thrust, current)
    k4 = remus_slope(config, advanced(state, k3, dt), rudder[2], planes[2], thrust, current)
    state = after_runge_kutta(state, k1, k2, k3, k4, dt)
    return state, state
