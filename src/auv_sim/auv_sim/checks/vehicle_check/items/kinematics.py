"""Whether position, yaw, yaw rate and velocities belong together: the mix-ups of frames, found by name.

Each quantity is explained by the others under several hypotheses (as it should be, mirrored, in degrees,
in the world frame, ...). The one that fits is the finding; if more than one does, the vehicle has not moved
enough to tell, and that is said.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.values.angles import wrap
from auv_sim.checks.vehicle_check.samples import Array, Motion, Recording, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown

#: Rates of change are taken over this time, s: noise of the position and delay weigh less.
SPAN = 1.0
#: A course needs that much speed, m/s; a sign of the yaw rate so much turning, rad/s.
LEAST_SPEED, LEAST_TURN = 0.3, 0.02
#: Heading and course may differ by this much, rms: drift, and a strong current across.
CRAB = math.radians(35.0)
#: A wrong hypothesis must explain this much worse than the best one, or nothing is decided.
CLEARLY = 0.6
#: Below so much error nothing is wrong, whatever else would fit, m/s.
SMALL = 0.05

_ENOUGH = "a vehicle that moves and turns (3 s at least); --wiggle makes it"


class Relations(NamedTuple):
    """What the motion says about its own axes.

    Attributes:
        yaw: the mistake that explains the yaw best, None for none; `decided` whether others are ruled out.
        crab: rms of course less yaw as given, rad.
        turn_of_yaw, turn_of_course: rate of change of yaw and of the course, per yaw rate (1 is right); NaN
            without enough turning.
    """

    yaw: Mistake | None
    decided: bool
    crab: float
    turn_of_yaw: float
    turn_of_course: float


#: What a driver may have put into the yaw -> how to get the right one back.
_YAWS: dict[Mistake | None, Callable[[Array], Array]] = {
    None: lambda yaw: yaw,
    Mistake.YAW_OTHER_CONVENTION: lambda yaw: 0.5 * math.pi - yaw,
    Mistake.YAW_SIGN: lambda yaw: -yaw,
}


def check_kinematics(recording: Recording, motion: Motion) -> list[Verdict]:
    """Yaw against course, yaw rate against change of yaw, velocities against change of position."""
    items = (
        f"{topics.ODOM.name}: yaw against course",
        f"{topics.ODOM.name}: yaw rate against yaw",
        f"{topics.ODOM.name}: velocity against position",
        f"{topics.WATER_VELOCITY.name}: against velocity",
    )
    if not motion.enough:
        return [unknown(item, "too little odometry", _ENOUGH) for item in items]
    relations = relate(motion)
    yaw, rate = _yaw(items[0], relations), _yaw_rate(items[1], relations)
    verdicts = [yaw, rate]
    cause = yaw.mistake or (rate.mistake if rate.mistake is Mistake.SWAPPED_AXES else None)
    if cause is not None:
        return [
            *verdicts,
            *(unknown(item, "the axes come first", f"without {cause.value}") for item in items[2:]),
        ]
    velocity = _velocity(items[2], motion)
    return [*verdicts, velocity, _water(items[3], recording, motion)]


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
    """The rate of change of an angle per yaw rate, by least squares; NaN without enough turning."""
    rates, middles = slope(motion.t, angle, 0.5 * SPAN)
    turning = mean_over(motion.t, motion.r, middles, 0.5 * SPAN)
    power = float(turning @ turning)
    # The yaw alone may show the turning, when the rate is in other units.
    if max(math.sqrt(power / turning.size), 0.0) < LEAST_TURN / 60.0 or np.abs(rates).max() < LEAST_TURN:
        return math.nan
    return float(rates @ turning) / power


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
    told = f"{math.degrees(relations.crab):.0f} deg rms"
    if 30.0 < relations.turn_of_yaw < 90.0:
        return failed(item, Mistake.YAW_DEGREES, f"{told}, turning in degrees", expected)
    if relations.crab < CRAB and (relations.yaw is None or not relations.decided):
        if relations.decided or math.isfinite(relations.turn_of_yaw):
            return passed(item, told, expected)
        return unknown(item, f"{told}, but other conventions fit as well", _ENOUGH)
    if not relations.decided or relations.yaw is None:
        return failed(item, Mistake.YAW_UNRELATED, told, expected)
    mistake = relations.yaw
    # A mirror of the positions looks like a mirror of the yaw; the yaw rate decides which of the two it is.
    if relations.turn_of_yaw > 0.3 and relations.turn_of_course < -0.3:
        mistake = {
            Mistake.YAW_OTHER_CONVENTION: Mistake.SWAPPED_AXES,
            Mistake.YAW_SIGN: Mistake.MIRRORED_POSITION,
        }.get(mistake, mistake)
    return failed(item, mistake, told, expected)


def _yaw_rate(item: str, relations: Relations) -> Verdict:
    ratio, expected = relations.turn_of_yaw, "1 rad/s of yaw for 1 rad/s of yaw rate"
    if math.isnan(ratio):
        return unknown(item, "the vehicle hardly turns", f"{LEAST_TURN:g} rad/s; --wiggle makes it turn")
    told = f"yaw turns {ratio:.3g} times as fast as the yaw rate says"
    if 0.7 < ratio < 1.4:
        return passed(item, told, expected)
    if 30.0 < ratio < 90.0:
        return failed(item, Mistake.YAW_DEGREES, told, expected)
    if relations.decided and relations.yaw is not None:
        return failed(item, relations.yaw, told, expected)  # a consequence
    if 1.0 / 90.0 < ratio < 1.0 / 30.0:
        return failed(item, Mistake.YAW_RATE_DEGREES, told, expected)
    if -1.4 < ratio < -0.7:
        return failed(item, Mistake.YAW_RATE_SIGN, told, expected)
    return failed(item, Mistake.YAW_RATE_WRONG, told, expected)


def _over_ground(motion: Motion) -> tuple[Array, Array, Array, Array, Array]:
    """Velocity from the positions: in the world, in the body, and the middles of its intervals."""
    vx, middles = slope(motion.t, motion.x, SPAN)
    vy, _ = slope(motion.t, motion.y, SPAN)
    yaw = mean_over(motion.t, motion.yaw, middles, SPAN)
    u, v = vx * np.cos(yaw) + vy * np.sin(yaw), -vx * np.sin(yaw) + vy * np.cos(yaw)
    return vx, vy, u, v, middles


def _velocity(item: str, motion: Motion) -> Verdict:
    expected = "(u, v) as the positions change"
    if not np.isfinite(motion.u + motion.v).all():
        return passed(item, "not given: no bottom lock", "a NaN linear twist says so")
    vx, vy, u, v, middles = _over_ground(motion)
    if (
        float(np.hypot(u, v).max(initial=0.0)) < LEAST_SPEED
        and np.hypot(motion.u, motion.v).max() < LEAST_SPEED
    ):
        return unknown(item, "the vehicle hardly moves", f"{LEAST_SPEED:g} m/s; --wiggle makes it move")
    given = np.array([mean_over(motion.t, signal, middles, SPAN) for signal in (motion.u, motion.v)])
    errors = {
        None: _rms(given, u, v),
        Mistake.SWAY_SIGN: _rms(given, u, -v),
        Mistake.VELOCITY_IN_WORLD: min(_rms(given, vx, vy), _rms(given, vy, vx)),
    }
    told = f"{errors[None]:.3f} m/s rms apart"
    best = min(errors, key=lambda mistake: errors[mistake])
    if best is not None and errors[None] > SMALL and errors[best] < CLEARLY * errors[None]:
        return failed(item, best, told, expected)
    ratio = float(given[0] @ u) / max(float(u @ u), 1e-12)
    if not 0.7 < ratio < 1.4:
        return failed(
            item, Mistake.VELOCITY_UNITS, f"u is {ratio:.3g} times the speed of the positions", expected
        )
    if errors[None] > max(0.3 * float(np.sqrt(np.mean(u * u))), 2.0 * SMALL):
        return failed(item, Mistake.VELOCITY_WRONG, told, expected)
    if errors[Mistake.SWAY_SIGN] < errors[None] + 0.2 * SMALL:
        return passed(item, f"{told}; v is too small to judge its sign", expected)
    return passed(item, told, expected)


def _rms(given: Array, u: Array, v: Array) -> float:
    return float(np.sqrt(np.mean((given[0] - u) ** 2 + (given[1] - v) ** 2)))


def _water(item: str, recording: Recording, motion: Motion) -> Verdict:
    expected = "a current that changes slowly explains the difference"
    usable = [s for s in recording.water if math.isfinite(s.u + s.v)]
    stamps = np.array([s.stamp for s in usable])
    inside = (stamps >= motion.t[0]) & (stamps <= motion.t[-1]) if stamps.size else stamps.astype(bool)
    if inside.sum() < 10:
        return unknown(item, "too few velocities with odometry around them", "10 at least")
    order = np.argsort(stamps[inside], kind="stable")
    t = stamps[inside][order]
    through = np.array([(s.u, s.v) for s in usable])[inside][order].T
    vx, vy, _, _, middles = _over_ground(motion)
    if middles.size < 10:
        return unknown(item, "too little odometry", _ENOUGH)
    ur, vr = (np.interp(middles, t, signal) for signal in through)
    yaw = np.interp(middles, motion.t, motion.yaw)
    cos, sin = np.cos(yaw), np.sin(yaw)

    def unrest(wx: Array, wy: Array) -> float:
        """How much the current would have to change, m/s rms."""
        return float(np.hypot(np.std(vx - wx), np.std(vy - wy)))

    errors = {
        None: unrest(ur * cos - vr * sin, ur * sin + vr * cos),
        Mistake.WATER_SWAY_SIGN: unrest(ur * cos + vr * sin, ur * sin - vr * cos),
        Mistake.WATER_IN_WORLD: unrest(ur, vr),
    }
    current = math.hypot(
        float(np.mean(vx - (ur * cos - vr * sin))), float(np.mean(vy - (ur * sin + vr * cos)))
    )
    told = f"current {current:.2f} m/s, restless by {errors[None]:.3f} m/s"
    best = min(errors, key=lambda mistake: errors[mistake])
    if best is not None and errors[None] > SMALL and errors[best] < CLEARLY * errors[None]:
        return failed(item, best, told, expected)
    if current > 2.5 or errors[None] > 0.5:
        return failed(item, Mistake.WATER_WRONG, told, expected)
    return passed(item, told, expected)
