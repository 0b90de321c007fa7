"""Intervals against textbook values and by coverage; explained variance where its index is known."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.studies.campaign.evaluation import statistics


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


def flights(generator: np.random.Generator, rounds: int, points: int) -> tuple[np.ndarray, np.ndarray]:
    """A figure, half of its variance the round's and a quarter the point's; and each flight's round."""
    shared, grid = generator.normal(size=(rounds, 1)), np.linspace(-1.0, 1.0, points)
    figure = math.sqrt(2.0) * shared + grid / grid.std() + generator.normal(size=(rounds, points))
    return figure, np.repeat(np.arange(rounds), points)


def test_intervals_over_grids_cover_the_truth_as_often_as_they_say() -> None:
    generator = np.random.default_rng(6)
    many, _ = flights(generator, 40000, 16)
    middle, most = np.quantile(many, [0.5, 0.95])
    good = np.mean(many < 2.0)
    covered = []
    for _ in range(300):
        figure, rounds = flights(generator, 40, 16)
        values = figure.ravel()
        covered.append(
            [
                low <= truth <= high
                for truth, (_, low, high) in (
                    (0.0, statistics.mean(values, rounds)),
                    (middle, statistics.quantile(values, 0.5, 1, rounds)),
                    (most, statistics.quantile(values, 0.95, 1, rounds)),
                    (good, statistics.share_of_rounds(values < 2.0, rounds)),
                )
            ]
        )
    mean, median, largest, share = np.mean(covered, axis=0)
    assert 0.91 <= mean <= 0.98 and 0.90 <= median <= 0.98 and 0.88 <= largest <= 0.98
    assert share >= 0.95  # wider than needed, as the points do not end alike
    alike = [np.repeat(generator.random(40) < 0.8, 16) for _ in range(300)]
    shares = [statistics.share_of_rounds(successes, rounds) for successes in alike]
    assert 0.91 <= np.mean([low <= 0.8 <= high for _, low, high in shares]) <= 0.98


def test_rounds_of_one_flight_are_flights() -> None:
    values = np.random.default_rng(1).lognormal(size=200)
    values[::7] = math.nan
    alone = np.arange(200)
    assert statistics.mean(values, alone) == pytest.approx(statistics.mean(values))
    assert statistics.share_of_rounds(values > 1.0, alone) == statistics.share(int((values > 1.0).sum()), 200)
    with_rounds, bootstrapped = (statistics.quantile(values, 0.5, 1, r) for r in (alone, None))
    assert with_rounds == pytest.approx(bootstrapped, abs=0.1)


def test_one_round_has_no_interval() -> None:
    values, rounds = np.arange(20.0), np.zeros(20, dtype=np.int64)
    for value, low, high in (statistics.mean(values, rounds), statistics.quantile(values, 0.5, 1, rounds)):
        assert value == 9.5 and math.isnan(low) and math.isnan(high)
    assert statistics.share_of_rounds(values < 10.0, rounds)[1:] == statistics.share(0.5, 1)[1:]


def test_what_is_explained_beside_grids() -> None:
    generator = np.random.default_rng(4)
    # 20 starts, each at 64 points, and a parameter without effect: nothing can be told, least of all 99.6 %.
    figure, _ = flights(generator, 20, 64)
    assert math.isnan(statistics.explained(generator.random(20), figure))
    idle, all_of_it, part = [], [], []
    for _ in range(40):
        figure, _ = flights(generator, 100, 16)
        shared = figure.mean(axis=1)
        idle.append(statistics.explained(generator.random(100), figure))
        all_of_it.append(statistics.explained(shared, figure))
        part.append(statistics.explained_by_grid(np.arange(16.0), figure))
    assert np.mean(idle) < 0.03 and max(idle) < 0.2
    assert np.mean(all_of_it) == pytest.approx(0.5, abs=0.06)
    assert np.mean(part) == pytest.approx(0.25, abs=0.04)


def test_a_grid_without_effect_explains_nothing() -> None:
    generator = np.random.default_rng(7)
    effect, other = np.repeat(np.arange(4.0), 4), np.tile(np.arange(4.0), 4)
    found = []
    for _ in range(60):
        figure = effect + generator.normal(size=(20, 1)) + generator.normal(size=(20, 16))
        found.append(statistics.explained_by_grid(other, figure))
    assert max(found) < 0.02 < 0.3 < statistics.explained_by_grid(effect, figure)


def test_points_that_never_arrive_do_not_tell_of_the_draws() -> None:
    generator = np.random.default_rng(8)
    figure, _ = flights(generator, 200, 4)
    idle = generator.random(200)
    # Half of the rounds never arrive at the worst point: their means are lower, and it is the point's doing.
    figure[idle > 0.5, 3] = math.nan
    assert statistics.explained(idle, figure) < 0.05
    assert statistics.explained_by_grid(np.arange(4.0), figure) == pytest.approx(0.2, abs=0.08)
    figure[:, 3] = math.nan
    assert statistics.explained_by_grid(np.arange(4.0), figure) > 0.1
    assert math.isnan(statistics.explained_by_grid(np.arange(4.0), np.full((200, 4), math.nan)))


def test_a_grid_without_draws_is_exact() -> None:
    figure = np.array([[1.0, 2.0, 3.0, 4.0]])
    assert statistics.explained_by_grid(np.array([0.0, 0.0, 1.0, 1.0]), figure) == pytest.approx(0.8)
    assert statistics.explained_by_grid(np.array([0.0, 1.0, 0.0, 1.0]), figure) == pytest.approx(0.2)
