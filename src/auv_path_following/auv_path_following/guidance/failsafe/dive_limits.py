"""Limits of a vehicle that dives: every watchdog, in their order. No ROS, no clock."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import numbers_of, pure
from auv_path_following.guidance.failsafe.watchdogs import (
    DiveLimitsConfig,
    judge_approach_to_depth,
    judge_depth,
    judge_hold,
    judge_speed,
    judge_surface,
    judge_tilt,
    sinking_of,
)
from auv_path_following.missions.mission_state import (
    NO_REASON,
    Reason,
)
from auv_path_following.vehicle import Vehicle


class DiveLimits(NamedTuple):
    """Configuration: the limits, and depth.surface (m) and depth.minimum_speed (m/s) of the vehicle."""

    values: DiveLimitsConfig
    surface: float
    slowest: float


def prepare(config: DiveLimitsConfig, vehicle: Vehicle) -> DiveLimits:
    """Return the configuration of the limits for a vehicle."""
    depth = vehicle.depth
    return DiveLimits(numbers_of(config), float(depth.surface), float(depth.minimum_speed))


class DiveLimitsState(NamedTuple):
    """State of the limits of one mission.

    Attributes:
        tilted, slow, broached, stalled: time for which each has lasted, s.
        has_been_fast: whether the vehicle has been faster than its minimum speed since it last rested.
        has_dived: whether it has been below its surface depth.
        least: least difference from the requested depth since it was last within the tolerance, m.
        z: depth at the last step, m; NaN if the next depth does not continue it.
        deeper, shallower: how much deeper or shallower the measured depth has become than pitch and speed
            explain, m.
        held_at, deepest: depth at which a hold began, and the greatest one since, m; NaN: it does not hold.
    """

    tilted: float
    slow: float
    has_been_fast: bool
    broached: float
    has_dived: bool
    stalled: float
    least: float
    z: float
    deeper: float
    shallower: float
    held_at: float
    deepest: float


#: The state at the beginning of a mission.
NOT_DIVED = DiveLimitsState(
    0.0, 0.0, False, 0.0, False, 0.0, math.inf, math.nan, 0.0, 0.0, math.nan, math.nan
)


class DiveInputs(NamedTuple):
    """What the limits judge at one measurement.

    Attributes:
        z, phi, theta: depth (m), roll and pitch (rad), NED.
        water: velocity through the water (ur, vr, wr), FRD, m/s.
        depth: requested, m.
        follows: whether the vehicle follows its path; otherwise velocity and request are not valid.
        holds: whether the mission holds.
        rests: whether the vehicle rested until now, or its depth does not continue the last one.
    """

    z: float
    phi: float
    theta: float
    water: tuple[float, float, float]
    depth: float
    follows: bool
    holds: bool
    rests: bool


@pure
def first_of(reason: Reason, other: Reason) -> Reason:
    """Return the first of two reasons that is not `NO_REASON`."""
    return reason if reason.cause != NO_REASON.cause else other


@pure
def dive_limits(
    config: DiveLimits, state: DiveLimitsState, inputs: DiveInputs, dt: float
) -> tuple[DiveLimitsState, Reason]:
    """Return the reason why a dive must end, or `NO_REASON`. Constant in time."""
    c = config.values
    z, phi, theta, (ur, vr, wr), depth, follows, holds, rests = inputs
    tilted, slow, has_been_fast, broached, has_dived, stalled, least, last, deeper, shallower = state[:10]
    tilted, reason = judge_tilt(c, tilted, phi, theta, dt)
    held, sank = judge_hold(c, (state.held_at, state.deepest), z, holds)
    reason = first_of(reason, sank)
    if follows:
        if rests:
            last, stalled, least = math.nan, 0.0, math.inf
        (slow, has_been_fast), found = judge_speed(c, config.slowest, (slow, has_been_fast), ur, rests, dt)
        reason = first_of(reason, found)
        sinking = sinking_of(phi, theta, ur, vr, wr)
        (last, deeper, shallower), found = judge_depth(c, (last, deeper, shallower), z, sinking, dt)
        reason = first_of(reason, found)
        (broached, has_dived), found = judge_surface(c, config.surface, (broached, has_dived), z, depth, dt)
        reason = first_of(reason, found)
        (stalled, least), found = judge_approach_to_depth(c, (stalled, least), z - depth, dt)
        reason = first_of(reason, found)
    else:
        last = math.nan
    state = DiveLimitsState(
        tilted,
        slow,
        has_been_fast,
        broached,
        has_dived,
        stalled,
        least,
        last,
        deeper,
        shallower,
        held[0],
        held[1],
    )
    return state, reason
