"""Satellite fixes: at the surface only."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.vehicle.diving.surface_fixes import SurfaceFixConfig, measure_at_surface, surface_fixes_of
from auv_sim.vehicle.draws import Draws, Now, slot
from auv_sim.vehicle.noise import NoiseConfig

STEP = 0.5


def fixes(config: SurfaceFixConfig, depths: list[float]) -> list[tuple[int, float]]:
    """(step, north) of each fix of a vehicle that goes 1 m north in a step."""
    draws = Draws(STEP, len(depths))
    surface, state = surface_fixes_of(config, (5, 2), draws)
    memory, seen = draws.memory(), []
    for k, z in enumerate(depths):
        now, first = Now(memory, STEP * k, k), state.fixes.first
        state = measure_at_surface(surface, state, float(k), 0.0, z, now, STEP if k else 0.0)
        for number in range(first, state.fixes.first):
            seen.append((k, memory.kept[slot(surface.fixes.ring, number) + 1]))
    return seen


def test_there_are_fixes_only_while_the_antenna_is_out_of_the_water() -> None:
    depths = [0.0, 0.19, 0.2, 0.21, 5.0, 0.21, 0.2, 0.1]
    assert fixes(SurfaceFixConfig(), depths) == [(k, float(k)) for k in (0, 1, 2, 6, 7)]


def test_the_receiver_needs_its_time_after_surfacing() -> None:
    config = SurfaceFixConfig(acquisition=2.0, rate=1.0)
    assert [k for k, _ in fixes(config, [0.0] * 4 + [1.0] * 3 + [0.0] * 8)] == [0, 2, 10, 12, 14]


def test_they_have_noise() -> None:
    seen = np.array([x - k for k, x in fixes(SurfaceFixConfig(noise=NoiseConfig(white=1.5)), [0.0] * 5000)])
    assert (seen.mean(), seen.std()) == pytest.approx((0.0, 1.5), abs=0.08)


def test_a_vehicle_without_a_receiver_has_none() -> None:
    assert fixes(SurfaceFixConfig(fitted=False), [0.0] * 5) == []
