"""Search for a better servo near an estimate: its dead band makes the likelihood jagged, with many minima.

Whether a servo at rest answers a command depends on its angle, so a change of rate, dead time or dead band
moves it in jumps that no derivative shows. Here servos are drawn; for each the other unknowns follow by their
derivatives, which costs one run of the filter. The best ones are minimised in full.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.innovations import Channels, innovations_of
from auv_sim.own_vehicle.identify.minimise import (
    Minimised,
    free_unknowns,
    jacobian,
    minimise,
    weights_of,
)
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, HALF_PLAY, RATE, Scaling

#: Servos that are drawn in a round, and of them those that are minimised; rounds at most.
_DRAWN, _TRIED, _ROUNDS = 120, 2, 3
#: Standard deviations of the draws: logarithm of the rate, dead time (s), logarithms of play and dead band.
_SPREAD = np.array([0.003, 0.004, 0.4, 0.3])
#: Shares of these deviations, drawn in turn.
_SHARES = (1.0, 0.3, 2.5)
#: A round that lowers the cost by less ends the search.
_LEAST = 1.0


class _Servo(NamedTuple):
    """A servo that is tried: scaled unknowns with it, its dead band, and the cost predicted for it."""

    z: Numbers
    dead_band: float
    cost: float


def search_servo(
    channels: Channels, scaling: Scaling, estimate: Minimised, is_band_known: bool, seed: int = 0
) -> tuple[Channels, Minimised]:
    """Return the best estimate near another one.

    Args:
        channels: the recordings, with the estimate's dead band.
        scaling: of the unknowns.
        estimate: where the search begins.
        is_band_known: whether the dead band stays.
        seed: of the draws.
    """
    generator = np.random.default_rng(seed)
    best = channels, estimate
    for _ in range(_ROUNDS):
        before = best[1].cost
        for servo in _promising(*best, scaling, is_band_known, generator):
            own = channels._replace(dead_band=servo.dead_band)
            found = minimise(own, scaling, servo.z, rounds=3, first=best[1].deviations)
            if found.cost < best[1].cost:
                best = own, found
        if best[1].cost > before - _LEAST:
            break
    return best


def _promising(
    channels: Channels,
    estimate: Minimised,
    scaling: Scaling,
    is_band_known: bool,
    generator: np.random.Generator,
) -> list[_Servo]:
    """Return the servos that promise the lowest cost, the other unknowns following by their derivatives."""
    free = free_unknowns(scaling)
    others = free[~np.isin(free, (RATE, DEAD_TIME, HALF_PLAY))]
    weights = weights_of(channels, scaling, estimate)
    J = np.vstack((jacobian(channels, scaling, estimate.z, others, weights), np.eye(others.size)))
    Q, R = np.linalg.qr(J)
    drawn = _drawn(channels.dead_band, scaling, estimate, is_band_known, generator)
    runs = innovations_of([(channels._replace(dead_band=band), scaling.physical(z)) for z, band in drawn])
    found = []
    for (z, band), errors in zip(drawn, runs, strict=True):
        residuals = np.append(errors * weights, z[others])
        along = Q.T @ residuals
        moved = z.copy()
        moved[others] -= np.linalg.solve(R, along)
        found.append(_Servo(moved, band, float(residuals @ residuals - along @ along)))
    return sorted(found, key=lambda servo: servo.cost)[:_TRIED]


def _drawn(
    dead_band: float,
    scaling: Scaling,
    estimate: Minimised,
    is_band_known: bool,
    generator: np.random.Generator,
) -> list[tuple[NDArray[np.float64], float]]:
    """Return scaled unknowns with other servos, and their dead bands (rad)."""
    found = []
    for k in range(_DRAWN):
        rate, late, play, band = _SHARES[k % len(_SHARES)] * _SPREAD * generator.normal(size=4)
        physical = scaling.physical(estimate.z)
        physical[RATE] *= np.exp(rate)
        physical[DEAD_TIME] = max(physical[DEAD_TIME] + late, 0.0)
        physical[HALF_PLAY] *= np.exp(play)
        found.append((scaling.scaled(physical), dead_band if is_band_known else dead_band * np.exp(band)))
    return found
