"""The pressure sensor."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.vehicle.diving.depth_sensor import DepthConfig, depth_sensor_of, measure_depth
from auv_sim.vehicle.draws import Draws, Now
from auv_sim.vehicle.noise import NoiseConfig

STEP = 0.05


def depths(config: DepthConfig, truth: list[float], seed: int = 5) -> list[float]:
    draws = Draws(STEP, len(truth))
    sensor, state = depth_sensor_of(config, (seed, 2), draws)
    memory, seen = draws.memory(), []
    for k, z in enumerate(truth):
        state = measure_depth(sensor, state, z, Now(memory, STEP * k, k), STEP if k else 0.0)
        seen.append(state.depth)
    return seen


def test_an_ideal_one_reports_the_depth() -> None:
    assert depths(DepthConfig(), [3.0, 4.0, 2.0]) == [3.0, 4.0, 2.0]


def test_noise_and_drift_have_their_deviations() -> None:
    seen = np.array(depths(DepthConfig(noise=NoiseConfig(white=0.05)), [10.0] * 20_000))
    assert (seen.mean(), seen.std()) == pytest.approx((10.0, 0.05), rel=0.03)
    slow = NoiseConfig(drift=0.05, drift_time=1.0)
    assert np.std(depths(DepthConfig(noise=slow), [10.0] * 20_000)) == pytest.approx(0.05, rel=0.1)


def test_offset_and_scale_are_those_of_a_run() -> None:
    noise = NoiseConfig(bias=0.1)
    offsets = [depths(DepthConfig(noise=noise), [10.0] * 2, seed) for seed in range(2000)]
    assert all(first == second for first, second in offsets)
    assert np.std(offsets) == pytest.approx(0.1, rel=0.05)
    scales = [depths(DepthConfig(scale=0.01), [10.0], seed)[0] for seed in range(2000)]
    assert np.std(scales) == pytest.approx(0.1, rel=0.05)


def test_it_lags_with_its_time_constant_and_starts_settled() -> None:
    seen = depths(DepthConfig(lag=0.5), [10.0] * 10 + [11.0] * 10)
    assert seen[:10] == [10.0] * 10
    assert seen[10:] == pytest.approx([11.0 - math.exp(-STEP * (k + 1) / 0.5) for k in range(10)])


def test_it_holds_its_value_between_measurements() -> None:
    assert depths(DepthConfig(rate=10.0), [1.0, 2.0, 3.0, 4.0, 5.0]) == [1.0, 1.0, 3.0, 3.0, 5.0]
