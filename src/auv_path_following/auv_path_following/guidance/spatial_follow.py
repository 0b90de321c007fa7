"""One step of guidance in three dimensions: virtual point, switching, a law in each plane, in their order."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import Current, Navigation, SpatialCurrent, SpatialNavigation, SpatialWater
from auv_path_following.curves.rows import evaluate
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, tangent_of, turning_of
from auv_path_following.curves.spatial.spatial_rows import SpatialRows, evaluate_spatial
from auv_path_following.guidance.follow import LONGEST_STEP, FollowerConfig, FollowerState
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.laws.registered import law_step
from auv_path_following.guidance.progress import approach_to_go, followed, move, settled
from auv_path_following.guidance.spatial_laws import (
    Levelled,
    VerticalLaw,
    current_along,
    elevation_seen,
    euler_rates,
    levelled,
    spatial_errors,
    spatial_speed,
    vertical_ailos,
)
from auv_path_following.guidance.virtual_point import driven, saturated


class SpatialFollower(NamedTuple):
    """Configuration.

    Attributes:
        plane: of the horizontal plane: law, virtual point, switching.
        vertical: of the law in the vertical plane.
        steepest: theta_max, rad.
        pitch_rate: bound of q_d, rad/s.
    """

    plane: FollowerConfig
    vertical: VerticalLaw
    steepest: float
    pitch_rate: float


class SpatialOutput(NamedTuple):
    """Result of a step (NED, m, rad, s).

    Attributes:
        psi_d, r_d: desired heading and its rate.
        theta_d, q_d: desired pitch and its rate; positive bow up.
        xe, ye, ze: errors along the path, across it, and below it.
        s: of P; i: its subpath.
        x_p, y_p, z_p, chi_p, gamma_p: P, and course and elevation of the path there.
        U_P: speed of P.
        approach: what is left of an approach.
        switched, finished: whether P has come to another subpath, or to the end of the path.
    """

    psi_d: float
    r_d: float
    theta_d: float
    q_d: float
    xe: float
    ye: float
    ze: float
    s: float
    i: int
    x_p: float
    y_p: float
    z_p: float
    chi_p: float
    gamma_p: float
    U_P: float
    approach: float
    switched: bool
    finished: bool


@pure
def level_of(navigation: SpatialNavigation) -> Navigation:
    """Return place and heading, with the rate of the heading: Eq. (3D-27)."""
    rate, _ = euler_rates(navigation.phi, navigation.theta, navigation.q, navigation.r)
    return Navigation(navigation.x, navigation.y, navigation.psi, rate)


@pure
def point_on(path: SpatialRows, legs: int, approach: object, i: int, t: float) -> SpatialPoint:
    """Return the point at t of subpath i: of the path, or of an approach at the path's first depth."""
    if legs == 0:
        return evaluate_spatial(path, i, t)
    along = followed(path.plan, legs, approach)
    x, y, dx, dy, ddx, ddy = evaluate(along, along.subpath[i], t)
    return SpatialPoint(x, y, evaluate_spatial(path, 0, 0.0).z, dx, dy, 0.0, ddx, ddy, 0.0)


@pure
def follow_spatial(
    config: SpatialFollower,
    path: SpatialRows,
    state: FollowerState,
    navigation: SpatialNavigation,
    water: SpatialWater,
    current: SpatialCurrent,
    dt: float,
) -> tuple[FollowerState, SpatialOutput]:
    """Take one step of guidance.

    Args:
        config: of both planes.
        path: as rows.
        state: of the last step.
        navigation: measured pose, NED.
        water: measured velocity through the water, FRD.
        current: the observer's estimate, NED.
        dt: seconds since the last step (0 on the first one); of a gap `LONGEST_STEP` at most counts.
    """
    plane, progress, law = config.plane, state.progress, state.law
    if dt > LONGEST_STEP:
        dt = LONGEST_STEP
    if not plane.compensate_current:
        current = SpatialCurrent(0.0, 0.0, 0.0)
    flow = levelled(water, navigation.phi, navigation.theta)
    level, over_ground = level_of(navigation), Current(current.Vx, current.Vy)
    i, t, finished, legs, joined, switched = move(
        plane.progress, path.plan, progress, level, flow.Ur, over_ground, dt
    )
    point = point_on(path, legs, progress.approach, i, t)
    tangent = tangent_of(point)
    offset = (navigation.x - point.x, navigation.y - point.y, navigation.z - point.z)
    xe, ye, ze = spatial_errors(offset, tangent.chi, tangent.gamma)
    Vt, _, Vb = current_along(current, tangent.chi, tangent.gamma)

    law, psi_d = _heading(plane, law, flow, ye, tangent.chi, over_ground, dt)
    gamma_a, rho = elevation_seen(navigation.psi + flow.beta_h, tangent)
    pitch = vertical_ailos(
        config.vertical, ze, gamma_a, rho, flow, water, navigation.phi, Vb, config.steepest
    )
    theta_d = pitch.theta_d

    desired = spatial_speed(plane.k, saturated(xe, plane.saturation), navigation.psi, flow, tangent, Vt)
    P, U_P = driven(i, t, finished, desired, tangent.speed)
    course, elevation = turning_of(point)
    r_d = bounded(course * U_P / tangent.speed, plane.turn_rate)
    q_d = bounded(elevation * U_P / tangent.speed, config.pitch_rate)
    if finished:  # there is nothing more to turn to
        psi_d, r_d, theta_d, q_d = navigation.psi, 0.0, 0.0, 0.0
    off = math.sqrt(xe * xe + ye * ye + ze * ze)
    way = progress.approach
    progress = settled(plane.progress, P, legs, way, joined, off, level)
    approach = approach_to_go(legs, way, i, t)
    if legs > 0:
        i, t = 0, 0.0
    return FollowerState(progress, law), SpatialOutput(
        wrap(psi_d), r_d, theta_d, q_d, xe, ye, ze, i + t, i, point.x, point.y, point.z, tangent.chi,
        tangent.gamma, U_P, approach, switched, finished,
    )  # fmt: skip


@pure
def _heading(
    plane: FollowerConfig, law: object, flow: Levelled, ye: float, chi_p: float, current: Current, dt: float
) -> tuple[object, float]:
    """Return the law's state and the desired heading, Eqs. (3D-20), (3D-21)."""
    Uh, beta_h = flow.Uh, flow.beta_h
    if flow.Ur < plane.minimum_speed:
        Uh = beta_h = 0.0
    law, (psi_d, _, _, _) = law_step(plane.law, law, LawInputs(ye, chi_p, Uh, beta_h, current), dt)
    return law, psi_d
