"""Finds the signs of depth and pitch, from each other, from the surface and from the stern planes."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from auv_msgs_py.contract import topics
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion
from auv_sim.checks.vehicle_check.items.velocities import SPAN
from auv_sim.checks.vehicle_check.samples import Array, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown

PITCH = f"{topics.ODOM.name}: pitch against depth"
#: Least vertical speed by pitch, m/s: its changes, rms, or its mean.
_CHANGES, _MEAN = 0.04, 0.15
#: Height above the surface that no depth sensor reports of a vehicle in the water, m.
_ABOVE = 1.5
_UP = "in ENU/FLU z is up and positive pitch bow down; in NED/FRD z is depth and positive pitch bow up"


class Signs(NamedTuple):
    """What shows the signs, each 1 as the frame ids have it, -1 turned, NaN not shown.

    Attributes:
        climb: change of depth for each unit that pitch and speed give.
        depth: sign of the depth, from its place below the surface.
        rate: change of pitch for each unit of the measured pitch rate.
        planes: turning of the bow by the stern planes, as the measured pitch has it.
    """

    climb: float
    depth: float
    rate: float
    planes: float


def climb_ratio(dive: DiveMotion, water: Array, middles: Array) -> float:
    """Return the change of z for each unit that pitch and speed give; NaN without enough of it.

    Args:
        dive: the motion.
        water: speed through the water at `middles`, m/s, for odometry without velocity.
        middles: times of the changes over `SPAN`, s.
    """
    rates, _ = slope(dive.t, dive.z, SPAN)
    own = np.isfinite(dive.u).all()
    ahead = mean_over(dive.t, dive.u, middles, SPAN) if own else water
    if rates.size < 10 or not np.isfinite(ahead).all():
        return math.nan
    expected = -mean_over(dive.t, np.sin(dive.pitch), middles, SPAN) * ahead
    changes = expected - expected.mean()
    if float(np.sqrt(np.mean(changes**2))) > _CHANGES:
        return float(rates @ changes) / float(changes @ changes)
    if abs(float(expected.mean())) > _MEAN:
        return float(rates.mean() / expected.mean())
    return math.nan


def depth_sign(dive: DiveMotion) -> float:
    """Return whether z says that the vehicle is below the surface (1) or above it (-1); NaN near it."""
    depth = float(np.median(dive.down * dive.z))
    return math.copysign(1.0, depth) if abs(depth) > _ABOVE else math.nan


def check_signs(signs: Signs, dive: DiveMotion, turns_starboard: bool) -> Verdict:
    """Judge the signs of depth and pitch.

    Args:
        signs: what shows them.
        dive: the motion.
        turns_starboard: whether the rudder turned the other way than it should.
    """
    expected = f"z as pitch and speed change it; {_UP}"
    depth = float(np.median(dive.down * dive.z))
    above = f"{-depth:.1f} m above the surface"
    if math.isnan(signs.climb):
        if signs.depth < 0.0:
            return failed(PITCH, Mistake.DEPTH_SIGN, above, f"negate z: {_UP}")
        return unknown(PITCH, "the vehicle hardly dives", "a dive or a climb; --wiggle makes one")
    measured = f"z changes {signs.climb:.2f} times as pitch and speed say, depth {depth:.1f} m"
    if 0.3 < signs.climb < 2.2:
        if signs.depth < 0.0:
            both = Mistake.AXES_OTHER_CONVENTION if turns_starboard else Mistake.DIVE_OTHER_CONVENTION
            mend = "change the frame ids, or all axes" if turns_starboard else "negate z and pitch"
            return failed(PITCH, both, above, f"{mend}: {_UP}")
        return passed(PITCH, measured, expected)
    if 2.2 <= abs(signs.climb) < 5.0 and signs.climb > 0.0:
        return failed(PITCH, Mistake.DEPTH_UNITS, measured, "z in metres")
    if not -5.0 < signs.climb < -0.3:
        return failed(PITCH, Mistake.DEPTH_UNRELATED, measured, expected)
    mistake = _turned(signs)
    ways = {
        Mistake.DEPTH_SIGN: "negate z",
        Mistake.PITCH_SIGN: "negate the pitch of the orientation"
        + (" and the pitch rate" if signs.rate > 0.0 else ""),
    }
    return failed(PITCH, mistake, measured, f"{ways.get(mistake, 'negate one of them')}: {_UP}")


def _turned(signs: Signs) -> Mistake:
    """Return which of depth and pitch is turned, given that they contradict each other."""
    if signs.depth < 0.0:
        return Mistake.DEPTH_SIGN
    if signs.depth > 0.0 or signs.rate < 0.0 or signs.planes < 0.0:
        return Mistake.PITCH_SIGN
    return Mistake.DEPTH_SIGN if signs.planes > 0.0 else Mistake.DIVE_SIGN
