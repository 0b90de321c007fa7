"""How far an estimate may be off: the statistical part of the intervals, and the systematic one apart."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_sim.own_vehicle.identify.combinations import COUNT, Numbers
from auv_sim.own_vehicle.identify.innovations import Channels
from auv_sim.own_vehicle.identify.minimise import STEP, Minimised, free_unknowns, jacobian, weights_of
from auv_sim.own_vehicle.identify.motion_planes import Plane
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, HALF_PLAY, RATE, DataSheet, Scaling

#: Further steps of the servo's scaled unknowns.
_SERVO_STEPS = (-STEP, 30.0 * STEP, -30.0 * STEP)
#: Standard deviation of the dead time that the likelihood, which jumps from servo to servo, does not show, s.
#: Without it 20 of 26 intervals of five hulls with rudders of 8 to 200 deg/s held the true dead time.
_JUMPS = 1e-3
#: Of a 95 % interval, in standard deviations.
REACH = 1.96


class Covariances(NamedTuple):
    """Uncertainty of the physical unknowns.

    Attributes:
        classic: covariance by the curvature of the likelihood, (J'J)^-1.
        sandwich: covariance that allows for innovations correlated within blocks of 10 s.
        systematic: rows of what no data show, each one standard deviation: scale of the log, bias of the
            thrust, jumps of the likelihood over the dead time.
    """

    classic: Numbers
    sandwich: Numbers
    systematic: Numbers

    def statistical(self, gradient: Numbers) -> float:
        """Return the statistical standard deviation of a function with this gradient."""
        variances = [float(gradient @ part @ gradient) for part in (self.classic, self.sandwich)]
        return math.sqrt(max(*variances, 0.0))

    def unseen(self, gradient: Numbers) -> float:
        """Return the systematic standard deviation of a function with this gradient."""
        return float(np.linalg.norm(self.systematic @ gradient))

    def total(self, gradient: Numbers) -> float:
        """Return the standard deviation with both parts."""
        return float(np.hypot(self.statistical(gradient), self.unseen(gradient)))

    @property
    def deviations(self) -> Numbers:
        """Total standard deviation of each unknown, shape (22,)."""
        return np.array([self.total(row) for row in np.eye(ALL)])


def spread_of(
    channels: Channels, scaling: Scaling, estimate: Minimised, further: Numbers, bounded: int = 0
) -> Covariances:
    """Return the uncertainty of an estimate.

    Args:
        channels, scaling, estimate: the estimate.
        further: derivatives of the weighed innovations by numbers that were estimated beside the unknowns,
            (m, numbers).
        bounded: how many of them, the last ones, have unit variance before any data.
    """
    free = free_unknowns(scaling)
    weights = weights_of(channels, scaling, estimate)
    J = np.hstack((_slopes(channels, scaling, estimate, free, weights), further))
    places = np.arange(J.shape[1])
    before = np.diag((places < free.size) | (places >= J.shape[1] - bounded)).astype(float)
    bread = np.linalg.inv(J.T @ J + before)
    scores = np.zeros((int(channels.blocks.max()) + 1, J.shape[1]))
    np.add.at(scores, channels.blocks, J * estimate.residuals[:, None])
    meat = scores.T @ scores + before
    sandwich = (bread @ meat @ bread)[: free.size, : free.size]
    slopes = channels.plane.model_error * scaling.slopes(estimate.z)[:, free]
    physical = scaling.physical(estimate.z)
    return Covariances(
        slopes @ bread[: free.size, : free.size] @ slopes.T,
        slopes @ sandwich @ slopes.T,
        systematic_of(physical, scaling.sheet, channels.plane),
    )


def _slopes(
    channels: Channels, scaling: Scaling, estimate: Minimised, free: NDArray[np.int64], weights: Numbers
) -> Numbers:
    """Return the derivatives of the weighed innovations by the free unknowns, (m, free).

    A dead band makes the innovations jump where the servo changes a little. A difference across a jump claims
    far too much knowledge, so the least of several counts.
    """
    J = jacobian(channels, scaling, estimate.z, free, weights)
    places = np.flatnonzero(np.isin(free, (RATE, DEAD_TIME, HALF_PLAY)))
    for step in _SERVO_STEPS:
        other = jacobian(channels, scaling, estimate.z, free[places], weights, step)
        less = np.linalg.norm(other, axis=0) < np.linalg.norm(J[:, places], axis=0)
        J[:, places[less]] = other[:, less]
    return J


def systematic_of(physical: Numbers, sheet: DataSheet, plane: Plane) -> Numbers:
    """Return one standard deviation of each error that no data show, by the unknowns, shape (3, 22)."""
    found = np.zeros((3, ALL))
    found[0, :COUNT] = physical[:COUNT] * plane.scale_powers * sheet.log_scale
    if plane.has_thrust:
        found[1, 0] = physical[0] * sheet.thrust_bias
    found[2, DEAD_TIME] = _JUMPS
    return found


def gradient_of(function: Callable[[Numbers], float], physical: Numbers, spread: Covariances) -> Numbers:
    """Return the derivatives of a function of the physical unknowns, by central differences.

    The steps are a hundredth of the standard deviations.
    """
    steps = 0.01 * spread.deviations
    gradient = np.zeros(ALL)
    for k in np.flatnonzero(steps > 0.0):
        moved = np.zeros(ALL)
        moved[k] = steps[k]
        gradient[k] = (function(physical + moved) - function(physical - moved)) / (2.0 * steps[k])
    return gradient
