"""Guidance of one mission as a pure step: its state, holds, limits, and the follower, in their order."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.values.pure import pure
from auv_path_following.guidance import path_follower
from auv_path_following.guidance.approach import Agility
from auv_path_following.guidance.failsafe.guard import (
    UNHARMED,
    DiveGuard,
    GuardInputs,
    GuardState,
    NoDive,
    guard_step,
    surfaces,
    without_navigation,
)
from auv_path_following.guidance.followers import (
    follow_step,
    follower_begins,
    limits_inputs,
    look_step,
    rejoin_step,
)
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.spatial import spatial_follower
from auv_path_following.guidance.spatial.vertical_modes import FOLLOW_PATH
from auv_path_following.missions.limits import (
    BEGINNING,
    LimitsState,
    MissionLimits,
    NoLimits,
    limits_step,
)
from auv_path_following.missions.mission_state import (
    HOLDING,
    IDLE,
    NO_REASON,
    RUNNING,
    MissionStatus,
    completed,
    is_held,
    is_under_way,
    navigation_back,
    resumed,
    started,
)
from auv_path_following.vehicle import Vehicle


class Guide(NamedTuple):
    """Configuration.

    Attributes:
        follower: of virtual point, laws and switching, in the plane or in space.
        limits: configuration of `limits_step`.
        hold_after: a mission holds after this long without usable navigation, s; infinite: never.
        thrust: desired while the mission runs, N.
        guard: configuration of `guard_step`.
    """

    follower: Any
    limits: Any
    hold_after: float
    thrust: float
    guard: Any


def prepare(
    config: PathFollowerConfig,
    agility: Agility,
    thrust: float,
    hold_after: float = math.inf,
    bounds: MissionLimits | NoLimits | None = None,
    begins_at: float = 0.0,
) -> Guide:
    """Return the configuration of guidance.

    Args:
        config: laws and gains.
        agility: of the hull.
        thrust: of the mission, N.
        hold_after: without usable navigation for this long the mission holds, s.
        bounds: of `limits.prepare`; none if None.
        begins_at: path parameter s at which the mission begins, Eq. (1).
    """
    follower = path_follower.prepare(config, agility, begins_at)
    return Guide(follower, bounds or NoLimits(), hold_after, float(thrust), NoDive())


def prepare_spatial(
    config: PathFollowerConfig,
    vehicle: Vehicle,
    thrust: float,
    mode: Any = FOLLOW_PATH,
    hold_after: float = math.inf,
    bounds: MissionLimits | NoLimits | None = None,
    guard: DiveGuard | NoDive | None = None,
    begins_at: float = 0.0,
) -> Guide:
    """Return the configuration of guidance of a vehicle that dives.

    Args:
        config: laws and gains.
        vehicle: hull and fins.
        mode: of `vertical_step`: what the vertical plane follows; the path if left out.
        thrust, hold_after, bounds, begins_at: as in `prepare`.
        guard: of `guard.prepare`; a limit ends the mission at once if None.

    Raises:
        ConfigurationError: the vehicle's file lacks what the pitch autopilot needs.
    """
    follower = spatial_follower.prepare(config, vehicle, thrust, mode, begins_at)
    return Guide(follower, bounds or NoLimits(), hold_after, float(thrust), guard or NoDive())


class GuideState(NamedTuple):
    """State.

    Attributes:
        mission: state and reason.
        begins: whether the next measurement is the first of a mission.
        rejoins: whether the follower rejoins the path at the next usable measurement.
        blind: time without usable navigation, by stamps, s.
        follower, limits, guard: their states.
    """

    mission: MissionStatus
    begins: bool
    rejoins: bool
    blind: float
    follower: Any
    limits: LimitsState
    guard: GuardState


@pure
def first_state(config: Guide, approach: Any) -> GuideState:
    """Return the state before the start of a mission; `approach` as of `approach.empty_approach`."""
    return at_the_beginning(config, MissionStatus(IDLE, NO_REASON, math.nan), approach)


@pure
def at_the_beginning(config: Guide, mission: MissionStatus, approach: Any) -> GuideState:
    """Return the state at the beginning of the path."""
    follower = follower_begins(config.follower, approach)
    return GuideState(mission, True, False, 0.0, follower, BEGINNING, UNHARMED)


@pure
def start(config: Guide, state: GuideState) -> GuideState:
    """Start a mission at the beginning of its path; one that is under way is unchanged."""
    if is_under_way(state.mission):
        return state
    return at_the_beginning(config, started(state.mission), state.follower.progress.approach)


def resume(state: GuideState) -> GuideState:
    """End the operator's hold: the follower rejoins the path at the next measurement."""
    return state._replace(mission=resumed(state.mission), rejoins=True)


def reconfigured(config: Guide, state: GuideState) -> GuideState:
    """Return the state for a new configuration; the place on the path is kept."""
    begins = follower_begins(config.follower, state.follower.progress.approach)
    if type(state.follower.law) is type(begins.law):
        return state
    return state._replace(follower=begins._replace(progress=state.follower.progress))


@pure
def guide(
    config: Guide, path: Any, state: GuideState, measured: Any, current: Any, dt: float
) -> tuple[GuideState, Any, float, bool]:
    """Answer one measurement.

    Args:
        config: of guidance.
        path: `PathRows`, or `SpatialRows` for a vehicle that dives.
        state: of the mission.
        measured: `Measured`, or `SpatialMeasured`.
        current: estimate, NED, m/s: `Current`, or `SpatialCurrent`.
        dt: seconds since the last measurement.

    Returns:
        The state; the follower's result; the desired thrust (N), 0 exactly when no mission is running; and
        whether the mission resumed after a hold, including one that only a gap before this measurement shows.
    """
    mission, begins, rejoins, blind, follower, limits, guard = state
    navigation, _, has_water, moved, _, now = measured[:6]
    if begins:
        dt = 0.0
    rejoins = (rejoins or moved) and not begins
    # A gap between stamps holds a mission as a gap in time does: which is found first must not matter.
    # An ascent needs no velocity through the water.
    blind = dt if surfaces(guard) else blind + dt
    if blind > config.hold_after:
        guard, mission = without_navigation(guard, mission, config.hold_after, now)
    ascends = surfaces(guard)
    has_resumed = has_water and mission.state == HOLDING and not is_held(mission)
    if has_water:
        blind = 0.0
    if has_resumed:
        rejoins, mission = True, navigation_back(mission)
    is_followed = mission.state == RUNNING and has_water and not ascends
    if is_followed:
        if rejoins:
            follower = rejoin_step(config.follower, path, follower, navigation)
        since = 0.0 if rejoins else dt
        follower, output = follow_step(config.follower, path, follower, measured, current, since)
        if output.finished:
            mission = completed(mission)
    else:
        follower, output = look_step(config.follower, path, follower, navigation)
    if is_followed or is_under_way(mission):
        rests, reason = is_followed and (rejoins or begins), NO_REASON
        if not ascends:
            seen = limits_inputs(config.follower, measured, output, not is_followed, rests)
            limits, reason = limits_step(config.limits, limits, seen, dt)
        found = GuardInputs(mission, measured, output, reason, is_followed, rests)
        guard, (mission, output) = guard_step(config.guard, guard, found, dt)
    rejoins = rejoins and not is_followed
    thrust = config.thrust if mission.state == RUNNING else 0.0
    state = GuideState(mission, False, rejoins, blind, follower, limits, guard)
    return state, output, thrust, has_resumed
