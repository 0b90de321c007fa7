"""How far the filter trusts its model: error of fin or pitch, growth of the variances, by likelihood."""

from __future__ import annotations

import math

import numpy as np

from auv_sim.own_vehicle.identify.innovations import ERROR_VARIANCE, FIRST_GROWTH, Channels, innovations_of
from auv_sim.own_vehicle.identify.minimise import Minimised, cost_of, minimise
from auv_sim.own_vehicle.identify.unknowns import Scaling

#: Deviations of the error of the fin, or of the measured pitch, that are tried, rad.
_ERRORS = tuple(math.radians(angle) for angle in (0.006, 0.012, 0.025, 0.05, 0.1, 0.2))
#: Factors on the growth of the variances of the states.
_FACTORS = (1.0, 10.0, 100.0, 1e3, 1e4, 1e5)
#: Rounds of choice and minimisation, and choices of each number in a round, at most.
_ROUNDS, _SWEEPS = 3, 3


def with_model_errors(
    channels: Channels, scaling: Scaling, estimate: Minimised
) -> tuple[Channels, Minimised]:
    """Return the estimate of the filter that predicts best, with its channels."""
    for _ in range(_ROUNDS):
        best = _best_filter(channels, scaling, estimate)
        if best.noise == channels.noise:
            break
        channels, estimate = best, minimise(best, scaling, estimate.z, first=estimate.deviations)
    return channels, estimate


def _best_filter(channels: Channels, scaling: Scaling, estimate: Minimised) -> Channels:
    """Return the filter with the lowest cost for given unknowns, one number chosen after the other."""
    physical = scaling.physical(estimate.z)
    groups: tuple[tuple[int, ...], ...] = ((), *channels.plane.alike)
    for _ in range(_SWEEPS):
        before = channels.noise
        for group in groups:
            filters = _alternatives(channels, group)
            runs = innovations_of([(own, physical) for own in filters])
            costs = [cost_of(errors, channels.rows, estimate.z) for errors in runs]
            channels = filters[int(np.argmin(costs))]
        if channels.noise == before:
            break
    return channels


def _alternatives(channels: Channels, group: tuple[int, ...]) -> list[Channels]:
    """Return filters that differ in the growth of a group of states; for an empty one in that error."""
    if not group:
        return [channels.with_noise(ERROR_VARIANCE, error**2) for error in _ERRORS]
    found = []
    for factor in _FACTORS:
        own = channels
        for state in group:
            own = own.with_noise(FIRST_GROWTH + state, factor * channels.plane.growth[state])
        found.append(own)
    return found
