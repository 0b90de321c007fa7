"""Bounds at a confidence, against scipy and against chance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binom, binomtest

from auv_sim.own_vehicle.prove.confidence import flights_needed, largest_share, most_of


@given(st.integers(1, 3000), st.data(), st.sampled_from([0.9, 0.95, 0.99]))
def test_the_share_is_that_of_clopper_and_pearson(flights: int, data, confidence: float) -> None:
    events = data.draw(st.integers(0, flights))
    exact = binomtest(events, flights, alternative="less").proportion_ci(confidence, "exact").high
    assert largest_share(events, flights, confidence) == pytest.approx(exact, abs=1e-9)


@given(st.integers(1, 2000), st.sampled_from([0.9, 0.99]), st.sampled_from([0.9, 0.95]))
def test_the_order_statistic_is_the_first_that_is_sure_enough(
    n: int, share: float, confidence: float
) -> None:
    k = most_of(np.arange(1.0, n + 1.0), share, confidence)
    if math.isinf(k):
        assert binom.cdf(n - 1, n, share) < confidence
    else:
        assert binom.cdf(k - 1, n, share) >= confidence > binom.cdf(k - 2, n, share)


def test_fewer_than_299_flights_bound_nothing() -> None:
    assert flights_needed() == 299
    assert math.isinf(most_of(np.ones(298)))
    assert most_of(np.ones(299)) == 1.0


def test_flights_that_are_lost_are_infinitely_far() -> None:
    values = np.linspace(0.0, 1.0, 1000)
    values[:30] = np.nan
    assert math.isinf(most_of(values))


def test_it_covers_as_often_as_it_says() -> None:
    """The bound of 500 exponential numbers lies above their true quantile in at least 95 % of the cases."""
    random = np.random.default_rng(5)
    bounds = [most_of(random.exponential(size=500)) for _ in range(400)]
    assert np.mean(np.array(bounds) >= -math.log(0.01)) > 0.93
