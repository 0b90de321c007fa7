"""Acoustic position fixes."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.vehicle.draws import Draws, Now, slot
from auv_sim.vehicle.position_fixes import FixConfig, fixes_of, measure_position

SEED = (5, 2)


def arrivals(config: FixConfig, steps: int, step: float = 0.05, speed: float = 1.0) -> list:
    """(step, x, y, lateness) of each fix that arrives while the vehicle goes north, `speed` m a step."""
    draws = Draws(step, steps)
    fixes, state = fixes_of(config, SEED, draws)
    memory, seen = draws.memory(), []
    for k in range(steps):
        now = Now(memory, step * k, k)
        first = state.first
        state = measure_position(fixes, state, speed * k, 0.0, now, step if k else 0.0)
        for number in range(first, state.first):
            due, x, y = memory.kept[slot(fixes.ring, number) :][:3]
            seen.append((k, x, y, now.time - due))
    return seen


def test_they_come_at_their_rate_and_late() -> None:
    seen = arrivals(FixConfig(rate=1.0, latency=0.5), 101)
    assert [k for k, *_ in seen] == [10, 30, 50, 70, 90]
    assert [x for _, x, _, _ in seen] == [0.0, 20.0, 40.0, 60.0, 80.0]
    assert [late for *_, late in seen] == pytest.approx([0.0] * 5, abs=1e-9)


def test_a_latency_between_two_steps_ends_with_the_later_one() -> None:
    seen = arrivals(FixConfig(rate=1.0, latency=0.52), 40)
    assert [k for k, *_ in seen] == [11, 31]
    assert [late for *_, late in seen] == pytest.approx([0.03, 0.03])


def test_without_a_rate_there_is_one_at_every_step() -> None:
    assert [k for k, *_ in arrivals(FixConfig(latency=0.2), 20)] == list(range(4, 20))


def test_a_share_of_the_fixes_is_false_by_tens_of_metres() -> None:
    off = np.array([math.hypot(x, y) for _, x, y, _ in arrivals(FixConfig(outliers=0.05), 20_000, 1.0, 0.0)])
    false = off > 0.0
    assert len(off) == 20_000
    assert false.mean() == pytest.approx(0.05, rel=0.1)
    assert 10.0 <= off[false].min() < 11.0
    assert 49.0 < off[false].max() <= 50.0
