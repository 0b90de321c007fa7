"""Statistics of a campaign: 95 % intervals, and the variance that each parameter explains.

With grids, all points of a round share what is drawn: their flights succeed and fail together, and say no
more about the draws than one flight does. So figures of all points count rounds, not flights.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.special import stdtrit

Column = npt.NDArray[np.float64]
Rounds = npt.NDArray[np.int64]

_Z = 1.959963984540054  # of 95 %
_RESAMPLES = 400
#: Most values that are resampled: beyond, the normal law of order statistics serves as well.
_MOST_RESAMPLED = 5000
#: Least rounds in a bin, and least bins of a parameter with more values than that, for the share that it
#: explains: with fewer, chance and the width of the bins decide.
_ROUNDS_OF_BIN, _FEWEST_BINS = 10, 4


class Estimate(NamedTuple):
    """A value and its 95 % confidence interval; NaN where there is nothing to estimate from."""

    value: float
    low: float
    high: float


NOTHING = Estimate(math.nan, math.nan, math.nan)


def share(successes: float, runs: int) -> Estimate:
    """Return a share of successes among independent runs with Wilson's interval, valid at 0 and 1, too."""
    if not runs:
        return NOTHING
    p = successes / runs
    middle = (p + _Z * _Z / (2 * runs)) / (1.0 + _Z * _Z / runs)
    half = _Z / (1.0 + _Z * _Z / runs) * math.sqrt(p * (1.0 - p) / runs + _Z * _Z / (4 * runs * runs))
    # At the ends the formula is exact but for rounding.
    return Estimate(p, 0.0 if successes == 0 else middle - half, 1.0 if successes == runs else middle + half)


def share_of_rounds(successes: npt.NDArray[np.bool_], rounds: Rounds) -> Estimate:
    """Return the share of successes where the flights of a round share their draws.

    The interval is that of as many flights as there are rounds: right if the flights of a round end alike,
    and wider than needed if they do not.

    Args:
        successes: of each flight, shape (n,).
        rounds: which round each belongs to, shape (n,).
    """
    independent = len(np.unique(rounds))
    if not independent:
        return NOTHING
    return share(int(successes.sum()) * independent / len(successes), independent)


def mean(values: Column, rounds: Rounds | None = None) -> Estimate:
    """Return the mean of the finite values with Student's interval.

    Args:
        values: shape (n,).
        rounds: which round each belongs to; None where each is independent of all others.
    """
    known = np.isfinite(values)
    if not known.any():
        return NOTHING
    centre = float(values[known].mean())
    half = _half_width(values[known] - centre, None if rounds is None else rounds[known])
    return Estimate(centre, centre - half, centre + half)


def _half_width(deviations: Column, rounds: Rounds | None) -> float:
    """Return half of the interval of a mean, from deviations; NaN for fewer than two rounds."""
    sums = (
        deviations if rounds is None else np.bincount(np.unique(rounds, return_inverse=True)[1], deviations)
    )
    if len(sums) < 2:
        return math.nan
    error = math.sqrt(len(sums) / (len(sums) - 1) * float(np.sum(sums * sums))) / len(deviations)
    return float(stdtrit(len(sums) - 1, 0.975)) * error


def quantile(values: Column, at: float, seed: int, rounds: Rounds | None = None) -> Estimate:
    """Return a quantile of the finite values with the interval of a seeded bootstrap.

    With many values the interval is that between order statistics, which is where the bootstrap tends to;
    with rounds as well (Woodruff, 1952): the share of values below the quantile has the interval of a mean.

    Args:
        values: shape (n,).
        at: which quantile, 0 to 1.
        seed: of the bootstrap.
        rounds: which round each belongs to; None where each is independent of all others.
    """
    finite = np.isfinite(values)
    known = np.sort(values[finite])
    if not known.size:
        return NOTHING
    value = float(np.quantile(known, at))
    if rounds is None and known.size <= _MOST_RESAMPLED:
        draws = np.random.default_rng([seed, known.size]).integers(known.size, size=(_RESAMPLES, known.size))
        low, high = np.quantile(np.quantile(known[draws], at, axis=1), [0.025, 0.975])
        return Estimate(value, float(low), float(high))
    if rounds is None:
        half = _Z * math.sqrt(at * (1.0 - at) / known.size)
    else:
        below = (values[finite] <= value).astype(np.float64)
        half = _half_width(below - below.mean(), rounds[finite])
    if math.isnan(half):
        return Estimate(value, math.nan, math.nan)
    low, high = np.quantile(known, [max(at - half, 0.0), min(at + half, 1.0)])
    return Estimate(value, float(low), float(high))


def explained(parameter: Column, figure: Column) -> float:
    """Return the share of a figure's variance that a drawn parameter explains alone (first-order Sobol).

    Variance of the means in bins of equally many rounds, less what chance alone puts there; taken over the
    ranks of the figure, so that a few far outliers do not decide. With grids a round counts by the mean over
    its points.

    Args:
        parameter: of each round, shape (rounds,).
        figure: shape (rounds,), or (rounds, points) with grids; what is not finite is left out.

    Returns:
        The share; NaN with too few rounds.
    """
    y = _ranked(figure.reshape(len(parameter), -1))
    total = float(np.nanvar(y)) if np.isfinite(y).any() else 0.0
    of_rounds = _means(y - _means(y, axis=0), axis=1)  # whether a point is missing must not count
    known = np.isfinite(parameter) & np.isfinite(of_rounds)
    x, y = parameter[known], of_rounds[known]
    levels, owner = np.unique(x, return_inverse=True)
    bins = min(20, len(x) // _ROUNDS_OF_BIN)
    if len(levels) < 2 or bins < min(len(levels), _FEWEST_BINS) or not total > 0.0:
        return math.nan
    if len(levels) > bins:
        owner = np.minimum(_ranks(x).astype(np.int64) * bins // len(x), bins - 1)
    counts = np.bincount(owner)
    sums, squares = np.bincount(owner, y), np.bincount(owner, y * y)
    used = counts > 1
    counts, sums, squares = counts[used], sums[used], squares[used]
    between = float(np.sum(sums * sums / counts)) - float(y.sum()) ** 2 / len(y)
    within = float(np.sum(squares - sums * sums / counts)) / max(len(y) - len(counts), 1)
    return max((between - (len(counts) - 1) * within) / (total * len(y)), 0.0)


def explained_by_grid(parameter: Column, figure: Column) -> float:
    """Return that share for a parameter on a grid, whose values all meet the same draws.

    Variance of the means at its values, less what chance puts there: how differently the rounds take the step
    from one value to the next. A single round has no chance in it.

    Args:
        parameter: of each point, shape (points,).
        figure: shape (rounds, points); what is not finite is left out.
    """
    ranks = _ranked(figure)
    total = float(np.nanvar(ranks)) if np.isfinite(ranks).any() else 0.0
    levels = np.unique(parameter)
    y: Column = np.column_stack([_means(ranks[:, parameter == level], axis=1) for level in levels])
    y = y[:, np.isfinite(y).any(axis=0)]
    y = y[np.isfinite(y).any(axis=1)]
    if y.shape[1] < 2 or not total > 0.0:
        return math.nan
    effects = _means(y, axis=0)
    rounds, values = len(y), len(effects)
    left = y - effects
    left -= _means(left, axis=1)[:, None]
    known = int(np.isfinite(y).sum())
    chance = float(np.nansum(left * left)) / max(known - rounds - values + 1, 1)
    variance = float(effects.var()) - (values - 1) * chance / known
    return max(variance / total, 0.0)


def _means(values: Column, axis: int) -> Column:
    """Return means of the finite values; NaN where there is none."""
    known = np.isfinite(values)
    counts = known.sum(axis=axis)
    sums = np.where(known, values, 0.0).sum(axis=axis)
    means: Column = np.divide(sums, counts, out=np.full(counts.shape, math.nan), where=counts > 0)
    return means


def _ranked(figure: Column) -> Column:
    """Replace the finite values by their ranks, the others by NaN."""
    ranks = np.full(figure.shape, math.nan)
    known = np.isfinite(figure)
    ranks[known] = _ranks(figure[known])
    return ranks


def _ranks(values: Column) -> Column:
    """Return ranks, 0 for the smallest; equal values get the mean of their ranks."""
    _, owner, counts = np.unique(values, return_inverse=True, return_counts=True)
    last = np.cumsum(counts) - 1.0
    ranks: Column = (last - 0.5 * (counts - 1.0))[owner]
    return ranks
