"""From command to response of the stern planes: sign, scale, rate limit and dead time.

The pitch rate q of a hull with planes goes by

    dq/dt = -b (u/U)^2 delta + P u q - C q |q| - K sin(theta) + D u w.

The file gives b, the effect of the planes at top speed U. P, C, K and D are fitted together with a factor of
b, in integrated form, so that noise is not differentiated. What changes slowly (buoyancy, trim, turns) is
taken off all signals. That leaves the pulses of the small test, or the corrections of a mission under way.
"""

from __future__ import annotations

import math

import numpy as np

from auv_path_following.control.hull_model import rudder_effect
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.dive.dive_motion import DiveMotion, of_water
from auv_sim.checks.vehicle_check.items.fits import STEP, WAYS, Fit, best, servo
from auv_sim.checks.vehicle_check.items.response import held
from auv_sim.checks.vehicle_check.samples import Array, Recording, mean_over

#: Least commanded angle, rad rms, and speed at which planes act as they do at cruise, m/s.
_LEAST_PLANES, _LEAST_SPEED = math.radians(1.5), 0.4
_DELAYS = np.arange(0.0, 0.851, 0.05)
#: Time over which what changes slowly is taken off, s.
_SLOW = 3.0
#: An explanation as good as the best leaves at most this times as much unexplained, plus this share.
_AS_GOOD, _BEYOND = 1.25, 0.01


def commanded(recording: Recording) -> tuple[Array, Array]:
    """Return times in steps of `STEP` (s), and commanded angles (rad); both of shape (n,)."""
    commands = recording.sternplane_cmd
    if len(commands) < 2:
        return np.empty(0), np.empty(0)
    t = np.arange(commands[0].received, commands[-1].received, STEP)
    return t, held(commands, t)


def enough(planes: Array) -> bool:
    """Return whether the commands move the planes."""
    return bool(planes.size) and float(np.sqrt(np.mean(planes**2))) > _LEAST_PLANES


def fit_planes_state(recording: Recording, t: Array, planes: Array, vehicle: Vehicle) -> Fit | None:
    """Fit sternplane_state to the commands; None without it."""
    samples = [
        s for s in recording.sternplane_state if math.isfinite(s.value) and t[0] <= s.received <= t[-1]
    ]
    if len(samples) < 20:
        return None
    times, values = np.array([s.received for s in samples]), np.array([s.value for s in samples])
    if float(np.abs(values).max()) < 1e-4:
        return Fit(0.0, 1.0, 0.0, 1.0)
    side = pitch_plane_of(vehicle)
    return best(t, {way: servo(way.scale * planes, side, way.rate) for way in WAYS}, times, values)


def fit_pitching(
    recording: Recording, dive: DiveMotion, t: Array, planes: Array, vehicle: Vehicle
) -> Fit | None:
    """Fit the pitch rate to the commands; a gain of 1 is the contract's sign and the file's effect.

    Returns:
        The fit; None where the vehicle was too slow for too long.
    """
    u, _, w = of_water(recording, dive, dive.t, 0.2)
    under_way = (dive.t >= t[0]) & (dive.t <= t[-1] + 1.0) & (u > _LEAST_SPEED)
    if under_way.sum() < 40:
        return None
    side = pitch_plane_of(vehicle)
    times, q, pitch = dive.t, dive.down * dive.pitch_rate, dive.down * dive.pitch
    effect = rudder_effect(side) * (u / vehicle.top_speed) ** 2
    terms = [u * q, q * np.abs(q), np.sin(pitch)]
    if np.isfinite(w).all():
        terms.append(u * dive.down * w)

    def quick(values: Array) -> Array:
        rest: Array = (values - mean_over(times, values, times, _SLOW))[under_way]
        return rest

    others = np.array([quick(_integral(times, term)) for term in terms]).T
    basis, _ = np.linalg.qr(others)
    turning = _without(basis, quick(q))
    power = float(turning @ turning) or 1e-12
    fits = []
    for way in WAYS:
        angles = servo(way.scale * planes, side, way.rate)
        for delay in _DELAYS:
            angle = np.interp(times - delay, t, angles, left=0.0)
            model = _without(basis, quick(_integral(times, -effect * angle)))
            own = float(model @ model)
            if own > 1e-9:
                gain = float(model @ turning) / own
                rest = 1.0 - gain * float(model @ turning) / power
                fits.append(Fit(gain, way.rate, float(delay), rest, way.scale))
    return _likely(fits)


def _integral(t: Array, values: Array) -> Array:
    return np.concatenate(([0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(t))))


def _without(basis: Array, values: Array) -> Array:
    rest: Array = values - basis @ (basis.T @ values)
    return rest


def _likely(fits: list[Fit]) -> Fit | None:
    """Return the explanation nearest to the file among those that are as good as the best."""
    if not fits:
        return None
    least = min(fit.unexplained for fit in fits)
    alike = [fit for fit in fits if fit.unexplained <= _AS_GOOD * least + _BEYOND]

    def distance(fit: Fit) -> tuple[float, float]:
        gain = abs(math.log(max(abs(fit.gain), 1e-3)))
        return abs(math.log(fit.scale)), gain + abs(math.log(fit.rate)) + fit.delay

    return min(alike, key=distance)
