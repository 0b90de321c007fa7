"""The Doppler logs."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.vehicle.draws import Draws, Now
from auv_sim.vehicle.noise import DropoutConfig
from auv_sim.vehicle.velocity_log import VelocityConfig, log_of, measure_velocity

SEED = (5, 2)
STEP = 0.05


def reported(config: VelocityConfig, truth: list[float], seed: tuple[int, int] = SEED) -> list:
    """(u, lock) at each step for a true velocity ahead; the first at once."""
    draws = Draws(STEP, len(truth))
    log, state = log_of(config, seed, draws)
    memory, seen = draws.memory(), []
    for k, u in enumerate(truth):
        now = Now(memory, STEP * k, k)
        state, lock = measure_velocity(log, state, u, 0.0, now, STEP if k else 0.0)
        seen.append((state.u, lock))
    return seen


def test_it_has_a_scale_and_holds_its_value_between_measurements() -> None:
    held = [u for u, _ in reported(VelocityConfig(scale=0.01, rate=5.0), [1.0 + 0.1 * k for k in range(40)])]
    assert len(set(held)) == 10
    scales = [reported(VelocityConfig(scale=0.01), [1.0], (5, k))[0][0] for k in range(4000)]
    assert np.std(scales) == pytest.approx(0.01, rel=0.05)
    assert held[0] != 1.0


def test_one_that_is_late_reports_what_was() -> None:
    late = reported(VelocityConfig(latency=0.1), [float(k) for k in range(5)])
    assert [u for u, _ in late] == [0.0, 0.0, 0.0, 1.0, 2.0]


def test_a_silent_one_says_so_and_repeats_itself() -> None:
    gaps = VelocityConfig(dropouts=DropoutConfig(every=2.0, length=2.0))
    seen = reported(gaps, [float(k) for k in range(2000)])
    held = [k for k in range(1, 2000) if seen[k][0] == seen[k - 1][0]]
    assert held == [k for k in range(1, 2000) if not seen[k][1]]
    assert 0.3 < len(held) / 2000 < 0.7
    assert reported(VelocityConfig(lock=False), [1.0]) == [(1.0, False)]
