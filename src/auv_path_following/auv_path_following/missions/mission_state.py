"""The transitions between the states of a mission, as pure functions. No ROS, no clock of its own."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure

#: The states by number, as pure steps have them.
STATES = tuple(MissionState)
IDLE, RUNNING, HOLDING, COMPLETE, ABORTED = range(len(STATES))

# Causes of a state, for pure steps.
(
    WAITS, STARTED, NAVIGATION_BACK, END_OF_PATH, NAVIGATION_LOST, HELD_TOO_LONG, ABORT_CALLED,
    DURATION, PATH_DISTANCE, GEOFENCE, GROUND_SPEED, PATH_SPEED, MAX_DEPTH, MIN_ALTITUDE, DEPTH_ERROR,
    ROLLED, PITCHED, TOO_SLOW, BROACHED, DEPTH_STALLED, DEPTH_DOUBTED, SANK,
    HOLD_CALLED, RESUMED,
) = range(24)  # fmt: skip
#: Causes that end a mission under way; of a running one: the vehicle ascends for it.
_ENDS = frozenset((HELD_TOO_LONG, ABORT_CALLED, *range(DURATION, SANK + 1)))

_WORDS = {
    WAITS: "waiting for the start service",
    STARTED: "started",
    NAVIGATION_BACK: "navigation is back",
    END_OF_PATH: "the end of the path was reached",
    NAVIGATION_LOST: "no usable navigation for {bound:g} s",
    HELD_TOO_LONG: "held for more than {bound:g} s: no usable navigation for {found:g} s",
    ABORT_CALLED: "abort was called",
    DURATION: "limit duration: {found:.1f} s, at most {bound:g} s",
    PATH_DISTANCE: "limit path_distance: {found:.1f} m from the path, at most {bound:g} m",
    GEOFENCE: "limit geofence: left at north {found:.1f} m, east {over:.1f} m",
    GROUND_SPEED: "limit ground_speed: {found:.2f} m/s over {over:.1f} s, at least {bound:g} m/s",
    PATH_SPEED: "limit path_speed: {found:.2f} m/s over {over:.1f} s, at least {bound:g} m/s",
    MAX_DEPTH: "limit max_depth: {found:.1f} m, at most {bound:g} m",
    MIN_ALTITUDE: "limit min_altitude: {found:.1f} m above the bottom, at least {bound:g} m",
    DEPTH_ERROR: "limit depth_error: {found:.1f} m from the requested depth, at most {bound:g} m",
    ROLLED: "limit diving.roll_deg: {found:.0f} deg for {over:.1f} s, at most {bound:g} deg",
    PITCHED: "limit diving.pitch_deg: {found:.0f} deg for {over:.1f} s, at most {bound:g} deg",
    TOO_SLOW: "limit diving.slow_after: {found:.2f} m/s through the water for {over:.1f} s,"
    " at least {bound:g} m/s for the stern planes",
    BROACHED: "limit diving.broach_after: above {bound:g} m of depth for {over:.1f} s,"
    " where {found:.1f} m are requested",
    DEPTH_STALLED: "limit diving.depth_patience: {found:.1f} m from the requested depth, and no closer for"
    " {over:.1f} s",
    DEPTH_DOUBTED: "limit diving.depth_doubt: the depth differs by {found:.1f} m from pitch and speed,"
    " at most {bound:g} m",
    SANK: "limit diving.hold_sink: sank {found:.1f} m with thrust 0, at most {bound:g} m",
    HOLD_CALLED: "hold was called",
    RESUMED: "resume was called",
}


class Reason(NamedTuple):
    """Reason of a state: one of the causes, and the numbers of its text."""

    cause: int = WAITS
    found: float = 0.0
    over: float = 0.0
    bound: float = 0.0


#: No reason to end a mission.
NO_REASON = Reason(WAITS, 0.0, 0.0, 0.0)


def words(reason: Reason, detail: str = "") -> str:
    """Return a reason as text.

    Args:
        reason: the reason.
        detail: of lost navigation.
    """
    text = _WORDS[reason.cause].format(found=reason.found, over=reason.over, bound=reason.bound)
    of_navigation = reason.cause in (NAVIGATION_LOST, HELD_TOO_LONG)
    return f"{text} ({detail})" if detail and of_navigation else text


@settings
class HoldingConfig:
    """Response of a running mission to missing navigation, in ROS time."""

    hold_after: float = setting(
        1.0,
        "without navigation for this long the mission holds: thrust 0",
        unit="s",
        ge=0.1,
        le=60.0,
        live=True,
    )
    abort_after: float = setting(
        30.0, "holding for this long ends the mission", unit="s", ge=0.1, le=3600.0, live=True
    )


class MissionStatus(NamedTuple):
    """State and reason; `since`: ROS time at which a hold began, s, else NaN."""

    state: int = IDLE
    reason: Reason = NO_REASON
    since: float = math.nan


@pure
def is_under_way(mission: MissionStatus) -> bool:
    """Return whether a mission was started and has not ended."""
    return mission.state == RUNNING or mission.state == HOLDING


@pure
def started(mission: MissionStatus) -> MissionStatus:
    """Start from idle, complete or aborted; a mission that is under way is unchanged."""
    if is_under_way(mission):
        return mission
    return MissionStatus(RUNNING, Reason(STARTED, 0.0, 0.0, 0.0), math.nan)


@pure
def is_held(mission: MissionStatus) -> bool:
    """Return whether the operator holds a mission: only `resumed` and `aborted` end that."""
    return mission.state == HOLDING and mission.reason.cause == HOLD_CALLED


def held(mission: MissionStatus) -> MissionStatus:
    """Hold a mission under way for the operator; any other, and one that surfaces, is unchanged."""
    if not is_under_way(mission) or is_surfacing(mission):
        return mission
    return MissionStatus(HOLDING, Reason(HOLD_CALLED))


def resumed(mission: MissionStatus) -> MissionStatus:
    """End the operator's hold; any other mission is unchanged."""
    return MissionStatus(RUNNING, Reason(RESUMED)) if is_held(mission) else mission


@pure
def aborted(mission: MissionStatus, reason: Reason) -> MissionStatus:
    """End a mission, started or not; one that has ended is unchanged."""
    if mission.state == COMPLETE or mission.state == ABORTED:
        return mission
    return MissionStatus(ABORTED, reason, math.nan)


@pure
def surfacing(mission: MissionStatus, reason: Reason) -> MissionStatus:
    """Keep a mission that ends for a reason running, while the vehicle ascends."""
    return MissionStatus(RUNNING, reason, math.nan)


def is_surfacing(mission: MissionStatus) -> bool:
    """Return whether a mission runs only to ascend."""
    return mission.state == RUNNING and mission.reason.cause in _ENDS


@pure
def completed(mission: MissionStatus) -> MissionStatus:
    """Complete a running mission: the end of the path was reached."""
    if mission.state != RUNNING:
        return mission
    return MissionStatus(COMPLETE, Reason(END_OF_PATH, 0.0, 0.0, 0.0), math.nan)


@pure
def navigation_lost(mission: MissionStatus, hold_after: float, now: float) -> MissionStatus:
    """Hold a running mission: no usable navigation for `hold_after` s; `now` is ROS time, s."""
    if mission.state != RUNNING:
        return mission
    return MissionStatus(HOLDING, Reason(NAVIGATION_LOST, 0.0, 0.0, hold_after), now)


@pure
def navigation_back(mission: MissionStatus) -> MissionStatus:
    """Resume a mission that holds, unless the operator holds it."""
    if mission.state != HOLDING or is_held(mission):
        return mission
    return MissionStatus(RUNNING, Reason(NAVIGATION_BACK, 0.0, 0.0, 0.0), math.nan)


@pure
def waited(mission: MissionStatus, abort_after: float, now: float) -> MissionStatus:
    """Abort a mission that has held for longer than `abort_after` s, unless the operator holds it.

    Args:
        mission: its state.
        abort_after: longest hold, s.
        now: ROS time, s.
    """
    if mission.state != HOLDING or is_held(mission):
        return mission
    if now < mission.since:  # the clock went back
        return MissionStatus(HOLDING, mission.reason, now)
    if now - mission.since > abort_after:
        return MissionStatus(ABORTED, Reason(HELD_TOO_LONG, mission.reason.bound, 0.0, abort_after), math.nan)
    return mission
