"""One step of guidance in three dimensions: virtual point, switching, a law in each plane, in their order."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.attitude import level_of
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import (
    NO_SPATIAL_CURRENT,
    Current,
    SpatialCurrent,
    SpatialNavigation,
)
from auv_path_following.curves.rows import evaluate
from auv_path_following.curves.spatial.spatial_point import SpatialPoint, Tangent, tangent_of, turning_of
from auv_path_following.curves.spatial.spatial_rows import SpatialRows, evaluate_spatial
from auv_path_following.guidance import follow as planar
from auv_path_following.guidance.follow import LONGEST_STEP, FollowerConfig, FollowerState
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.laws.registered import law_step
from auv_path_following.guidance.measured import SpatialMeasured
from auv_path_following.guidance.progress import (
    Progress,
    ProgressConfig,
    approach_to_go,
    beginning,
    followed,
    move,
    settled,
)
from auv_path_following.guidance.spatial.spatial_follower import SpatialFollower
from auv_path_following.guidance.spatial.spatial_laws import (
    current_along,
    elevation_seen,
    errors_from,
    spatial_speed,
    vertical_ailos,
)
from auv_path_following.guidance.spatial.spatial_limits import steepest_at
from auv_path_following.guidance.spatial.vertical_modes import (
    NO_REQUEST,
    VerticalInputs,
    VerticalState,
    vertical_step,
)
from auv_path_following.guidance.virtual_point import VirtualPoint, driven, saturated
from auv_path_following.navigation.levelled import Levelled, levelled


class SpatialFollowerState(NamedTuple):
    """Progress of the mission, the state of the horizontal law, and that of the vertical mode."""

    progress: Progress
    law: Any
    vertical: VerticalState


class SpatialOutput(NamedTuple):
    """Result of a step (NED, m, rad, s).

    Attributes:
        psi_d, r_d: desired heading and its rate.
        theta_d, q_d: desired pitch and its rate; positive bow up.
        xe, ye, ze: errors along the path, across it, and below it.
        psi_e, theta_e: heading and pitch less the desired ones.
        s: of P; i: its subpath.
        x_p, y_p, z_p, chi_p, gamma_p: P, and course and elevation of the path there.
        U_P: speed of P.
        depth: requested: that of P, or of another vertical mode.
        approach: remaining length of an approach.
        switched: whether P has moved to another subpath.
        finished: whether P is at the end of the path.
    """

    psi_d: float
    r_d: float
    theta_d: float
    q_d: float
    xe: float
    ye: float
    ze: float
    psi_e: float
    theta_e: float
    s: float
    i: int
    x_p: float
    y_p: float
    z_p: float
    chi_p: float
    gamma_p: float
    U_P: float
    depth: float
    approach: float
    switched: bool
    finished: bool


@pure
def first_state(config: SpatialFollower, approach: Any) -> SpatialFollowerState:
    """Return the state at the beginning of the path; `approach` as of `approach.empty_approach`."""
    plane = planar.first_state(config.plane, approach)
    return SpatialFollowerState(plane.progress, plane.law, NO_REQUEST)


@pure
def point_on(
    config: ProgressConfig, path: SpatialRows, legs: int, approach: object, i: int, t: float
) -> SpatialPoint:
    """Return the point at t of subpath i: of the path, or of an approach at the depth that it leads to."""
    if legs == 0:
        return evaluate_spatial(path, i, t)
    along = followed(path.plan, legs, approach)
    x, y, dx, dy, ddx, ddy = evaluate(along, along.subpath[i], t)
    first, at = beginning(config)
    return SpatialPoint(x, y, evaluate_spatial(path, first, at).z, dx, dy, 0.0, ddx, ddy, 0.0)


@pure
def follow_spatial(
    config: SpatialFollower,
    path: SpatialRows,
    state: SpatialFollowerState,
    measured: SpatialMeasured,
    current: SpatialCurrent,
    dt: float,
) -> tuple[SpatialFollowerState, SpatialOutput]:
    """Take one step of guidance.

    Args:
        config: of both planes.
        path: as rows.
        state: of the last step.
        measured: the measurement.
        current: the observer's estimate, NED.
        dt: seconds since the last step (0 on the first one), bounded by `LONGEST_STEP`.
    """
    plane, (progress, law, vertical) = config.plane, state
    navigation = measured.navigation
    if dt > LONGEST_STEP:
        dt = LONGEST_STEP
    if not plane.compensate_current:
        current = NO_SPATIAL_CURRENT
    flow = levelled(measured.water, navigation.phi, navigation.theta)
    level, over_ground = level_of(navigation), Current(current.Vx, current.Vy)
    i, t, finished, legs, joined, switched = move(
        plane.progress, path.plan, progress, level, flow.Ur, over_ground, dt, navigation.z
    )
    point = point_on(plane.progress, path, legs, progress.approach, i, t)
    tangent = tangent_of(point)
    xe, ye, ze = errors_from(navigation, point, tangent)
    Vt, _, Vb = current_along(current, tangent.chi, tangent.gamma)

    law, psi_d = _heading(plane, law, flow, ye, tangent.chi, over_ground, dt)
    vertical, theta_d, depth = _pitch(config, vertical, measured, flow, (point.z, ze, Vb), tangent, dt)

    desired = spatial_speed(plane.k, saturated(xe, plane.saturation), navigation.psi, flow, tangent, Vt)
    P, U_P = driven(i, t, finished, desired, tangent.speed)
    course, elevation = turning_of(point)
    r_d = bounded(course * U_P / tangent.speed, plane.turn_rate)
    q_d = bounded(elevation * U_P / tangent.speed, config.pitch_rate)
    if finished:  # the heading is kept and the pitch is level
        psi_d, r_d, theta_d, q_d = navigation.psi, 0.0, 0.0, 0.0
    off = math.sqrt(xe * xe + ye * ye + ze * ze)
    way = progress.approach
    progress = settled(plane.progress, P, legs, way, joined, off, level)
    approach = approach_to_go(legs, way, i, t)
    if legs > 0:
        i, t = beginning(plane.progress)
    return SpatialFollowerState(progress, law, vertical), SpatialOutput(
        wrap(psi_d), r_d, theta_d, q_d, xe, ye, ze, wrap(navigation.psi - psi_d), navigation.theta - theta_d,
        i + t, i, point.x, point.y, point.z, tangent.chi, tangent.gamma, U_P, depth, approach, switched,
        finished,
    )  # fmt: skip


@pure
def look_spatial(
    config: SpatialFollower, path: SpatialRows, state: SpatialFollowerState, navigation: SpatialNavigation
) -> tuple[SpatialFollowerState, SpatialOutput]:
    """Return the errors while no mission runs.

    P rests until the next step; the desired heading is the vehicle's own, the desired pitch is level.
    """
    P, legs, way, planned, joined, x, y = state.progress
    i, t = P.i, P.t
    point = point_on(config.plane.progress, path, legs, way, i, t)
    tangent = tangent_of(point)
    xe, ye, ze = errors_from(navigation, point, tangent)
    progress = Progress(VirtualPoint(i, t, 0.0, 0.0, P.finished), legs, way, planned, joined, x, y)
    approach = approach_to_go(legs, way, i, t)
    if legs > 0:
        i, t = beginning(config.plane.progress)
    return SpatialFollowerState(progress, state.law, state.vertical), SpatialOutput(
        navigation.psi, 0.0, 0.0, 0.0, xe, ye, ze, 0.0, navigation.theta, i + t, i, point.x, point.y,
        point.z, tangent.chi, tangent.gamma, 0.0, point.z, approach, False, P.finished,
    )  # fmt: skip


@pure
def rejoin_spatial(
    config: SpatialFollower, path: SpatialRows, state: SpatialFollowerState, navigation: SpatialNavigation
) -> SpatialFollowerState:
    """Return the state after a hold: P beside the vehicle, see `rejoined`, and laws and mode reset."""
    plane = FollowerState(state.progress, state.law)
    plane = planar.rejoin(config.plane, path.plan, plane, level_of(navigation))
    return SpatialFollowerState(plane.progress, plane.law, NO_REQUEST)


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


@pure
def _pitch(
    config: SpatialFollower, state: VerticalState, measured: SpatialMeasured, flow: Levelled,
    below: tuple[float, float, float], tangent: Tangent, dt: float,
) -> tuple[VerticalState, float, float]:  # fmt: skip
    """Return the state of the vertical mode, the desired pitch (rad), and the requested depth (m).

    Args:
        config, state, measured: as in `follow_spatial`.
        flow: velocity through the water, levelled.
        below: depth of P (m), ze (m), and Vb (m/s).
        tangent: of the path at P.
        dt: s.
    """
    navigation, (depth, ze, Vb) = measured.navigation, below
    steepest = steepest_at(config.steepness, flow.Ur)
    gamma_a, rho = elevation_seen(navigation.psi + flow.beta_h, tangent)
    tilt = math.cos(navigation.phi) * math.cos(navigation.theta)
    seen = VerticalInputs(navigation.z, tilt, measured.altitude, flow.Uh, ze, gamma_a, rho, depth, steepest)
    state, (ze, gamma_a, rho, depth, least_climb) = vertical_step(config.mode, state, seen, dt)
    pitch = vertical_ailos(
        config.vertical, ze, gamma_a, rho, flow, measured.water, navigation.phi, Vb, steepest, least_climb
    )
    return state, pitch.theta_d, depth
