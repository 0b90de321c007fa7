"""Checks that an odometry has depth, roll and pitch at all, and that its rates are those of its angles."""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.contract import topics
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion
from auv_sim.checks.vehicle_check.items.velocities import LEAST_SPEED, SPAN
from auv_sim.checks.vehicle_check.samples import Array, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Level, Mistake, Verdict, failed, passed, unknown, warned

DEPTH, PITCH_RATE, ROLL_RATE = (
    f"{topics.ODOM.name}: {name}"
    for name in ("depth and attitude", "pitch rate against pitch", "roll rate against roll")
)
#: Largest angle between the z axes of body and world, rad: no vehicle of this kind is steeper for long.
_TILTED = math.radians(60.0)
#: Least rate of an angle that shows its sign, rad/s.
_LEAST_RATE = 0.02
#: Least change of the pitch of a vehicle under way, rad, and of its depth by pitch and speed, m.
_LEAST_PITCH, _LEAST_DIVE = math.radians(1.0), 0.3
_ALIKE = 0.5


def check_presence(dive: DiveMotion) -> Verdict:
    """Judge whether the odometry has depth, roll and pitch: one that is planar leaves the depth loop open."""
    expected = "the vehicle's own z, roll and pitch"
    tilt = np.arccos(np.clip(np.cos(dive.roll) * np.cos(dive.pitch), -1.0, 1.0))
    typical = float(np.median(tilt))
    if typical > _TILTED:
        return failed(
            DEPTH, Mistake.ATTITUDE_TILTED, f"tilted by {math.degrees(typical):.0f} deg",
            "roll and pitch within some 30 deg, in radians; at 180 deg turn the body's z axis over",
        )  # fmt: skip
    flat = not dive.roll.any() and not dive.pitch.any()
    if flat and not dive.z.any():
        if not _moves(dive):
            return unknown(
                DEPTH, "z, roll and pitch exactly 0, and at rest", "a vehicle that moves; --wiggle"
            )
        return failed(DEPTH, Mistake.PLANAR_ODOMETRY, "z, roll and pitch exactly 0 under way", expected)
    if not _moves(dive):
        return passed(DEPTH, f"z {dive.z.min():.2f} to {dive.z.max():.2f} m", expected)
    if flat:
        return failed(DEPTH, Mistake.ATTITUDE_FLAT, "roll and pitch exactly 0 under way", expected)
    if np.ptp(dive.z) == 0.0 and (np.ptp(dive.pitch) > _LEAST_PITCH or _climbed(dive) > _LEAST_DIVE):
        found = f"z = {dive.z[0]:g} m to the last bit, pitch by {math.degrees(np.ptp(dive.pitch)):.1f} deg"
        return failed(DEPTH, Mistake.DEPTH_FROZEN, found, "z of the depth sensor in every odometry")
    measured = (
        f"z {dive.z.min():.2f} to {dive.z.max():.2f} m, roll within {_largest(dive.roll):.0f} deg,"
        f" pitch within {_largest(dive.pitch):.0f} deg"
    )
    if not dive.roll.any():
        return warned(DEPTH, f"{measured}: roll exactly 0", "a measured roll: both fins act across it")
    return passed(DEPTH, measured, expected)


def _largest(angle: Array) -> float:
    return math.degrees(float(np.abs(angle).max()))


def _moves(dive: DiveMotion) -> bool:
    speed = np.hypot(slope(dive.t, dive.x, SPAN)[0], slope(dive.t, dive.y, SPAN)[0])
    return bool(speed.size) and float(np.median(speed)) > 0.5 * LEAST_SPEED


def _climbed(dive: DiveMotion) -> float:
    """Return by how much the depth should have changed by pitch and speed, m."""
    u = np.where(np.isfinite(dive.u), dive.u, LEAST_SPEED)
    return float(abs(np.sum(0.5 * (np.sin(dive.pitch) * u)[1:] * np.diff(dive.t))))


def rate_ratio(t: Array, angle: Array, rate: Array) -> float:
    """Return how fast an angle changes for each unit of its measured rate; NaN where it hardly changes."""
    changes, middles = slope(t, angle, 0.5 * SPAN)
    if changes.size < 10 or float(np.percentile(np.abs(changes), 95)) < _LEAST_RATE:
        return math.nan
    measured = mean_over(t, rate, middles, 0.5 * SPAN)
    power = float(measured @ measured)
    return float(changes @ measured) / max(power, 1e-12)


def with_sound_rate(dive: DiveMotion) -> DiveMotion:
    """Return the motion with a pitch rate from the change of pitch, where the measured one is another."""
    if check_pitch_rate(rate_ratio(dive.t, dive.pitch, dive.pitch_rate)).level is not Level.FAIL:
        return dive
    q = (np.gradient(dive.pitch, dive.t) + dive.r * np.sin(dive.roll)) / np.cos(dive.roll)
    return dive._replace(q=q)


def check_pitch_rate(ratio: float) -> Verdict:
    """Judge the measured rates against the change of pitch."""
    expected = "1 rad/s of pitch for 1 rad/s of pitch rate, twist.angular.y"
    if math.isnan(ratio):
        return unknown(PITCH_RATE, "the vehicle hardly pitches", f"{_LEAST_RATE:g} rad/s; --wiggle makes it")
    measured = f"pitch turns {ratio:.3g} times as fast as the pitch rate says"
    if 0.6 < ratio < 1.5:
        return passed(PITCH_RATE, measured, expected)
    if 1.0 / 90.0 < ratio < 1.0 / 30.0:
        return failed(PITCH_RATE, Mistake.PITCH_RATE_DEGREES, measured, expected)
    if -1.5 < ratio < -0.6:
        return failed(PITCH_RATE, Mistake.PITCH_RATE_SIGN, measured, f"{expected}: negate it")
    return failed(PITCH_RATE, Mistake.PITCH_RATE_WRONG, measured, expected)


def check_roll_rate(dive: DiveMotion) -> Verdict:
    """Judge the roll rate against the change of roll; a vehicle that hardly rolls passes."""
    expected = "roll that changes by the roll rate, twist.angular.x"
    rate = dive.p + np.tan(dive.pitch) * (dive.q * np.sin(dive.roll) + dive.r * np.cos(dive.roll))
    if not dive.p.any():
        return passed(ROLL_RATE, "no roll rate given", expected)
    changes, middles = slope(dive.t, dive.roll, 0.25 * SPAN)
    measured = mean_over(dive.t, rate, middles, 0.25 * SPAN) if changes.size else changes
    if changes.size < 10 or float(np.sqrt(np.mean(changes**2))) < 2.0 * _LEAST_RATE:
        return passed(ROLL_RATE, "too little roll to judge its sign", expected)
    alike = float(changes @ measured) / math.sqrt(
        max(float(changes @ changes) * float(measured @ measured), 1e-12)
    )
    if alike < -_ALIKE:
        return failed(
            ROLL_RATE, Mistake.ROLL_SIGN, f"correlation {alike:.2f}",
            "both positive where the starboard side goes down",
        )  # fmt: skip
    return passed(ROLL_RATE, f"correlation {alike:.2f}", expected)
