"""How a limit ends a mission: at once, or after a driven ascent."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import dispatched, pure
from auv_path_following.guidance.failsafe import ascent as rising
from auv_path_following.guidance.failsafe import dive_limits as dives
from auv_path_following.guidance.failsafe.ascent import (
    ASCENDS,
    AT_DEPTH,
    NAVIGATION_ENDED,
    THERE,
    Ascent,
    AscentConfig,
    AscentInputs,
    AscentState,
    ascend,
    begun,
    has_to_ascend,
)
from auv_path_following.guidance.failsafe.dive_limits import (
    NOT_DIVED,
    DiveInputs,
    DiveLimits,
    DiveLimitsState,
    dive_limits,
    first_of,
)
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_path_following.guidance.measured import SpatialMeasured
from auv_path_following.guidance.spatial.spatial_follow import SpatialOutput
from auv_path_following.missions.mission_state import (
    ABORT_CALLED,
    HELD_TOO_LONG,
    HOLDING,
    NO_REASON,
    MissionStatus,
    Reason,
    aborted,
    is_under_way,
    navigation_lost,
    surfacing,
)
from auv_path_following.vehicle import Vehicle

#: A hull that floats has risen by this much from its greatest depth when a hold ends, m.
_RISEN = 0.3


class NoDive(NamedTuple):
    """Configuration of a vehicle in the plane: every reason ends its mission at once."""


class DiveGuard(NamedTuple):
    """Configuration of a vehicle that dives: its own limits, and its ascent."""

    limits: DiveLimits
    ascent: Ascent


class GuardState(NamedTuple):
    """States of the limits of a dive and of the ascent."""

    limits: DiveLimitsState
    ascent: AscentState


#: The state at the beginning of a mission.
UNHARMED = GuardState(NOT_DIVED, AT_DEPTH)


class GuardInputs(NamedTuple):
    """A step of guidance before the guard has judged it.

    Attributes:
        mission: its state.
        measured, output: the measurement, and the follower's result.
        reason: of a limit that has ended the mission, or `NO_REASON`.
        follows: whether the vehicle follows its path.
        rests: whether it rested until now, or does not continue its last place.
    """

    mission: MissionStatus
    measured: Any
    output: Any
    reason: Reason
    follows: bool
    rests: bool


def prepare(limits: DiveLimitsConfig, ascent: AscentConfig, vehicle: Vehicle, thrust: float) -> DiveGuard:
    """Return the configuration of a vehicle that dives; `thrust` of the mission, N."""
    return DiveGuard(dives.prepare(limits, vehicle), rising.prepare(ascent, vehicle, thrust))


@pure
def surfaces(state: GuardState) -> bool:
    """Return whether a driven ascent is under way."""
    return state.ascent.phase == ASCENDS


@pure
def end_at_once(
    config: NoDive, state: GuardState, seen: GuardInputs, dt: float
) -> tuple[GuardState, tuple[MissionStatus, Any]]:
    """End the mission where a limit has; the follower's result is unchanged."""
    mission, _, output, reason, _, _ = seen
    if reason.cause != NO_REASON.cause and is_under_way(mission):
        mission = aborted(mission, reason)
    return state, (mission, output)


@pure
def end_after_ascent(
    config: DiveGuard, state: GuardState, seen: GuardInputs, dt: float
) -> tuple[GuardState, tuple[MissionStatus, SpatialOutput]]:
    """Judge the dive; begin, continue and end the ascent.

    While the vehicle ascends, the mission is `running`, and its reason names the limit.
    """
    mission, measured, output, reason, follows, rests = seen
    limits, rise = state
    n, water = measured.navigation, measured.water
    if rise.phase != ASCENDS:
        holds = mission.state == HOLDING
        through = (water[0], water[1], water[2])
        at = DiveInputs(n.z, n.phi, n.theta, through, output.depth, follows, holds, rests)
        limits, found = dive_limits(config.limits, limits, at, dt)
        reason = first_of(reason, found)
        if reason.cause == NO_REASON.cause or not is_under_way(mission):
            return GuardState(limits, rise), (mission, output)
        if not has_to_ascend(config.ascent, reason, False, n.z):
            return GuardState(limits, rise), (aborted(mission, reason), output)
        rise, mission = begun(reason, n.z, n.psi), surfacing(mission, reason)
        dt = 0.0
    ur = water[0] if measured.has_water else math.nan
    now = AscentInputs(n.z, n.phi, n.theta, n.psi, ur, water[1], water[2])
    rise, theta_d = ascend(config.ascent, rise, now, dt)
    if rise.phase == ASCENDS:
        output = ascending(config.ascent, rise.psi, theta_d, measured, output)
    else:
        mission = aborted(mission, mission.reason)
    return GuardState(limits, rise), (mission, output)


@pure
def ascending(
    config: Ascent, psi_d: float, theta_d: float, measured: SpatialMeasured, output: SpatialOutput
) -> SpatialOutput:
    """Return the follower's result with the references of an ascent: heading, pitch (rad), depth (m)."""
    _, _, _, _, xe, ye, ze, _, _, s, i, x_p, y_p, z_p, chi_p, gamma_p, U_P, _, approach, _, _ = output
    psi_e = wrap(measured.navigation.psi - psi_d)
    return SpatialOutput(
        psi_d, 0.0, theta_d, 0.0, xe, ye, ze, psi_e, measured.navigation.theta - theta_d, s, i, x_p, y_p, z_p,
        chi_p, gamma_p, U_P, config.surface, approach, False, False,
    )  # fmt: skip


@pure
def without_navigation(
    state: GuardState, mission: MissionStatus, hold_after: float, now: float
) -> tuple[GuardState, MissionStatus]:
    """Hold a mission without usable navigation for `hold_after` s; end an ascent. `now` is ROS time, s."""
    if state.ascent.phase != ASCENDS:
        return state, navigation_lost(mission, hold_after, now)
    _, psi, z, trusts, time, least, since, there = state.ascent
    ended = AscentState(NAVIGATION_ENDED, psi, z, trusts, time, least, since, there)
    return GuardState(state.limits, ended), aborted(mission, mission.reason)


def held_too_long(
    config: DiveGuard | NoDive, state: GuardState, mission: MissionStatus, place: tuple[float, float] | None
) -> tuple[GuardState, MissionStatus]:
    """End a hold that has lasted too long, after an ascent where that is due and odometry still arrives.

    A hull that has not begun to rise by then does not float.

    Args:
        config, state: of the guard.
        mission: as `mission_state.waited` has ended it.
        place: depth (m) and heading (rad); None without odometry.
    """
    reason = mission.reason
    if isinstance(config, NoDive) or place is None or reason.cause != HELD_TOO_LONG:
        return state, mission
    has_risen = state.limits.deepest - place[0] > _RISEN
    sinks = config.ascent.if_sunk and not has_risen and place[0] > config.ascent.surface + THERE
    if not (sinks or has_to_ascend(config.ascent, reason, False, place[0])):
        return state, mission
    return GuardState(state.limits, begun(reason, *place)), surfacing(mission, reason)


def asked_to_abort(
    config: DiveGuard | NoDive, state: GuardState, mission: MissionStatus, place: tuple[float, float]
) -> tuple[GuardState, MissionStatus]:
    """End a mission by the service `abort`, after an ascent if so configured; `place`: depth (m), heading."""
    reason, (z, psi) = Reason(ABORT_CALLED), place
    ends = state.ascent.phase == ASCENDS or not is_under_way(mission)
    if isinstance(config, NoDive) or ends or not has_to_ascend(config.ascent, reason, True, z):
        return GuardState(state.limits, AT_DEPTH), aborted(mission, reason)
    return GuardState(state.limits, begun(reason, z, psi)), surfacing(mission, reason)


#: One step: (configuration, state, `GuardInputs`, dt) -> (state, (mission, follower's result)).
guard_step = dispatched({NoDive: end_at_once, DiveGuard: end_after_ascent})
