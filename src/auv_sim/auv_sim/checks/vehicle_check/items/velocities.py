"""Judges the vehicle's velocities, over ground and through the water, against its change of position."""

from __future__ import annotations

import math

import numpy as np

from auv_sim.checks.vehicle_check.samples import Array, Motion, Recording, mean_over, slope
from auv_sim.checks.vehicle_check.verdict import Mistake, Verdict, failed, passed, unknown

#: Time over which rates of change are taken, s: noise of the position and delay weigh less.
SPAN = 1.0
#: Least speed for a course, m/s.
LEAST_SPEED = 0.3
#: The best hypothesis must leave less than this share of any other's error, or nothing is decided.
CLEARLY = 0.6
#: A smaller error is no mistake, whatever else would fit, m/s.
SMALL = 0.05
#: What an item expects that has too little motion.
ENOUGH = "a vehicle that moves and turns (3 s at least); --wiggle makes it"


def _over_ground(motion: Motion) -> tuple[Array, Array, Array, Array, Array]:
    """Return velocities from the positions: vx, vy in the world, u, v in the body, m/s; times, s."""
    vx, middles = slope(motion.t, motion.x, SPAN)
    vy, _ = slope(motion.t, motion.y, SPAN)
    yaw = mean_over(motion.t, motion.yaw, middles, SPAN)
    u, v = vx * np.cos(yaw) + vy * np.sin(yaw), -vx * np.sin(yaw) + vy * np.cos(yaw)
    return vx, vy, u, v, middles


def check_velocity(item: str, motion: Motion) -> Verdict:
    """Judge the body velocity against the change of position."""
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
    measured = f"{errors[None]:.3f} m/s rms apart"
    best = min(errors, key=lambda mistake: errors[mistake])
    if best is not None and errors[None] > SMALL and errors[best] < CLEARLY * errors[None]:
        return failed(item, best, measured, expected)
    ratio = float(given[0] @ u) / max(float(u @ u), 1e-12)
    if not 0.7 < ratio < 1.4:
        return failed(
            item, Mistake.VELOCITY_UNITS, f"u is {ratio:.3g} times the speed of the positions", expected
        )
    if errors[None] > max(0.3 * float(np.sqrt(np.mean(u * u))), 2.0 * SMALL):
        return failed(item, Mistake.VELOCITY_WRONG, measured, expected)
    if errors[Mistake.SWAY_SIGN] < errors[None] + 0.2 * SMALL:
        return passed(item, f"{measured}; v is too small to judge its sign", expected)
    return passed(item, measured, expected)


def _rms(given: Array, u: Array, v: Array) -> float:
    return float(np.sqrt(np.mean((given[0] - u) ** 2 + (given[1] - v) ** 2)))


def check_water(item: str, recording: Recording, motion: Motion) -> Verdict:
    """Judge the velocity through the water: its difference to that over ground is a slow current."""
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
        return unknown(item, "too little odometry", ENOUGH)
    ur, vr = (np.interp(middles, t, signal) for signal in through)
    yaw = np.interp(middles, motion.t, motion.yaw)
    cos, sin = np.cos(yaw), np.sin(yaw)

    def unrest(wx: Array, wy: Array) -> float:
        """Return how much the current would have to change, m/s rms."""
        return float(np.hypot(np.std(vx - wx), np.std(vy - wy)))

    errors = {
        None: unrest(ur * cos - vr * sin, ur * sin + vr * cos),
        Mistake.WATER_SWAY_SIGN: unrest(ur * cos + vr * sin, ur * sin - vr * cos),
        Mistake.WATER_IN_WORLD: unrest(ur, vr),
    }
    current = math.hypot(
        float(np.mean(vx - (ur * cos - vr * sin))), float(np.mean(vy - (ur * sin + vr * cos)))
    )
    measured = f"current {current:.2f} m/s, restless by {errors[None]:.3f} m/s"
    best = min(errors, key=lambda mistake: errors[mistake])
    if best is not None and errors[None] > SMALL and errors[best] < CLEARLY * errors[None]:
        return failed(item, best, measured, expected)
    if current > 2.5 or errors[None] > 0.5:
        return failed(item, Mistake.WATER_WRONG, measured, expected)
    return passed(item, measured, expected)
