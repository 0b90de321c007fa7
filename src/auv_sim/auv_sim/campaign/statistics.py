"""How sure one can be of what a campaign shows: intervals of 95 %, and what each parameter explains."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Column = npt.NDArray[np.float64]

_Z = 1.959963984540054  # of 95 %
_RESAMPLES = 400
#: Resampled at most so many runs at a time: beyond, the normal law of order statistics serves as well.
_MOST_RESAMPLED = 5000


class Estimate(NamedTuple):
    """A value and its 95 % confidence interval; NaN where there is nothing to estimate from."""

    value: float
    low: float
    high: float


NOTHING = Estimate(math.nan, math.nan, math.nan)


def share(successes: int, runs: int) -> Estimate:
    """A share of successes with Wilson's interval, which is right at 0 and 1, too."""
    if not runs:
        return NOTHING
    p = successes / runs
    middle = (p + _Z * _Z / (2 * runs)) / (1.0 + _Z * _Z / runs)
    half = _Z / (1.0 + _Z * _Z / runs) * math.sqrt(p * (1.0 - p) / runs + _Z * _Z / (4 * runs * runs))
    # At the ends the formula is exact but for rounding.
    return Estimate(p, 0.0 if successes == 0 else middle - half, 1.0 if successes == runs else middle + half)


def mean(values: Column) -> Estimate:
    """The mean of the known values with the interval of the central limit."""
    known = values[np.isfinite(values)]
    if not known.size:
        return NOTHING
    centre = float(known.mean())
    half = _Z * float(known.std(ddof=1)) / math.sqrt(known.size) if known.size > 1 else math.nan
    return Estimate(centre, centre - half, centre + half)


def quantile(values: Column, at: float, seed: int) -> Estimate:
    """A quantile of the known values with the interval of a seeded bootstrap.

    With many values the interval is that between order statistics, which is where the bootstrap tends to.
    """
    known = np.sort(values[np.isfinite(values)])
    if not known.size:
        return NOTHING
    value = float(np.quantile(known, at))
    if known.size > _MOST_RESAMPLED:
        half = _Z * math.sqrt(at * (1.0 - at) / known.size)
        low, high = np.quantile(known, [max(at - half, 0.0), min(at + half, 1.0)])
    else:
        draws = np.random.default_rng([seed, known.size]).integers(known.size, size=(_RESAMPLES, known.size))
        low, high = np.quantile(np.quantile(known[draws], at, axis=1), [0.025, 0.975])
    return Estimate(value, float(low), float(high))


def explained(parameter: Column, figure: Column, bins: int = 20) -> float:
    """Share of a figure's variance that one parameter explains by itself: its first-order Sobol index.

    Variance of the means in bins of equally many runs, less what chance alone puts there; taken over the
    ranks of the figure, so that a few far outliers do not decide.

    Args:
        parameter, figure: shape (n,); rows that are not finite are left out.
        bins: fewer are taken where there are fewer than ten runs for each.
    """
    known = np.isfinite(parameter) & np.isfinite(figure)
    x, y = parameter[known], _ranks(figure[known])
    bins = min(bins, len(x) // 10, len(np.unique(x)))
    if bins < 2 or not y.std() > 0.0:
        return math.nan
    levels, owner = np.unique(x, return_inverse=True)
    if len(levels) > bins:
        owner = np.minimum(_ranks(x).astype(np.int64) * bins // len(x), bins - 1)
    counts = np.bincount(owner)
    sums, squares = np.bincount(owner, y), np.bincount(owner, y * y)
    used = counts > 1
    counts, sums, squares = counts[used], sums[used], squares[used]
    between = float(np.sum(sums * sums / counts)) - float(y.sum()) ** 2 / len(y)
    within = float(np.sum(squares - sums * sums / counts)) / max(len(y) - len(counts), 1)
    return max((between - (len(counts) - 1) * within) / (float(y.var()) * len(y)), 0.0)


def _ranks(values: Column) -> Column:
    """0 for the smallest; equal values get the mean of their ranks."""
    _, owner, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts) - 1.0
    ranks: Column = (last - 0.5 * (counts - 1.0))[owner]
    return ranks
