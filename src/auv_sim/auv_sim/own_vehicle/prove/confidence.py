"""Bounds at a confidence, exact and without an assumption on the distribution."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt
from scipy.special import bdtr, betaincinv

#: Confidence of every bound, and the share of flights that the distance is for.
CONFIDENCE, SHARE = 0.95, 0.99


def most_of(values: npt.NDArray[np.float64], share: float = SHARE, confidence: float = CONFIDENCE) -> float:
    """Return what a share of all flights does not exceed, at a confidence: an order statistic.

    The k-th smallest of n independent values exceeds the quantile with the probability that fewer than k of
    them lie below it, which is binomial. Returns infinity where n is too small for any k.

    Args:
        values: one of each flight; NaN counts as infinite.
        share, confidence: from 0 to 1.
    """
    known = np.sort(np.where(np.isnan(values), math.inf, values))
    n = len(known)
    k = np.arange(1, n + 1)
    enough = np.flatnonzero(bdtr(k - 1, n, share) >= confidence)
    return float(known[enough[0]]) if enough.size else math.inf


def flights_needed(share: float = SHARE, confidence: float = CONFIDENCE) -> int:
    """Return the fewest flights from which `most_of` has a bound: 1 - share^n must reach the confidence."""
    return math.ceil(math.log(1.0 - confidence) / math.log(share))


def largest_share(events: int, flights: int, confidence: float = CONFIDENCE) -> float:
    """Return the upper bound of the share of flights with an event, one-sided (Clopper and Pearson).

    Args:
        events: flights with it.
        flights: all.
        confidence: from 0 to 1.
    """
    if events >= flights:
        return 1.0
    return float(betaincinv(events + 1, flights - events, confidence))
