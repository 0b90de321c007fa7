"""Prediction-error estimate: minimise the innovations, each channel over its own re-estimated deviation."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.innovations import Channels, innovations, many_innovations
from auv_sim.own_vehicle.identify.unknowns import ALL, LATENCY, TRIM, Scaling

#: Step of the finite differences of scaled unknowns.
STEP = 1e-4
#: A residual beyond this many deviations is weighed down (Huber).
_OUTLIER = 4.0
#: Deviations of r, u and v at first, before they are re-estimated.
_FIRST = (math.radians(0.1), 0.03, 0.03)


class Minimised(NamedTuple):
    """Result of a minimisation.

    Attributes:
        z: scaled unknowns.
        deviations: of the innovations of r (rad/s), u and v (m/s).
        cost: negative logarithm of the likelihood and the prior, without constants.
        misfit: the same without the prior.
        residuals: innovations over their deviations, (m,).
    """

    z: Numbers
    deviations: Numbers
    cost: float
    misfit: float
    residuals: Numbers


def free_unknowns(scaling: Scaling) -> NDArray[np.int64]:
    """Return the indices of the unknowns that are not fixed."""
    is_free = np.ones(ALL, bool)
    is_free[LATENCY], is_free[TRIM] = scaling.sheet.latency_deviation > 0.0, scaling.sheet.trim > 0.0
    return np.flatnonzero(is_free).astype(np.int64)


def deviations_of(errors: Numbers, rows: NDArray[np.int64]) -> Numbers:
    """Return the deviation of r, u and v, outliers weighed down, shape (3,)."""
    found = []
    for channel in range(3):
        own = np.abs(errors[rows == channel])
        limit = _OUTLIER * 1.4826 * max(float(np.median(own)), 1e-12)
        found.append(math.sqrt(float(np.mean(np.minimum(own, limit) ** 2))) + 1e-12)
    return np.array(found)


def _weights(errors: Numbers, deviations: Numbers, rows: NDArray[np.int64]) -> Numbers:
    """Return the factor on each innovation: 1 over its deviation, less for an outlier."""
    scaled = np.abs(errors) / deviations[rows]
    weights: Numbers = np.sqrt(np.minimum(1.0, _OUTLIER / np.maximum(scaled, 1e-12))) / deviations[rows]
    return weights


def weights_of(channels: Channels, scaling: Scaling, estimate: Minimised) -> Numbers:
    """Return the factor on each innovation of an estimate."""
    return _weights(innovations(channels, scaling.physical(estimate.z)), estimate.deviations, channels.rows)


def minimise(
    channels: Channels,
    scaling: Scaling,
    z: Numbers,
    rounds: int = 4,
    steps: int = 12,
    first: Numbers | None = None,
    progress: Callable[[], None] = lambda: None,
) -> Minimised:
    """Minimise from one start.

    Args:
        channels: the recordings.
        scaling: of the unknowns.
        z: the start.
        rounds: of re-estimating the deviations, at most.
        steps: of Gauss-Newton in each round, at most.
        first: deviations of the first round.
        progress: called after each round.
    """
    free, rows = free_unknowns(scaling), channels.rows
    deviations = np.array(_FIRST) if first is None else first
    errors = innovations(channels, scaling.physical(z))
    cost = math.inf
    for _ in range(rounds):
        weights = _weights(errors, deviations, rows)
        z = _round(channels, scaling, z, free, weights, steps)
        errors = innovations(channels, scaling.physical(z))
        deviations = deviations_of(errors, rows)
        before, cost = cost, cost_of(errors, rows, z)
        progress()
        if abs(before - cost) < 0.05:
            break
    misfit = cost - 0.5 * float(z @ z)
    return Minimised(z, deviations, cost, misfit, errors * _weights(errors, deviations, rows))


def cost_of(errors: Numbers, rows: NDArray[np.int64], z: Numbers) -> float:
    """Return the negative logarithm of likelihood and prior, each channel over its own deviation."""
    counts = np.bincount(rows, minlength=3)
    return float(counts @ np.log(deviations_of(errors, rows)) + 0.5 * z @ z)


def _round(
    channels: Channels, scaling: Scaling, z: Numbers, free: NDArray[np.int64], weights: Numbers, steps: int
) -> Numbers:
    """Minimise with fixed weights."""

    def complete(part: Numbers) -> Numbers:
        full = z.copy()
        full[free] = part
        return full

    def residuals(part: Numbers) -> Numbers:
        errors = innovations(channels, scaling.physical(complete(part)))
        return np.append(errors * weights, part)

    def slopes(part: Numbers) -> Numbers:
        return np.vstack((jacobian(channels, scaling, complete(part), free, weights), np.eye(free.size)))

    found = least_squares(residuals, z[free], slopes, method="lm", max_nfev=steps, xtol=1e-6, ftol=1e-7)
    return complete(found.x)


def jacobian(
    channels: Channels,
    scaling: Scaling,
    z: Numbers,
    free: NDArray[np.int64],
    weights: Numbers,
    step: float = STEP,
) -> Numbers:
    """Return the derivatives of the weighed innovations by the free unknowns, (m, free)."""
    sets = [scaling.physical(z)]
    for k in free:
        moved = z.copy()
        moved[k] += step
        sets.append(scaling.physical(moved))
    values = many_innovations(channels, sets)
    return (values[:, 1:] - values[:, :1]) / step * weights[:, None]
