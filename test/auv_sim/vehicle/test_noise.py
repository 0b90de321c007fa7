"""Noise, drift, gaps, beats and delays."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.noise import (
    DropoutConfig,
    NoiseConfig,
    delay_of,
    delayed,
    dropouts,
    dropouts_of,
    gauss_markov,
    gauss_markov_of,
    noise,
    noise_of,
    period_of,
    sampler,
)

SEED = (7, 1)


def process(deviation: float, time: float, steps: int, limit: float = math.inf) -> np.ndarray:
    """A Gauss-Markov process in steps of 0.1 s, its first value included."""
    draws = Draws(0.1, steps)
    config, value = gauss_markov_of(deviation, time, SEED, draws, limit)
    memory = draws.memory()
    values = [value]
    for _ in range(steps):
        values.append(value := gauss_markov(config, value, memory, 0.1))
    return np.array(values)


def errors(config: NoiseConfig, steps: Sequence[float], seed: tuple[int, int] = SEED) -> list[float]:
    draws = Draws(0.1, len(steps))
    made, drift = noise_of(config, seed, draws)
    memory, found = draws.memory(), []
    for dt in steps:
        drift, error = noise(made, drift, memory, dt)
        found.append(error)
    return found


def gaps(config: DropoutConfig, steps: int, dt: float) -> np.ndarray:
    draws = Draws(dt, steps)
    made, left = dropouts_of(config, SEED, draws)
    memory, silent, found = draws.memory(), False, []
    for _ in range(steps):
        silent, left = dropouts(made, silent, left, memory, dt)
        found.append(silent)
    return np.array(found)


def test_gauss_markov_has_its_deviation_and_forgets_in_its_time() -> None:
    values = process(0.3, 2.0, 200_000)
    assert values.std() == pytest.approx(0.3, rel=0.05)
    centred = values - values.mean()
    correlation = np.mean(centred[:-20] * centred[20:]) / np.mean(centred**2)  # 2 s apart
    assert correlation == pytest.approx(np.exp(-1.0), abs=0.05)


def test_it_is_as_large_at_the_first_moment_as_later() -> None:
    first = [gauss_markov_of(0.3, 1e9, (7, k), Draws(0.1, 1))[1] for k in range(4000)]
    assert np.std(first) == pytest.approx(0.3, rel=0.05)


def test_it_stays_within_its_limit() -> None:
    values = process(0.3, 1.0, 2000, limit=0.4)
    assert values.max() == 0.4
    assert values.min() == -0.4


def test_the_usual_step_is_prepared_and_gives_what_any_other_gives() -> None:
    values = []
    for usual in (0.1, 0.2):
        draws = Draws(usual, 1)
        config, value = gauss_markov_of(0.3, 2.0, SEED, draws)
        values.append(gauss_markov(config, value, draws.memory(), 0.1))
    assert values[0] == values[1]


def test_an_offset_is_drawn_once_for_a_run() -> None:
    config = NoiseConfig(bias=0.5)
    assert len(set(errors(config, [0.1] * 100))) == 1
    biases = [errors(config, [0.1], (7, k))[0] for k in range(4000)]
    assert np.std(biases) == pytest.approx(0.5, rel=0.05)


def test_white_noise_is_white() -> None:
    values = np.array(errors(NoiseConfig(white=0.2), [0.1] * 100_000))
    assert values.std() == pytest.approx(0.2, rel=0.02)
    assert abs(np.mean(values[:-1] * values[1:])) < 0.01 * 0.2**2 * 3.0


def test_without_errors_there_is_no_error() -> None:
    assert set(errors(NoiseConfig(), [0.1] * 10)) == {0.0}


@settings(max_examples=30)
@given(seed=st.integers(0, 2**31), steps=st.lists(st.floats(0.01, 1.0), min_size=1, max_size=20))
def test_a_seed_is_a_run(seed: int, steps: list[float]) -> None:
    config = NoiseConfig(white=1.0, bias=1.0, drift=1.0, drift_time=2.0)
    first = errors(config, steps, (seed, 0))
    assert errors(config, steps, (seed, 0)) == first
    assert errors(config, steps[:1], (seed, 1)) != first[:1]


def test_gaps_take_their_share_of_the_time() -> None:
    silent = gaps(DropoutConfig(every=8.0, length=2.0), 400_000, 0.1)
    assert silent.mean() == pytest.approx(0.2, abs=0.02)
    begins = np.count_nonzero(np.diff(silent.astype(int)) == 1)
    assert 40_000.0 / begins == pytest.approx(10.0, rel=0.1)


def test_without_gaps_it_never_falls_silent() -> None:
    assert not gaps(DropoutConfig(), 10, 1e6).any()


@pytest.mark.parametrize(("rate", "dt"), [(1.0, 0.05), (5.0, 0.05), (3.0, 0.05), (8.0, 0.1), (0.0, 0.05)])
def test_a_sampler_keeps_its_beat(rate: float, dt: float) -> None:
    steps, period = round(60.0 / dt), period_of(rate)
    until, first = sampler(period, 0.0, 0.0)
    assert first
    count = 0
    for _ in range(steps):
        until, due = sampler(period, until, dt)
        count += due
    assert count == pytest.approx(60.0 * rate if rate else steps, abs=1)


@pytest.mark.parametrize(
    ("latency", "expected"),
    [(0.1, [0, 0, 0, 1, 2, 3]), (0.08, [0, 0, 0, 1, 2, 3]), (0.0, [0, 1, 2, 3, 4, 5])],
)
def test_a_delay_hands_on_what_is_so_old(latency: float, expected: list[int]) -> None:
    draws = Draws(0.05, 1)
    draws.ring(5)
    delay = delay_of(latency, draws)
    kept, seen = draws.memory().kept, []
    for k in range(6):
        kept[delay.ring.begin + k % delay.ring.size] = float(k)
        seen.append(kept[delayed(delay, k)])
    assert seen == expected
