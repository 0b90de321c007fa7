"""Judges vertical velocities, over ground and through the water, against the change of depth."""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.contract import topics
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion, climb, of_water
from auv_sim.checks.vehicle_check.items.velocities import CLEARLY, ENOUGH, SPAN
from auv_sim.checks.vehicle_check.samples import Array, Recording, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown, warned

HEAVE = f"{topics.ODOM.name}: vertical velocity"
WATER_HEAVE = f"{topics.WATER_VELOCITY.name}: vertical velocity"
#: A smaller error is no mistake, and a larger one is always one, m/s.
_SMALL, _LARGE = 0.025, 0.3
_NOT_MEASURED = "not given", "NaN where it is not measured"


def check_heave(dive: DiveMotion) -> Verdict:
    """Judge twist.linear.z of the odometry: the change of depth less the part of pitch and roll."""
    expected = "twist.linear.z along the body's z axis; NaN where it is not measured"
    known = np.isfinite(dive.w)
    if not known.any():
        return passed(HEAVE, *_NOT_MEASURED)
    vz, middles = slope(dive.t, dive.z, SPAN)
    if not known.all() or middles.size < 10 or not np.isfinite(dive.u + dive.v).all():
        share = 100.0 * known.mean()
        return passed(HEAVE, f"given in {share:.0f} %, with gaps: not judged further", expected)
    u, v, given = (mean_over(dive.t, signal, middles, SPAN) for signal in (dive.u, dive.v, dive.w))
    roll, pitch = (mean_over(dive.t, angle, middles, SPAN) for angle in (dive.roll, dive.pitch))
    level = climb(roll, pitch, u, v, np.zeros_like(u))
    w = (vz - level) / (np.cos(pitch) * np.cos(roll))
    errors = {
        None: _rms(given - w),
        Mistake.HEAVE_SIGN: _rms(given + w),
        Mistake.HEAVE_IN_WORLD: min(_rms(given - vz), _rms(given + vz)),
    }
    measured = f"{errors[None]:.3f} m/s rms apart"
    best = min(errors, key=lambda mistake: errors[mistake])
    if not dive.w.any():
        if errors[None] < _SMALL:
            return passed(HEAVE, "always 0, and hardly any", expected)
        return warned(HEAVE, f"always 0, but {_rms(w):.2f} m/s rms by the depth", expected)
    if best is not None and errors[None] > _SMALL and errors[best] < CLEARLY * errors[None]:
        mend = "negate it" if best is Mistake.HEAVE_SIGN else "turn it into the body frame"
        return failed(HEAVE, best, measured, f"{expected}: {mend}")
    if errors[None] > _LARGE:
        return failed(HEAVE, Mistake.HEAVE_WRONG, measured, expected)
    if errors[Mistake.HEAVE_SIGN] < errors[None] + 0.2 * _SMALL:
        return passed(HEAVE, f"{measured}; too small to judge its sign", expected)
    return passed(HEAVE, measured, expected)


def check_water_heave(recording: Recording, dive: DiveMotion) -> Verdict:
    """Judge velocity_through_water.z: its difference to the change of depth is a slow upwelling."""
    expected = "an upwelling that changes slowly explains the difference"
    vz, middles = slope(dive.t, dive.z, SPAN)
    u, v, w = of_water(recording, dive, middles, SPAN)
    if not np.isfinite(u + v).all() or middles.size < 10:
        return unknown(WATER_HEAVE, "too few velocities with odometry around them", ENOUGH)
    if not np.isfinite(w).all():
        return passed(WATER_HEAVE, *_NOT_MEASURED)
    roll, pitch = (mean_over(dive.t, angle, middles, SPAN) for angle in (dive.roll, dive.pitch))
    if not w.any():
        return passed(WATER_HEAVE, "always 0: as if it were not measured", _NOT_MEASURED[1])

    def unrest(sign: float) -> float:
        """Return how much the upwelling would have to change, m/s rms."""
        return float(np.std(vz - climb(roll, pitch, u, v, sign * w)))

    right, turned = unrest(1.0), unrest(-1.0)
    upwelling = float(np.mean(vz - climb(roll, pitch, u, v, w)))
    measured = f"upwelling {-dive.down * upwelling:.2f} m/s, restless by {right:.3f} m/s"
    if right > _SMALL and turned < CLEARLY * right:
        return failed(WATER_HEAVE, Mistake.WATER_HEAVE_SIGN, measured, f"{expected}: negate linear.z")
    if right > _LARGE or abs(upwelling) > 1.0:
        return failed(WATER_HEAVE, Mistake.WATER_HEAVE_WRONG, measured, expected)
    return passed(WATER_HEAVE, measured, expected)


def _rms(values: Array) -> float:
    return math.sqrt(float(np.mean(values**2)))
