"""Fits the yaw rate of a vehicle whose file has a measured turn and cruise, but no hull.

In lengths L travelled, with rho = r L / ur, the yaw of any hull of this kind goes roughly by

    d rho / ds = B delta + P rho - C rho |rho|,  s = integral of ur / L dt,

and the steady turn with full rudder, rho_m = L / radius, ties C to B and P. B (effect of the rudder) and P
(stability, positive for a hull that does not hold its course) are not in the file: a range of both is tried,
which holds torpedoes from 1.3 to 6 m of turning radius with and without a stable course. What is left to
judge is the sign, the order of the scale, a rudder that is much too slow, and a long dead time.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.fits import STEP, WAYS, Fit, servo
from auv_sim.checks.vehicle_check.samples import Array

_EFFECT = np.array([0.7, 1.0, 1.4, 2.0, 2.8, 4.0])
_STABILITY = np.array([-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0])
_DELAYS = np.arange(0.0, 1.501, 0.05)
#: The file counts as right unless another explanation leaves less than this share of what it leaves
#: unexplained; and the share that the model leaves in any case.
_CLEARLY, _BEYOND = 0.5, 0.01
#: Gains and shares of the file's rate with which nothing is wrong.
_GAINS, _LEAST_RATE = (0.7, 1.4), 0.55
#: The shortest dead time counts that leaves at most this multiple of the least, plus this share.
_AS_GOOD, _NEARLY = 1.5, 0.003


def fit_turning(t: Array, rudder: Array, speed: Array, times: Array, rates: Array, vehicle: Vehicle) -> Fit:
    """Fit the yaw rate to the rudder's commands.

    Args:
        t: times of the commands, s, in steps of `STEP`; shape (n,).
        rudder: commanded angle, rad; shape (n,).
        speed: through the water, m/s; shape (n,).
        times, rates: of the measured yaw rate, rad/s, positive to port; shape (m,).
        vehicle: its length, rudder, and measured or derived turn.

    Returns:
        The explanation that is nearest to the file: the file's rate before another, the shortest dead time.
    """
    low, high = _GAINS
    fits = [
        fit
        for fit in _fits(t, rudder, speed, times, rates, vehicle)
        if fit.scale == 1.0 or low < abs(fit.gain) < high
    ]
    likely = min(fits, key=lambda fit: fit.unexplained)
    as_filed = [
        fit
        for fit in fits
        if fit.scale == 1.0 and low < abs(fit.gain) < high and fit.rate > _LEAST_RATE
        if _CLEARLY * fit.unexplained < likely.unexplained + _BEYOND
    ]
    nearest = min(as_filed, key=lambda fit: abs(math.log(fit.rate)), default=likely)
    alike = [fit for fit in as_filed or fits if (fit.scale, fit.rate) == (nearest.scale, nearest.rate)]
    enough = _AS_GOOD * min(fit.unexplained for fit in alike) + _NEARLY
    return min((fit for fit in alike if fit.unexplained <= enough), key=lambda fit: fit.delay)


def _fits(
    t: Array, rudder: Array, speed: Array, times: Array, rates: Array, vehicle: Vehicle
) -> Iterator[Fit]:
    """Yield the best fit of each way and dead time, over all hulls."""
    servos = np.array([servo(way.scale * rudder, vehicle, way.rate) for way in WAYS])
    models = _yaw_rates(servos, np.maximum(speed, 0.0), vehicle)
    power = float(rates @ rates) or 1e-12
    for delay in _DELAYS:
        rows = np.clip(np.searchsorted(t, times - delay + 1e-9) - 1, 0, t.size - 1)
        expected = models[rows]
        own = np.maximum(np.einsum("twh,twh->wh", expected, expected), 1e-12)
        along = np.einsum("t,twh->wh", rates, expected)
        rest = 1.0 - along**2 / own / power
        for way, row, gains in zip(WAYS, rest, along / own, strict=True):
            k = int(np.argmin(row))
            yield Fit(float(gains[k]), way.rate, float(delay), float(row[k]), way.scale)


def _yaw_rates(servos: Array, speed: Array, vehicle: Vehicle) -> Array:
    """Return the yaw rate, rad/s, of every hull for every rudder; shape (n, rudders, hulls)."""
    steepest = vehicle.length / tightest_turn(vehicle).radius
    effect, stability = (grid.ravel() for grid in np.meshgrid(_EFFECT, _STABILITY, indexing="ij"))
    turning = effect * vehicle.rudder.max_angle
    damping = (turning + stability * steepest) / steepest**2
    possible = damping > 0.1 * turning / steepest**2
    effect, stability, damping = effect[possible], stability[possible], damping[possible]
    rho = np.zeros((len(servos), effect.size))
    rates = np.empty((speed.size, *rho.shape))
    for k, ur in enumerate(speed):
        rates[k] = rho * ur / vehicle.length
        change = effect * servos[:, k, None] + stability * rho - damping * rho * np.abs(rho)
        rho = rho + change * ur * STEP / vehicle.length
    return rates
