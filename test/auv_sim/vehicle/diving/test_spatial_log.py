"""The Doppler log with a component down."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.vehicle.diving.spatial_log import measure_spatial_velocity, spatial_log_of
from auv_sim.vehicle.draws import Draws, Now
from auv_sim.vehicle.noise import DropoutConfig, NoiseConfig
from auv_sim.vehicle.velocity_log import VelocityConfig, log_of, measure_velocity

SEED, STEP = (5, 2), 0.05
EVERYTHING = VelocityConfig(
    noise=NoiseConfig(white=0.02, bias=0.01, drift=0.01), scale=0.01, rate=5.0, latency=0.1,
    dropouts=DropoutConfig(every=2.0, length=1.0),
)  # fmt: skip


def reported(config: VelocityConfig, truth: list, height: float = 0.0) -> list:
    """((u, v, w), lock) at each step."""
    draws = Draws(STEP, len(truth))
    log, state = spatial_log_of(config, SEED, draws)
    memory, seen = draws.memory(), []
    for k, velocity in enumerate(truth):
        now = Now(memory, STEP * k, k)
        state, lock = measure_spatial_velocity(log, state, velocity, height, now, STEP if k else 0.0)
        seen.append(((state.plane.u, state.plane.v, state.w), lock))
    return seen


def test_ahead_and_to_starboard_it_is_the_log_of_a_vehicle_in_the_plane() -> None:
    truth = [(1.0 + 0.01 * k, -0.01 * k, 0.02 * k) for k in range(400)]
    draws = Draws(STEP, len(truth))
    log, state = log_of(EVERYTHING, SEED, draws)
    memory = draws.memory()
    for k, (velocity, lock) in enumerate(reported(EVERYTHING, truth)):
        u, v, _ = truth[k]
        state, expected = measure_velocity(log, state, u, v, Now(memory, STEP * k, k), STEP if k else 0.0)
        assert (*velocity[:2], lock) == (state.u, state.v, expected)


def test_all_components_have_one_rate_one_delay_and_one_gap() -> None:
    config = VelocityConfig(rate=5.0, latency=0.1, dropouts=DropoutConfig(every=2.0, length=1.0))
    seen = reported(config, [(float(k), float(k), float(k)) for k in range(400)])
    assert all(u == v == w for (u, v, w), _ in seen)
    assert len({w for (_, _, w), _ in seen}) < 100
    assert reported(VelocityConfig(latency=0.1), [(k, k, float(k)) for k in range(5)])[-1][0][2] == 2.0


def test_down_has_noise_of_its_own() -> None:
    config = VelocityConfig(noise=NoiseConfig(white=0.02))
    u, _, w = np.array([each for each, _ in reported(config, [(1.0, 0.0, 0.3)] * 8000)]).T
    assert (w.mean(), w.std()) == pytest.approx((0.3, 0.02), rel=0.05)
    assert abs(np.corrcoef(u, w)[0, 1]) < 0.05


@pytest.mark.parametrize(("height", "lock"), [(0.0, True), (39.0, True), (41.0, False)])
def test_it_loses_the_bottom_above_its_largest_height(height: float, lock: bool) -> None:
    """A height of 0 stands for no bottom: the log keeps its lock as without this limit."""
    seen = reported(VelocityConfig(highest=40.0), [(1.0, 0.0, 0.0)] * 5, height)
    assert {found for _, found in seen} == {lock}
