"""One step of guidance: virtual point, switching and a line-of-sight law in their order; Eqs. (9), (17)."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation
from auv_path_following.curves.rows import PathRows, curvature, evaluate
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.laws.registered import law_step
from auv_path_following.guidance.measured import Measured
from auv_path_following.guidance.progress import (
    Progress,
    ProgressConfig,
    approach_to_go,
    beginning,
    first_progress,
    followed,
    move,
    rejoined,
    settled,
)
from auv_path_following.guidance.virtual_point import (
    VirtualPoint,
    driven,
    path_errors,
    saturated,
    tangential_speed,
)

#: Largest time step, s: in a longer gap no further motion is assumed.
LONGEST_STEP = 1.0


class FollowerConfig(NamedTuple):
    """`PathFollowerConfig` and `Agility` as numbers.

    Attributes:
        law: configuration of the chosen law.
        law_begins: its initial state.
        compensate_current: use the estimated current.
        minimum_speed: below it beta_r and alpha are 0, m/s.
        k, saturation: of the virtual point (1/s, m).
        turn_rate: bound of r_d, rad/s.
        progress: motion of P.
    """

    law: Any
    law_begins: Any
    compensate_current: bool
    minimum_speed: float
    k: float
    saturation: float
    turn_rate: float
    progress: ProgressConfig


class FollowerState(NamedTuple):
    """Progress of the mission, and the state of the law."""

    progress: Progress
    law: Any


class GuidanceOutput(NamedTuple):
    """Result of a step, with every signal for plots (NED, m, rad, s).

    During an approach P, its errors and its course are those of the approach, s and i are 0, and
    `approach` is its remaining length, m.
    """

    psi_d: float
    r_d: float
    xe: float
    ye: float
    psi_e: float
    s: float
    i: int
    x_p: float
    y_p: float
    chi_p: float
    kappa: float
    U_P: float
    beta_r: float
    chi_r: float
    alpha: float
    theta_n: float
    approach: float
    switched: bool
    finished: bool


@pure
def first_state(config: FollowerConfig, approach: Any) -> FollowerState:
    """Return the state at the beginning of the path; `approach` as of `approach.empty_approach`."""
    return FollowerState(first_progress(config.progress, approach), config.law_begins)


def reconfigured(config: FollowerConfig, state: FollowerState) -> FollowerState:
    """Return the state for a new configuration: the state of another law is reset, the rest is kept."""
    is_same = type(state.law) is type(config.law_begins)
    return state if is_same else state._replace(law=config.law_begins)


@pure
def follow(
    config: FollowerConfig,
    path: PathRows,
    state: FollowerState,
    measured: Measured,
    current: Current,
    dt: float,
) -> tuple[FollowerState, GuidanceOutput]:
    """Take one step of guidance.

    Args:
        config: of `prepare`.
        path: the path's rows.
        state: of the last step.
        measured: the measurement.
        current: the observer's estimate, NED.
        dt: time since the last step, s (0 on the first one), bounded by `LONGEST_STEP`.
    """
    # Unpacked at once: faster than one field after the other.
    law_config, _, compensates, minimum_speed, k, saturation, turn_rate, where = config
    progress, law = state
    navigation, water, _, _, _, _ = measured
    psi, (ur, vr) = navigation.psi, water
    if dt > LONGEST_STEP:
        dt = LONGEST_STEP
    if not compensates:
        current = NO_CURRENT
    Ur = math.hypot(ur, vr)  # Eq. (17)
    i, t, finished, legs, joined, switched = move(where, path, progress, navigation, Ur, current, dt)
    way = progress.approach
    along = followed(path, legs, way)
    x_p, y_p, dx, dy, ddx, ddy = evaluate(along, along.subpath[i], t)
    chi_p = math.atan2(dy, dx)
    xe, ye = path_errors(navigation, x_p, y_p, chi_p)

    beta_r = math.atan2(vr, ur)
    if Ur < minimum_speed:
        Ur = beta_r = 0.0
    seen = LawInputs(ye, chi_p, Ur, beta_r, current)
    law, (psi_d, chi_r, alpha, theta_n) = law_step(law_config, law, seen, dt)

    desired = tangential_speed(k, saturated(xe, saturation), psi, water, chi_p, current)
    P, U_P = driven(i, t, finished, desired, math.hypot(dx, dy))
    kappa = curvature(dx, dy, ddx, ddy)
    # At the end of the path the vehicle keeps its heading.
    psi_d, r_d = (psi, 0.0) if finished else (wrap(psi_d), kappa * U_P)  # Eq. (9)
    r_d = bounded(r_d, turn_rate)
    progress = settled(where, P, legs, way, joined, math.hypot(xe, ye), navigation)
    approach = approach_to_go(legs, way, i, t)
    if legs > 0:
        i, t = beginning(where)
    return FollowerState(progress, law), GuidanceOutput(
        psi_d, r_d, xe, ye, wrap(psi - psi_d), i + t, i, x_p, y_p, chi_p, kappa, U_P, beta_r,
        chi_r, alpha, theta_n, approach, switched, finished,
    )  # fmt: skip


@pure
def look(
    config: FollowerConfig, path: PathRows, state: FollowerState, navigation: Navigation
) -> tuple[FollowerState, GuidanceOutput]:
    """Return the errors while no mission runs.

    P rests until the next step; the desired heading is the vehicle's own.
    """
    P, legs, approach, planned, joined, x, y = state.progress
    i, t = P.i, P.t
    along = followed(path, legs, approach)
    x_p, y_p, dx, dy, ddx, ddy = evaluate(along, along.subpath[i], t)
    chi_p = math.atan2(dy, dx)
    xe, ye = path_errors(navigation, x_p, y_p, chi_p)
    progress = Progress(VirtualPoint(i, t, 0.0, 0.0, P.finished), legs, approach, planned, joined, x, y)
    left = approach_to_go(legs, approach, i, t)
    if legs > 0:
        i, t = beginning(config.progress)
    return FollowerState(progress, state.law), GuidanceOutput(
        navigation.psi, 0.0, xe, ye, 0.0, i + t, i, x_p, y_p, chi_p, curvature(dx, dy, ddx, ddy), 0.0, 0.0,
        0.0, 0.0, 0.0, left, False, P.finished,
    )  # fmt: skip


@pure
def rejoin(
    config: FollowerConfig, path: PathRows, state: FollowerState, navigation: Navigation
) -> FollowerState:
    """Return the state after a hold: P beside the vehicle, see `rejoined`, and the law reset."""
    return FollowerState(rejoined(config.progress, path, state.progress, navigation), config.law_begins)
