"""Judges the altitude: its values by REP-117, and against the depth."""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.contract import topics
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion
from auv_sim.checks.vehicle_check.samples import Array, Recording, mean_over
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed

NUMBERS, AGAINST_DEPTH = f"{topics.ALTITUDE.name}: numbers", f"{topics.ALTITUDE.name}: against depth"
_REP_117 = "a range of 0 m or more; +inf without an echo, -inf too close (REP-117)"
#: Repeated ranges, to the last bit, that no altimeter measures one after the other.
_REPEATED = 10
#: Least quick change of depth, m rms.
_LEAST = 0.05
#: Time over which the bottom counts as level, s.
_SLOW = 8.0
#: Least share of the altitude's quick changes that the depth explains: for the sign, and for the scale.
_SIGN, _SCALE = 0.5, 0.8


def check_altitude(recording: Recording, dive: DiveMotion) -> list[Verdict]:
    """Return the verdicts on a vehicle's altimeter; none without one."""
    samples = recording.altitude
    if not samples:
        return []
    ranges = np.array([s.range for s in samples])
    bad = int((np.isnan(ranges) | (np.isfinite(ranges) & (ranges < 0.0))).sum())
    if bad:
        found = f"{bad} of {ranges.size} NaN or negative"
        return [failed(NUMBERS, Mistake.NOT_A_NUMBER, found, _REP_117)]
    for limit in (0.0, samples[0].nearest, samples[0].farthest):
        if _repeats(ranges, limit):
            found = f"{limit:g} m again and again"
            return [failed(NUMBERS, Mistake.ALTITUDE_NO_ECHO, found, _REP_117)]
    heard = np.isfinite(ranges)
    measured = f"echo in {100.0 * heard.mean():.0f} %" + (
        f", {ranges[heard].min():.1f} to {ranges[heard].max():.1f} m" if heard.any() else ""
    )
    numbers = passed(NUMBERS, measured, _REP_117)
    stamps = np.array([s.stamp for s in samples])
    keep = heard & (stamps >= dive.t[0]) & (stamps <= dive.t[-1])
    return [numbers, _against_depth(dive, stamps[keep], ranges[keep])]


def _repeats(ranges: Array, number: float) -> bool:
    """Return whether a number comes many times in a row."""
    run = 0
    for found in np.isclose(ranges, number, rtol=1e-5, atol=0.0):
        run = run + 1 if found else 0
        if run >= _REPEATED:
            return True
    return False


def _against_depth(dive: DiveMotion, t: Array, ranges: Array) -> Verdict:
    """Judge depth + altitude: the bottom changes slowly, as the depth need not."""
    expected = "depth + altitude that change slowly: the bottom"
    if t.size < 20 or t[-1] - t[0] < 3.0:
        return passed(AGAINST_DEPTH, "too few echoes to judge", expected)
    roll, pitch = np.interp(t, dive.t, dive.roll), np.interp(t, dive.t, dive.pitch)
    altitude = _quick(t, ranges * np.cos(roll) * np.cos(pitch))
    depth = _quick(t, np.interp(t, dive.t, dive.down * dive.z))
    power = float(depth @ depth)
    moved = math.sqrt(power / depth.size)
    bottom = float(np.median(np.interp(t, dive.t, dive.down * dive.z) + ranges))
    if moved < _LEAST:
        return passed(AGAINST_DEPTH, f"bottom at {bottom:.1f} m; too little dive to judge its sign", expected)
    scale = -float(altitude @ depth) / power
    explained = scale * scale * power / max(float(altitude @ altitude), 1e-12)
    measured = f"altitude falls {scale:.2f} m for 1 m of dive, bottom at {bottom:.1f} m"
    if scale < -0.3 and explained > _SIGN:
        return failed(AGAINST_DEPTH, Mistake.ALTITUDE_SIGN, measured, "the range to the bottom")
    if explained > _SCALE and not 0.6 < scale < 1.6:
        return failed(AGAINST_DEPTH, Mistake.ALTITUDE_UNITS, measured, "metres")
    return passed(AGAINST_DEPTH, measured, expected)


def _quick(t: Array, values: Array) -> Array:
    """Return a signal less its mean over `_SLOW` s around each time."""
    return values - mean_over(t, values, t, _SLOW)
