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
from auv_msgs_py.values.pure import pure
from auv_path_following.vehicle import Hull
from auv_path_following.vertical_hull import immersed_share
from auv_sim.vehicle.fins.actuator import Deflection
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


class Terms(NamedTuple):
    """Coefficients of Eq. (3D-4), each for its product of velocities, with the terms of inertia added.

    A rate times a velocity has the rigid body's share in it: `Xwq` is Xwq - m. Moments of weight and inertia
    about an arm stand alone: `m_zg` is m zg, `W_zg` is W zg.
    """

    Xuu: float
    Xwq: float
    Xqq: float
    Xvr: float
    Xrr: float
    Yvv: float
    Yrr: float
    Yuv: float
    Ywp: float
    Yur: float
    Ypq: float
    Yuud: float
    Zww: float
    Zqq: float
    Zuw: float
    Zuq: float
    Zvp: float
    Zrp: float
    Zuud: float
    Kpp: float
    Kup: float
    Kqr: float
    Kprop: float
    Mww: float
    Mqq: float
    Muq: float
    Muw: float
    Mvp: float
    Mrp: float
    Muud: float
    Nvv: float
    Nrr: float
    Nur: float
    Nuv: float
    Nwp: float
    Npq: float
    Nuud: float
    m_zg: float
    m_xg: float
    W_zg: float
    W_xg: float
    W: float
    B: float


class Remus6dof(NamedTuple):
    """Configuration of a hull.

    Attributes:
        terms: the coefficients of Eq. (3D-4).
        surge_heave_pitch, sway_roll_yaw: the two halves of the inverse of the mass matrix.
        radius: of the hull, m; at the surface buoyancy acts on its immersed share.
    """

    terms: Terms
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
        terms_of(hull, v),
        _inverse(surge_heave_pitch),
        _inverse(sway_roll_yaw),
        0.5 * v.diameter,
    )


def terms_of(h: Any, c: Any) -> Terms:
    """Return the coefficients of Eq. (3D-4), of a `Hull` and a `VerticalHull`."""
    m, m_zg, m_xg = h.m, h.m * c.zg, h.m * c.xg
    inertia = {
        "Xwq": c.Xwq - m, "Xqq": c.Xqq + m_xg, "Xvr": h.Xvr + m, "Xrr": h.Xrr + m_xg,
        "Ywp": c.Ywp + m, "Yur": h.Yur - m, "Ypq": c.Ypq - m_xg,
        "Zuq": c.Zuq + m, "Zvp": c.Zvp - m, "Zrp": c.Zrp - m_xg,
        "Kqr": -(h.Izz - c.Iyy), "Mrp": c.Mrp - (c.Ixx - h.Izz), "Npq": c.Npq - (c.Iyy - c.Ixx),
        "m_zg": m_zg, "m_xg": m_xg, "W_zg": c.zg * c.W, "W_xg": c.xg * c.W,
    }  # fmt: skip
    own = {name: getattr(c, name, getattr(h, name, None)) for name in Terms._fields if name not in inertia}
    return Terms(**{name: float(value) for name, value in (inertia | own).items()})


def _inverse(matrix: list[list[float]]) -> Matrix:
    a, b, c, d, e, f, g, h, i = np.linalg.inv(matrix).ravel().tolist()
    return a, b, c, d, e, f, g, h, i


@pure
def remus_loads(hull: Remus6dof, state: BodyState, rudder: float, planes: float, thrust: float) -> Loads:
    """Return the right-hand side of Eq. (3D-4)."""
    (
        Xuu, Xwq, Xqq, Xvr, Xrr, Yvv, Yrr, Yuv, Ywp, Yur, Ypq, Yuud, Zww, Zqq, Zuw, Zuq, Zvp, Zrp, Zuud,
        Kpp, Kup, Kqr, Kprop, Mww, Mqq, Muq, Muw, Mvp, Mrp, Muud, Nvv, Nrr, Nur, Nuv, Nwp, Npq, Nuud,
        m_zg, m_xg, W_zg, W_xg, W, B,
    ) = hull.terms  # fmt: skip
    _, _, z, qw, qi, qj, qk, u, v, w, p, q, r = state
    av, aw, ap, aq, ar = abs(v), abs(w), abs(p), abs(q), abs(r)
    # Down, in body axes: (-sin theta, cos theta sin phi, cos theta cos phi).
    down_x, down_y, down_z = to_body(qw, qi, qj, qk, 0.0, 0.0, 1.0)
    heavy = W - B * immersed_share(z, hull.radius)
    return (
        heavy * down_x + Xuu * u * abs(u) + Xwq * w * q + Xqq * q * q + Xvr * v * r + Xrr * r * r
        - m_zg * p * r + thrust,
        heavy * down_y + Yvv * v * av + Yrr * r * ar + Yuv * u * v + Ywp * w * p + Yur * u * r
        + Ypq * p * q - m_zg * q * r + Yuud * u * u * rudder,
        heavy * down_z + Zww * w * aw + Zqq * q * aq + Zuw * u * w + Zuq * u * q + Zvp * v * p
        + Zrp * r * p + m_zg * (p * p + q * q) + Zuud * u * u * planes,
        -W_zg * down_y + Kpp * p * ap + Kup * abs(u) * p + Kqr * q * r - m_zg * (w * p - u * r)
        + Kprop * thrust,
        W_zg * down_x - W_xg * down_z + Mww * w * aw + Mqq * q * aq + Muq * u * q + Muw * u * w
        + Mvp * v * p + Mrp * r * p + m_zg * (v * r - w * q) + m_xg * (v * p - u * q) + Muud * u * u * planes,
        W_xg * down_y + Nvv * v * av + Nrr * r * ar + Nur * u * r + Nuv * u * v + Nwp * w * p
        + Npq * p * q + m_xg * (w * p - u * r) + Nuud * u * u * rudder,
    )  # fmt: skip


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
