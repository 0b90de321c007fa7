"""The simulated vehicle's own navigation: dead reckoning by Doppler log, corrected by acoustic fixes.

With bottom lock the position is propagated by the velocity over ground, otherwise by the velocity through the
water and an estimated current. A Kalman filter corrects it by the fixes; implausible ones are refused.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import modulus, numbers, numbers_of, pure, squared
from auv_msgs_py.values.types import Navigation
from auv_sim.vehicle.dead_reckoning import keep_way, track_of, way_since
from auv_sim.vehicle.draws import Draws, Now, Ring, slot
from auv_sim.vehicle.position_fixes import Fixes
from auv_sim.vehicle.sensors import Measurements


@numbers
@settings
class NavigatorConfig:
    """The navigator's assumptions about its instruments."""

    start: float = setting(
        0.5, "standard deviation of the initial position, north and east", unit="m", gt=0.0
    )
    fix: float = setting(1.0, "standard deviation of a fix, north and east", unit="m", gt=0.0)
    gate: float = setting(
        3.5, "deviation beyond which a fix is refused, in standard deviations", gt=0.0, le=100.0
    )
    patience: int = setting(5, "refusals in a row after which the navigator increases its own variance", ge=1)
    walk: float = setting(0.05, "random walk of dead reckoning: m after one second", unit="m/s^0.5", gt=0.0)
    bottom_error: float = setting(
        0.03, "standard deviation of the error of the velocity over ground", unit="m/s", gt=0.0
    )
    water_error: float = setting(
        0.15, "standard deviation of the error of its current estimate", unit="m/s", gt=0.0
    )
    error_time: float = setting(2000.0, "time constant of these errors", unit="s", gt=0.0)
    current_time: float = setting(20.0, "time constant of the current estimate", unit="s", gt=0.0)
    blend: float = setting(
        5.0, "time over which a correction is spread, so that the pose never jumps", unit="s", ge=0.0
    )
    surface_fix: float = setting(
        1.0, "standard deviation of a satellite fix, north and east", unit="m", gt=0.0
    )
    depth_time: float = setting(
        0.0,
        "time constant with which depth follows the pressure; in between it follows the velocity down",
        unit="s",
        ge=0.0,
    )


class Navigator(NamedTuple):
    """Configuration of the navigator.

    Attributes:
        assumed: the numbers of a `NavigatorConfig`.
        latency, fixes: of the position fixes: s, and their ring.
        track: ring of dead reckoning, see `track_of`.
    """

    assumed: Any
    latency: float
    fixes: Ring
    track: Ring


class NavigatorState(NamedTuple):
    """State of the filter.

    Attributes:
        z: position, north + i east, m.
        shown: correction that the reported pose still lacks, m.
        P_z, P_ze: variance of the position, m^2; covariance with the error of the source of velocity.
        bottom, water: the slow errors of both sources of velocity, north + i east, m/s.
        P_bottom, P_water: their variances.
        on_water: whether the last velocity was through the water.
        velocity: the last one, north + i east, m/s.
        way: displacement by dead reckoning since the start, m.
        in_a_row, refused: fixes refused since the last accepted one, and in all.
    """

    z: complex
    shown: complex
    P_z: float
    P_ze: complex
    bottom: complex
    P_bottom: float
    water: complex
    P_water: float
    on_water: bool
    velocity: complex
    way: complex
    in_a_row: int
    refused: int


def navigator_of(config: NavigatorConfig, fixes: Fixes, draws: Draws) -> Navigator:
    """Return the configuration of a navigator.

    Args:
        config: its assumptions about its instruments.
        fixes: its position fixes.
        draws: of the run.
    """
    return Navigator(numbers_of(config), fixes.latency, fixes.ring, track_of(draws))


def navigator_at(config: Navigator, x: float, y: float) -> NavigatorState:
    """Return the state of a navigator that starts from a position (m, north, east), known to `start`."""
    c = config.assumed
    P_bottom, P_water = c.bottom_error * c.bottom_error, c.water_error * c.water_error
    return NavigatorState(
        complex(x, y), 0j, c.start * c.start, 0j, 0j, P_bottom, 0j, P_water, False, 0j, 0j, 0, 0
    )


@pure
def navigate(
    config: Navigator, state: NavigatorState, measured: Measurements, now: Now, dt: float
) -> tuple[NavigatorState, Navigation]:
    """Propagate by dead reckoning, correct by the fixes that arrived; return the reported pose as well.

    A Kalman filter for the position and the slow error of its velocity. North and east are the real and the
    imaginary part of one complex number, as their errors are equal in distribution and independent. So two
    states suffice, z (m) and the error e (m/s), a random walk. With bottom lock
    z' = exp(i psi) (u + i v + e), and e turns with the vehicle: a crooked compass, a wrong scale. Without,
    z' = exp(i psi) (ur + i vr) + e, and e is the current. Variances are those of one axis: P_z and that of e
    are real, P_ze, between them, is complex.
    """
    state = _carry_on(config, state, measured, now, dt)
    for k in range(measured.first, measured.after):
        at, kept = slot(config.fixes, k), now.memory.kept
        age = config.latency + max(now.time - kept[at], 0.0)
        state = weigh(config, state, complex(kept[at + 1], kept[at + 2]), config.assumed.fix, age, now)
    shown = state.z + state.shown
    return state, Navigation(shown.real, shown.imag, measured.psi, measured.r)


@pure
def _carry_on(
    config: Navigator, state: NavigatorState, measured: Measurements, now: Now, dt: float
) -> NavigatorState:
    c = config.assumed
    z, shown, P_z, P_ze, bottom, P_bottom, water, P_water, on_water, last, way, in_a_row, refused = state
    psi, _, (ur, vr), _, u, v, lock, _, _ = measured
    turn = complex(math.cos(psi), math.sin(psi))
    through = turn * complex(ur, vr)
    if on_water == lock:
        P_ze, P_water = 0j, squared(c.water_error)
    axes, velocity, error, variance, deviation = 1.0 + 0j, through, water, P_water, c.water_error
    if lock:
        axes, velocity, error, variance, deviation = (
            turn,
            turn * complex(u, v),
            bottom,
            P_bottom,
            c.bottom_error,
        )
        water += (velocity + turn * bottom - through - water) * -math.expm1(-dt / c.current_time)
    # Trapezoidal: the velocity is the mean of its two ends.
    velocity += axes * error
    step = 0.5 * (velocity + last) * dt
    P_z += 2.0 * dt * (axes * P_ze.conjugate()).real + dt * dt * variance
    P_z += c.walk * c.walk * dt
    P_ze += axes * dt * variance
    variance += 2.0 * squared(deviation) * dt / c.error_time
    if lock:
        P_bottom = variance
    else:
        P_water = variance
    shown *= math.exp(-dt / c.blend) if c.blend > 0.0 else 0.0
    way += step
    keep_way(config.track, way, now)
    return NavigatorState(
        z + step,
        shown,
        P_z,
        P_ze,
        bottom,
        P_bottom,
        water,
        P_water,
        not lock,
        velocity,
        way,
        in_a_row,
        refused,
    )


@pure
def weigh(
    config: Navigator, state: NavigatorState, fix: complex, deviation: float, age: float, now: Now
) -> NavigatorState:
    """Correct by a fix, or refuse it.

    Args:
        config, state: of the navigator.
        fix: north + i east, m.
        deviation: its standard deviation, m.
        age: s.
        now: of the run.
    """
    c = config.assumed
    z, shown, P_z, P_ze, bottom, P_bottom, water, P_water, on_water, velocity, way, in_a_row, refused = state
    innovation = fix - (z - way_since(config.track, way, age, now))
    S = P_z + deviation * deviation
    if squared(modulus(innovation)) > c.gate * c.gate * S:
        refused, in_a_row = refused + 1, in_a_row + 1
        if in_a_row >= c.patience:
            P_z *= 2.0
    else:
        in_a_row = 0
        correction, error = P_z / S * innovation, P_ze.conjugate() / S * innovation
        known = squared(modulus(P_ze)) / S
        if on_water:
            water, P_water = water + error, P_water - known
        else:
            bottom, P_bottom = bottom + error, P_bottom - known
        P_ze *= 1.0 - P_z / S
        P_z *= 1.0 - P_z / S
        z += correction
        if c.blend > 0.0:
            shown -= correction
    return NavigatorState(
        z, shown, P_z, P_ze, bottom, P_bottom, water, P_water, on_water, velocity, way, in_a_row, refused
    )
