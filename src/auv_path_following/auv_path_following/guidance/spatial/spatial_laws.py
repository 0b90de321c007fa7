"""Guidance in three dimensions: errors, speed of the virtual point, AILOS in the vertical plane.

In the horizontal plane any registered law serves: it takes Uh for Ur and beta_h for beta_r,
Eqs. (3D-20), (3D-21).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, Tangent
from auv_path_following.guidance.laws.ailos import adaptive_offset
from auv_path_following.navigation.levelled import Levelled

#: Three components, of a place (m) or of a velocity (m/s).
Vector = tuple[float, float, float]


@pure
def spatial_errors(offset: Vector, chi: float, gamma: float) -> Vector:
    """Return xe, ye, ze of Eq. (3D-12), m: ahead of P, to starboard of the path, below it.

    Args:
        offset: the vehicle's place less that of P, NED, m.
        chi, gamma: course and elevation of the path at P, rad.
    """
    dx, dy, dz = offset
    cos_chi, sin_chi, cos_gamma, sin_gamma = math.cos(chi), math.sin(chi), math.cos(gamma), math.sin(gamma)
    along = dx * cos_chi + dy * sin_chi
    return (
        cos_gamma * along - sin_gamma * dz,
        -dx * sin_chi + dy * cos_chi,
        sin_gamma * along + cos_gamma * dz,
    )


@pure
def errors_from(
    navigation: SpatialNavigation, point: SpatialPoint, tangent: Tangent
) -> tuple[float, float, float]:
    """Return xe, ye, ze of a vehicle for a virtual point, m: Eq. (3D-12)."""
    offset = (navigation.x - point.x, navigation.y - point.y, navigation.z - point.z)
    return spatial_errors(offset, tangent.chi, tangent.gamma)


@pure
def current_along(current: Vector, chi: float, gamma: float) -> Vector:
    """Return Vt, Vn, Vb of Eq. (3D-13), m/s: the current along the path, across it, and down from it."""
    return spatial_errors(current, chi, gamma)


@pure
def spatial_speed(k: float, xe: float, psi: float, flow: Levelled, tangent: Tangent, Vt: float) -> float:
    """Return U_P, Eq. (3D-16), m/s: valid at rest too, because it contains no drift angle.

    Args:
        k: gain, 1/s.
        xe: error along the path, m.
        psi: heading, rad.
        flow: velocity through the water.
        tangent: of the path at P.
        Vt: current along the path, m/s.
    """
    off = tangent.chi - psi
    ahead = flow.ahead * math.cos(off) + flow.starboard * math.sin(off)
    return math.cos(tangent.gamma) * ahead - math.sin(tangent.gamma) * flow.down + k * xe + Vt


@pure
def elevation_seen(chi_w: float, tangent: Tangent) -> tuple[float, float]:
    """Return gamma_a and rho of Eq. (3D-19): the path's elevation along the vehicle's own course.

    gamma_a is gamma_p for a vehicle that heads along the path, 0 across it, -gamma_p the other way.

    Args:
        chi_w: the vehicle's course through the water, rad.
        tangent: of the path at P.
    """
    with_it = math.cos(chi_w - tangent.chi)
    cos, sin = math.cos(tangent.gamma), math.sin(tangent.gamma) * with_it
    return math.atan2(sin, cos), math.sqrt(cos * cos + sin * sin)


class VerticalLaw(NamedTuple):
    """Configuration of AILOS in the vertical plane.

    Attributes:
        lookahead: Delta_v, m.
        limit: bound of |theta_b|, below 1.
        minimum_speed: below it the angle of attack and alpha_b are 0, m/s.
    """

    lookahead: float
    limit: float
    minimum_speed: float


class VerticalOutput(NamedTuple):
    """theta_d and gamma_d (rad), gamma_r (rad), alpha_b (m) and theta_b."""

    theta_d: float
    gamma_d: float
    gamma_r: float
    alpha_b: float
    theta_b: float


@pure
def vertical_ailos(
    law: VerticalLaw, ze: float, gamma_a: float, rho: float, flow: Levelled, water: Vector, phi: float,
    Vb: float, steepest: float, least_climb: float = -math.inf,
) -> VerticalOutput:  # fmt: skip
    """Return the pitch that leads to the path: Eqs. (3D-22) to (3D-24).

    Holding a depth is gamma_a = 0, rho = 1, ze = depth less the desired one.

    Args:
        law: configuration.
        ze: how far the vehicle is below the path, m.
        gamma_a, rho: of `elevation_seen`.
        flow, water: velocity through the water, levelled and as measured (FRD, m/s).
        phi: roll, rad.
        Vb: current down from the path, m/s.
        steepest: theta_max, rad.
        least_climb: least elevation gamma_d, rad.
    """
    ur, vr, wr = water
    w1 = math.sin(phi) * vr + math.cos(phi) * wr
    theta_b = attack = 0.0
    if flow.Ur >= law.minimum_speed:
        theta_b = bounded(Vb / (flow.Ur * rho), law.limit)
        attack = math.atan2(w1, ur)
    alpha_b = adaptive_offset(ze, theta_b, law.lookahead)
    gamma_r = math.atan((ze + alpha_b) / law.lookahead)
    gamma_d = bounded(gamma_a + gamma_r, steepest)
    if gamma_d < least_climb:
        gamma_d = least_climb
    along = math.hypot(ur, w1)
    theta_d = gamma_d + attack
    if flow.Ur >= law.minimum_speed and along > 0.0:
        theta_d = attack + math.asin(bounded(flow.Ur / along * math.sin(gamma_d), 1.0))
    return VerticalOutput(bounded(theta_d, steepest), gamma_d, gamma_r, alpha_b, theta_b)


@pure
def error_rates(
    errors: Vector, flow: Levelled, psi: float, tangent: Tangent, turning: tuple[float, float],
    current: Vector, U_P: float,
) -> Vector:  # fmt: skip
    """Return xe', ye', ze', m/s, for any path: Eqs. (3D-18), (3D-19). For analysis; no law needs it.

    Args:
        errors: xe, ye, ze, m.
        flow, psi: velocity through the water and heading.
        tangent: of the path at P.
        turning: chi' and gamma', rad/s.
        current: Vt, Vn, Vb, m/s.
        U_P: speed of P, m/s.
    """
    (xe, ye, ze), (Vt, Vn, Vb), (course, elevation) = errors, current, turning
    chi_w = wrap(psi + flow.beta_h)
    gamma_a, rho = elevation_seen(chi_w, tangent)
    cos, sin = math.cos(tangent.gamma), math.sin(tangent.gamma)
    off = chi_w - tangent.chi
    v_t = flow.Ur * (cos * math.cos(flow.gamma_w) * math.cos(off) + sin * math.sin(flow.gamma_w))
    v_n = flow.Uh * math.sin(off)
    v_b = flow.Ur * rho * math.sin(gamma_a - flow.gamma_w)
    return (
        v_t + Vt - U_P + course * cos * ye - elevation * ze,
        v_n + Vn - course * cos * xe - course * sin * ze,
        v_b + Vb + course * sin * ye + elevation * xe,
    )
