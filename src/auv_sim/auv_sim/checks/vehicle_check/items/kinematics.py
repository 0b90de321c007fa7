"""Checks that position, yaw, yaw rate and velocities agree, and names the mix-up of frames if not.

Each quantity is explained by the others under several hypotheses (as it should be, mirrored, in degrees,
in the world frame, ...). The one that fits is the finding; if more than one fits, the vehicle has not moved
enough to decide, and the verdict says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.values.angles import wrap
from auv_sim.checks.vehicle_check.items.velocities import (
    CLEARLY,
    ENOUGH,
    LEAST_SPEED,
    SPAN,
    check_velocity,
    check_water,
)
from auv_sim.checks.vehicle_check.samples import Array, Motion, Recording, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown

#: Least turning for the sign of the yaw rate, rad/s.
LEAST_TURN = 0.02
#: Least correlation of yaw rate and change of yaw where the vehicle hardly turns.
ALIKE = 0.5
#: Heading and course may differ by this much, rms: drift, and a strong current across.
CRAB = math.radians(35.0)


class Relations(NamedTuple):
    """What the motion shows about its axes.

    Attributes:
        yaw: the mistake that explains the yaw best, None for none.
        decided: whether the others are ruled out.
        crab: rms of course less yaw as given, rad.
        turn_of_yaw, turn_of_course: rate of change of yaw and of the course, per yaw rate (1 is right); NaN
            without enough turning.
    """

    yaw: Mistake | None
    decided: bool
    crab: float
    turn_of_yaw: float
    turn_of_course: float


#: Mistake in the yaw -> how to undo it.
_YAWS: dict[Mistake | None, Callable[[Array], Array]] = {
    None: lambda yaw: yaw,
    Mistake.YAW_OTHER_CONVENTION: lambda yaw: 0.5 * math.pi - yaw,
    Mistake.YAW_SIGN: lambda yaw: -yaw,
}


def check_kinematics(recording: Recording, motion: Motion) -> list[Verdict]:
    """Judge yaw against course, yaw rate against change of yaw, velocities against change of position."""
    items = (
        f"{topics.ODOM.name}: yaw against course",
        f"{topics.ODOM.name}: yaw rate against yaw",
        f"{topics.ODOM.name}: velocity against position",
        f"{topics.WATER_VELOCITY.name}: against velocity",
    )
    if not motion.enough:
        return [unknown(item, "too little odometry", ENOUGH) for item in items]
    relations = relate(motion)
    yaw, rate = _yaw(items[0], relations), _yaw_rate(items[1], relations)
    verdicts = [yaw, rate]
    cause = yaw.mistake or (rate.mistake if rate.mistake is Mistake.SWAPPED_AXES else None)
    if cause is not None:
        return [
            *verdicts,
            *(unknown(item, "the axes come first", f"without {cause.value}") for item in items[2:]),
        ]
    return [
        *verdicts, check_velocity(items[2], motion), check_water(items[3], recording, motion)
    ]  # fmt: skip


def relate(motion: Motion) -> Relations:
    """Fit the hypotheses about the axes."""
    vx, middles = slope(motion.t, motion.x, SPAN)
    vy, _ = slope(motion.t, motion.y, SPAN)
    moving = np.hypot(vx, vy) > LEAST_SPEED
    turn_of_yaw = _ratio(motion, motion.yaw)
    if moving.sum() < 10:
        return Relations(None, False, math.nan, turn_of_yaw, math.nan)
    course = np.arctan2(vy[moving], vx[moving])
    rms = {
        # The mean of a turning yaw over the span, as the course is one.
        mistake: _circular_rms(
            course - mean_over(motion.t, np.unwrap(fix(motion.yaw)), middles[moving], SPAN)
        )
        for mistake, fix in _YAWS.items()
    }
    best = min(rms, key=lambda mistake: rms[mistake])
    others = [rms[mistake] for mistake in rms if mistake is not best]
    decided = rms[best] < CRAB and rms[best] < CLEARLY * min(others)
    unwrapped = np.unwrap(np.arctan2(vy, vx))
    turn_of_course = _course_ratio(motion, middles, unwrapped, moving)
    return Relations(best, decided, rms[None], turn_of_yaw, turn_of_course)


def _circular_rms(angles: Array) -> float:
    return float(np.sqrt(np.mean([wrap(float(angle)) ** 2 for angle in angles])))


def _ratio(motion: Motion, angle: Array) -> float:
    """Return the rate of change of an angle per yaw rate (least squares); NaN without enough turning."""
    rates, middles = slope(motion.t, angle, 0.5 * SPAN)
    turning = mean_over(motion.t, motion.r, middles, 0.5 * SPAN)
    power = float(turning @ turning)
    # The yaw alone may show the turning, when the rate is in other units.
    if max(math.sqrt(power / turning.size), 0.0) < LEAST_TURN / 60.0 or np.abs(rates).max() < LEAST_TURN:
        return math.nan
    together, own = float(rates @ turning), float(rates @ rates)
    if own < rates.size * (2.0 * LEAST_TURN) ** 2 and together**2 < ALIKE**2 * own * power:
        return math.nan  # noise of a heading that is held
    return together / power


def _course_ratio(motion: Motion, middles: Array, course: Array, moving: NDArray[np.bool_]) -> float:
    rates, at = slope(middles, course, SPAN)
    keep = np.interp(at, middles, moving.astype(float)) > 0.99
    if keep.sum() < 10:
        return math.nan
    turning = mean_over(motion.t, motion.r, at[keep], SPAN)
    if float(np.sqrt(np.mean(rates[keep] ** 2))) < LEAST_TURN:
        return math.nan
    return float(rates[keep] @ turning) / max(float(turning @ turning), 1e-12)


def _yaw(item: str, relations: Relations) -> Verdict:
    expected = f"course less yaw within {math.degrees(CRAB):.0f} deg rms"
    if math.isnan(relations.crab):
        return unknown(item, "the vehicle hardly moves", f"{LEAST_SPEED:g} m/s; --wiggle makes it move")
    measured = f"{math.degrees(relations.crab):.0f} deg rms"
    if 30.0 < relations.turn_of_yaw < 90.0:
        return failed(item, Mistake.YAW_DEGREES, f"{measured}, turning in degrees", expected)
    if relations.crab < CRAB and (relations.yaw is None or not relations.decided):
        if relations.decided or math.isfinite(relations.turn_of_yaw):
            return passed(item, measured, expected)
        return unknown(item, f"{measured}, but other conventions fit as well", ENOUGH)
    if not relations.decided or relations.yaw is None:
        return failed(item, Mistake.YAW_UNRELATED, measured, expected)
    mistake = relations.yaw
    # A mirror of the positions looks like a mirror of the yaw; the yaw rate decides which of the two it is.
    if relations.turn_of_yaw > 0.3 and relations.turn_of_course < -0.3:
        mistake = {
            Mistake.YAW_OTHER_CONVENTION: Mistake.SWAPPED_AXES,
            Mistake.YAW_SIGN: Mistake.MIRRORED_POSITION,
        }.get(mistake, mistake)
    return failed(item, mistake, measured, expected)


def _yaw_rate(item: str, relations: Relations) -> Verdict:
    ratio, expected = relations.turn_of_yaw, "1 rad/s of yaw for 1 rad/s of yaw rate"
    if math.isnan(ratio):
        return unknown(item, "the vehicle hardly turns", f"{LEAST_TURN:g} rad/s; --wiggle makes it turn")
    measured = f"yaw turns {ratio:.3g} times as fast as the yaw rate says"
    if 0.7 < ratio < 1.4:
        return passed(item, measured, expected)
    if 30.0 < ratio < 90.0:
        return failed(item, Mistake.YAW_DEGREES, measured, expected)
    if relations.decided and relations.yaw is not None:
        return failed(item, relations.yaw, measured, expected)  # a consequence
    if 1.0 / 90.0 < ratio < 1.0 / 30.0:
        return failed(item, Mistake.YAW_RATE_DEGREES, measured, expected)
    if -1.4 < ratio < -0.7:
        return failed(item, Mistake.YAW_RATE_SIGN, measured, expected)
    return failed(item, Mistake.YAW_RATE_WRONG, measured, expected)
