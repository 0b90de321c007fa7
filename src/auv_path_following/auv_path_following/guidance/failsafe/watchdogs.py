"""One pure watchdog for each way in which a dive fails, and their settings. No ROS, no clock."""

from __future__ import annotations

import math

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import numbers, pure
from auv_path_following.missions.mission_state import (
    BROACHED,
    DEPTH_DOUBTED,
    DEPTH_STALLED,
    NO_REASON,
    PITCHED,
    ROLLED,
    SANK,
    TOO_SLOW,
    Reason,
)
from auv_path_following.navigation.levelled import levelled

#: Decrease of a depth error that counts as progress, m.
_CLOSER = 0.25
#: Distance below the surface depth from which a requested depth is under water, m.
_UNDER_WATER = 0.3


@numbers
@settings
class DiveLimitsConfig:
    """Limits that end the mission of a vehicle with stern planes. 0 is no limit."""

    roll_deg: float = setting(
        60.0, "largest roll for longer than tilt_after (rudder and planes change roles); 0: any", unit="deg",
        ge=0.0, le=180.0, live=True,
    )  # fmt: skip
    pitch_deg: float = setting(
        60.0, "largest pitch for longer than tilt_after; 0: any", unit="deg", ge=0.0, le=90.0, live=True
    )
    tilt_after: float = setting(
        1.0, "roll or pitch beyond its limit for this long ends the mission", unit="s", ge=0.0, live=True
    )
    slow_after: float = setting(
        10.0,
        "slower through the water than depth.minimum_speed of the vehicle file for this long, once it was"
        " faster; 0: any",
        unit="s", ge=0.0, live=True,
    )  # fmt: skip
    broach_after: float = setting(
        5.0,
        "above depth.surface of the vehicle file for this long, where more depth is requested, once it was"
        " below; 0: any",
        unit="s", ge=0.0, live=True,
    )  # fmt: skip
    depth_tolerance: float = setting(
        2.0, "a smaller difference from the requested depth is none, for depth_patience", unit="m", gt=0.0,
        live=True,
    )  # fmt: skip
    depth_patience: float = setting(
        30.0,
        "a difference from the requested depth that has not become smaller for this long ends the mission:"
        " planes that do not move, that are at their stop, or too much buoyancy; 0: any",
        unit="s", ge=0.0, live=True,
    )  # fmt: skip
    depth_doubt: float = setting(
        2.0,
        "largest difference (m) between the change of the measured depth and that by pitch and speed, beyond"
        " depth_rate_error: a depth that is frozen, or of the wrong sign; 0: any",
        unit="m", ge=0.0, live=True,
    )  # fmt: skip
    depth_rate_error: float = setting(
        0.3, "rate at which depth and pitch may always differ: upwelling, sensor errors", unit="m/s", gt=0.0,
        live=True,
    )  # fmt: skip
    hold_sink: float = setting(
        4.0,
        "largest increase of the depth while holding, with thrust 0; the momentum of a dive takes a REMUS 100"
        " 2.9 m deeper; 0: any",
        unit="m", ge=0.0, live=True,
    )  # fmt: skip


@pure
def sinking_of(phi: float, theta: float, ur: float, vr: float, wr: float) -> float:
    """Return dz/dt (m/s, down positive) of a velocity through the water (m/s, FRD), by the attitude (rad)."""
    return levelled((ur, vr, wr), phi, theta).down


@pure
def judge_tilt(
    c: DiveLimitsConfig, since: float, phi: float, theta: float, dt: float
) -> tuple[float, Reason]:
    """Judge roll and pitch (rad): return how long one has been beyond its limit (s), and a reason to end."""
    roll, pitch = math.degrees(abs(phi)), math.degrees(abs(theta))
    rolled, pitched = roll > c.roll_deg > 0.0, pitch > c.pitch_deg > 0.0
    if not (rolled or pitched):
        return 0.0, NO_REASON
    since += dt
    if since <= c.tilt_after:
        return since, NO_REASON
    if rolled:
        return since, Reason(ROLLED, roll, since, c.roll_deg)
    return since, Reason(PITCHED, pitch, since, c.pitch_deg)


@pure
def judge_speed(
    c: DiveLimitsConfig, slowest: float, state: tuple[float, bool], ur: float, rests: bool, dt: float
) -> tuple[tuple[float, bool], Reason]:
    """Judge the speed ahead (m/s): the planes lose their effect, and reverse, below the slowest."""
    since, has_been_fast = state
    has_been_fast = (has_been_fast and not rests) or ur >= slowest
    since = since + dt if has_been_fast and ur < slowest else 0.0
    if since > c.slow_after > 0.0:
        return (since, has_been_fast), Reason(TOO_SLOW, ur, since, slowest)
    return (since, has_been_fast), NO_REASON


@pure
def judge_surface(
    c: DiveLimitsConfig, surface: float, state: tuple[float, bool], z: float, depth: float, dt: float
) -> tuple[tuple[float, bool], Reason]:
    """Judge a vehicle that has dived and is at the surface again, where `depth` (m) is requested."""
    since, has_dived = state
    has_dived = has_dived or z > surface + _UNDER_WATER
    broaches = has_dived and z < surface and depth > surface + _UNDER_WATER
    since = since + dt if broaches else 0.0
    if since > c.broach_after > 0.0:
        return (since, has_dived), Reason(BROACHED, depth, since, surface)
    return (since, has_dived), NO_REASON


@pure
def judge_approach_to_depth(
    c: DiveLimitsConfig, state: tuple[float, float], error: float, dt: float
) -> tuple[tuple[float, float], Reason]:
    """Judge whether a difference from the requested depth (m) becomes smaller."""
    since, least = state
    error = abs(error)
    if error <= c.depth_tolerance:
        return (0.0, math.inf), NO_REASON
    if error < least - _CLOSER or least == math.inf:
        return (0.0, error), NO_REASON
    since += dt
    if since > c.depth_patience > 0.0:
        return (since, least), Reason(DEPTH_STALLED, error, since, c.depth_patience)
    return (since, least), NO_REASON


@pure
def judge_depth(
    c: DiveLimitsConfig, state: tuple[float, float, float], z: float, sinking: float, dt: float
) -> tuple[tuple[float, float, float], Reason]:
    """Compare the change of the measured depth (m) with the sinking by pitch and speed (m/s).

    A cumulative sum to either side decays at `depth_rate_error`, so a smaller upwelling never adds up. A
    depth that is frozen or of the wrong sign does, as soon as the vehicle climbs or dives.
    """
    last, deeper, shallower = state
    if math.isnan(last):
        return (z, 0.0, 0.0), NO_REASON
    unexplained, forgotten = z - last - sinking * dt, c.depth_rate_error * dt
    deeper = max(deeper + unexplained - forgotten, 0.0)
    shallower = max(shallower - unexplained - forgotten, 0.0)
    found = max(deeper, shallower)
    if found > c.depth_doubt > 0.0:
        return (z, deeper, shallower), Reason(DEPTH_DOUBTED, found, 0.0, c.depth_doubt)
    return (z, deeper, shallower), NO_REASON


@pure
def judge_hold(
    c: DiveLimitsConfig, state: tuple[float, float], z: float, holds: bool
) -> tuple[tuple[float, float], Reason]:
    """Judge the depth of a vehicle that holds: return where the hold began and its greatest depth, m."""
    held_at, deepest = state
    if not holds:
        return (math.nan, math.nan), NO_REASON
    if math.isnan(held_at):
        held_at = deepest = z
    deepest = max(deepest, z)
    if z - held_at > c.hold_sink > 0.0:
        return (held_at, deepest), Reason(SANK, z - held_at, 0.0, c.hold_sink)
    return (held_at, deepest), NO_REASON
