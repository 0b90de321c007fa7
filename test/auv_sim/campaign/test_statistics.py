"""Intervals against textbook values and by coverage; explained variance where its index is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.campaign import statistics


def test_wilson_against_the_textbook() -> None:
    # Newcombe (1998), Table I, method 3.
    assert statistics.share(81, 263)[1:] == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert statistics.share(15, 148)[1:] == pytest.approx((0.0624, 0.1605), abs=5e-5)
    assert statistics.share(0, 20)[1:] == pytest.approx((0.0, 0.1611), abs=5e-5)
    assert statistics.share(1, 29)[1:] == pytest.approx((0.0061, 0.1718), abs=5e-5)


@given(st.integers(1, 5000), st.data())
def test_an_interval_holds_its_share(runs: int, data: st.DataObject) -> None:
    successes = data.draw(st.integers(0, runs))
    value, low, high = statistics.share(successes, runs)
    assert 0.0 <= low <= value <= high <= 1.0
    other = statistics.share(runs - successes, runs)
    assert (other.low, other.high) == pytest.approx((1.0 - high, 1.0 - low))


def test_intervals_cover_the_truth_as_often_as_they_say() -> None:
    generator = np.random.default_rng(5)
    for estimate, truth in (
        (statistics.mean, math.exp(0.5)),
        (lambda x: statistics.quantile(x, 0.5, 1), 1.0),
        (lambda x: statistics.quantile(x, 0.95, 1), math.exp(1.6448536269514722)),
    ):
        trials = [estimate(generator.lognormal(size=300)) for _ in range(200)]
        covered = np.mean([low <= truth <= high for _, low, high in trials])
        assert 0.87 <= covered <= 0.99


def test_the_interval_of_many_values_goes_on_where_the_bootstrap_ends() -> None:
    values = np.random.default_rng(1).normal(size=5001)
    few, many = statistics.quantile(values[:5000], 0.95, 1), statistics.quantile(values, 0.95, 1)
    assert many == pytest.approx(few, abs=0.03)


def test_nothing_is_estimated_from_nothing() -> None:
    empty = np.array([math.nan])
    assert all(map(math.isnan, statistics.share(0, 0)))
    assert all(map(math.isnan, statistics.mean(empty)))
    assert all(map(math.isnan, statistics.quantile(empty, 0.5, 0)))
    assert math.isnan(statistics.explained(empty, empty))


def test_what_is_explained() -> None:
    generator = np.random.default_rng(2)
    x, y, z = generator.random((3, 20000))
    assert statistics.explained(x, x) == pytest.approx(1.0, abs=0.01)
    assert statistics.explained(z, x) == pytest.approx(0.0, abs=0.01)
    assert statistics.explained(x, x + y) == pytest.approx(0.5, abs=0.02)
    # A dip in the middle has no slope, and is seen all the same.
    assert statistics.explained(x, np.abs(x - 0.5)) > 0.95
    # A grid of few values, one of them an outlier by far.
    grid = np.repeat([0.0, 1.0, 50.0], 300)
    assert statistics.explained(grid, grid + 0.01 * y[:900]) == pytest.approx(0.9, abs=0.11)
    assert math.isnan(statistics.explained(np.ones(100), y[:100]))
