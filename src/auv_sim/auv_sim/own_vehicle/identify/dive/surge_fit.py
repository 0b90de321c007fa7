"""Surge of a dive: the log's noise is averaged only in what a model fitted to the log leaves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from auv_sim.own_vehicle.identify.combinations import Numbers
from auv_sim.own_vehicle.identify.dive.vertical_motion import smoothed

#: Time over which what the model leaves is averaged, s: a drift of the thruster is slower.
SLOW = 4.0
#: A direction of the model that moves the surge by less than this share of the largest is left out.
_LEAST = 1e-4


class Surge(NamedTuple):
    """Surge through the water (m/s) and its rate (m/s^2), one number for each time."""

    u: Numbers
    rate: Numbers


def surge_of(t: Numbers, forces: Numbers, log_t: Numbers, log: Numbers) -> Surge:
    """Return the surge by a linear model of its rate, corrected by the log.

    The model is fitted to changes faster than `SLOW`. Slower ones, such as a drift of the thrust or the
    model's own errors, are those of the log.

    Args:
        t: times, s, shape (n,).
        forces: products of which the rate is a linear combination, shape (k, n).
        log_t, log: times (s) and samples of the measured surge, m/s.
    """
    steps = np.diff(t) * 0.5 * (forces[:, 1:] + forces[:, :-1])
    integrals = np.hstack((np.zeros((forces.shape[0], 1)), np.cumsum(steps, axis=1)))
    seen = np.array([np.interp(log_t, t, row) for row in integrals])
    fast = np.array([row - smoothed(log_t, row, SLOW) for row in seen])
    shares = np.linalg.lstsq(fast.T, log - smoothed(log_t, log, SLOW), rcond=_LEAST)[0]
    left = smoothed(log_t, log - shares @ seen, SLOW)
    change = np.interp(t, log_t, np.gradient(left, log_t))
    return Surge(shares @ integrals + np.interp(t, log_t, left), shares @ forces + change)
