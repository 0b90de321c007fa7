"""Noise, drift, gaps, beats and delays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_sim.plant.noise import Delay, DropoutConfig, Dropouts, GaussMarkov, Noise, NoiseConfig, Sampler

SEED = (7, 1)


def test_gauss_markov_has_its_deviation_and_forgets_in_its_time() -> None:
    process = GaussMarkov(0.3, 2.0, SEED)
    values = np.array([process.update(0.1) for _ in range(200_000)])
    assert values.std() == pytest.approx(0.3, rel=0.05)
    centred = values - values.mean()
    correlation = np.mean(centred[:-20] * centred[20:]) / np.mean(centred**2)  # 2 s apart
    assert correlation == pytest.approx(np.exp(-1.0), abs=0.05)


def test_it_is_as_large_at_the_first_moment_as_later() -> None:
    first = [GaussMarkov(0.3, 1e9, (7, k)).value for k in range(4000)]
    assert np.std(first) == pytest.approx(0.3, rel=0.05)


def test_it_stays_within_its_limit() -> None:
    process = GaussMarkov(0.3, 1.0, SEED, limit=0.4)
    values = [process.update(0.1) for _ in range(2000)]
    assert max(values) == 0.4
    assert min(values) == -0.4


def test_an_offset_is_drawn_once_for_a_run() -> None:
    config = NoiseConfig(bias=0.5)
    noise = Noise(config, SEED)
    assert len({noise.update(0.1) for _ in range(100)}) == 1
    assert np.std([Noise(config, (7, k)).bias for k in range(4000)]) == pytest.approx(0.5, rel=0.05)


def test_white_noise_is_white() -> None:
    noise = Noise(NoiseConfig(white=0.2), SEED)
    values = np.array([noise.update(0.1) for _ in range(100_000)])
    assert values.std() == pytest.approx(0.2, rel=0.02)
    assert abs(np.mean(values[:-1] * values[1:])) < 0.01 * 0.2**2 * 3.0


def test_without_errors_there_is_no_error() -> None:
    noise = Noise(NoiseConfig(), SEED)
    assert {noise.update(0.1) for _ in range(10)} == {0.0}


@settings(deadline=None, max_examples=30)
@given(seed=st.integers(0, 2**31), steps=st.lists(st.floats(0.01, 1.0), min_size=1, max_size=20))
def test_a_seed_is_a_run_and_a_reset_begins_it_again(seed: int, steps: list[float]) -> None:
    config = NoiseConfig(white=1.0, bias=1.0, drift=1.0, drift_time=2.0)
    noise = Noise(config, (seed, 0))
    first = [noise.update(dt) for dt in steps]
    noise.reset()
    assert [noise.update(dt) for dt in steps] == first
    other = Noise(config, (seed, 0))
    assert [other.update(dt) for dt in steps] == first
    assert [Noise(config, (seed, 1)).update(dt) for dt in steps[:1]] != first[:1]


def test_gaps_take_their_share_of_the_time() -> None:
    gaps = Dropouts(DropoutConfig(every=8.0, length=2.0), SEED)
    silent = np.array([gaps.update(0.1) for _ in range(400_000)])
    assert silent.mean() == pytest.approx(0.2, abs=0.02)
    begins = np.count_nonzero(np.diff(silent.astype(int)) == 1)
    assert 40_000.0 / begins == pytest.approx(10.0, rel=0.1)


def test_without_gaps_it_never_falls_silent() -> None:
    gaps = Dropouts(DropoutConfig(), SEED)
    assert not any(gaps.update(1e6) for _ in range(10))


@pytest.mark.parametrize(("rate", "dt"), [(1.0, 0.05), (5.0, 0.05), (3.0, 0.05), (8.0, 0.1)])
def test_a_sampler_keeps_its_beat(rate: float, dt: float) -> None:
    sampler = Sampler(rate)
    steps = round(60.0 / dt)
    assert sampler.update(0.0)
    assert sum(sampler.update(dt) for _ in range(steps)) == pytest.approx(60.0 * rate, abs=1)


def test_without_a_rate_it_measures_at_every_step() -> None:
    sampler = Sampler(0.0)
    assert all(sampler.update(0.05) for _ in range(10))


def test_a_delay_hands_on_what_is_so_old() -> None:
    delay: Delay[int] = Delay(0.1)
    assert [delay.update(k, 0.05) for k in range(6)] == [0, 0, 0, 1, 2, 3]
    assert [Delay[int](0.0).update(4, 0.05)] == [4]
