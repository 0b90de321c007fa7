"""The altimeter against geometry."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.vehicle.diving.altimeter import AltimeterConfig, altimeter_of, measure_range, range_to
from auv_sim.vehicle.diving.bottom import BottomConfig, BottomWaves, bottom_at, bottom_of
from auv_sim.vehicle.draws import Draws, Now
from auv_sim.vehicle.hulls.rigid_body import body_at, to_world
from auv_sim.vehicle.noise import DropoutConfig, NoiseConfig

STEP = 0.05
tilts = st.floats(-0.6, 0.6)


def ranges(config: AltimeterConfig, heights: list[float]) -> list[float]:
    """Ranges at each step of a level vehicle above a level bottom."""
    draws = Draws(STEP, len(heights))
    altimeter, state = altimeter_of(config, (5, 2), draws)
    bottom = bottom_of(BottomConfig(depth=50.0), draws)
    memory, seen = draws.memory(), []
    for k, height in enumerate(heights):
        body = body_at(0.0, 0.0, 50.0 - height, 0.0, 0.0, 0.0, 1.0)
        state = measure_range(altimeter, state, bottom, body, Now(memory, STEP * k, k), STEP if k else 0.0)
        seen.append(state.last)
    return seen


@given(tilts, tilts, st.floats(-3.0, 3.0), st.floats(0.0, 29.0))
def test_the_range_is_the_height_over_the_cosines(phi: float, theta: float, psi: float, z: float) -> None:
    bottom = bottom_of(BottomConfig(depth=30.0), Draws(STEP, 1))
    found = range_to(bottom, body_at(0.0, 0.0, z, phi, theta, psi, 1.0), 1e3)
    assert found * math.cos(phi) * math.cos(theta) == pytest.approx(30.0 - z, abs=1e-9)


@given(tilts, tilts, st.floats(-3.0, 3.0), st.floats(0.0, 200.0))
def test_the_beam_ends_on_the_bottom(phi: float, theta: float, psi: float, x: float) -> None:
    waves = BottomWaves(amplitude=4.0, length=150.0)
    bottom = bottom_of(BottomConfig(depth=30.0, slope=0.05, waves=waves), Draws(STEP, 1))
    body = body_at(x, 5.0, 10.0, phi, theta, psi, 1.0)
    dx, dy, dz = to_world(body.qw, body.qi, body.qj, body.qk, 0.0, 0.0, range_to(bottom, body, 1e3))
    assert 10.0 + dz == pytest.approx(bottom_at(bottom, x + dx, 5.0 + dy), abs=1e-3)


def test_bow_up_it_looks_ahead() -> None:
    """Where the bottom rises ahead, a bow that is up shortens the height that it finds."""
    bottom = bottom_of(BottomConfig(depth=30.0, slope=-0.1), Draws(STEP, 1))
    up, down = (range_to(bottom, body_at(0.0, 0.0, 10.0, 0.0, s, 0.0, 1.0), 1e3) for s in (0.2, -0.2))
    assert up * math.cos(0.2) < 20.0 < down * math.cos(0.2)


def test_there_is_no_echo_out_of_range_or_from_a_vehicle_on_its_side() -> None:
    config = AltimeterConfig(nearest=1.0, farthest=20.0)
    assert ranges(config, [0.5, 1.0, 20.0, 20.5]) == [math.inf, 1.0, 20.0, math.inf]
    bottom = bottom_of(BottomConfig(depth=50.0), Draws(STEP, 1))
    assert range_to(bottom, body_at(0.0, 0.0, 1.0, 1.6, 0.0, 0.0, 1.0), 1e3) == math.inf
    none = bottom_of(BottomConfig(), Draws(STEP, 1))
    assert range_to(none, body_at(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), 1e3) == math.inf


def test_it_has_noise_and_a_rate() -> None:
    seen = np.array(ranges(AltimeterConfig(noise=NoiseConfig(white=0.1), rate=5.0), [10.0] * 8000))
    assert len(set(seen)) == 2000
    assert (seen.mean(), seen.std()) == pytest.approx((10.0, 0.1), rel=0.05)


def test_gaps_are_without_an_echo() -> None:
    gaps = DropoutConfig(every=3.0, length=1.0)
    seen = np.array(ranges(AltimeterConfig(dropouts=gaps), [10.0] * 20_000))
    assert np.isinf(seen).mean() == pytest.approx(0.25, abs=0.05)
    assert set(seen[np.isfinite(seen)]) == {10.0}


def test_a_vehicle_without_one_has_no_height() -> None:
    assert all(math.isnan(each) for each in ranges(AltimeterConfig(fitted=False), [10.0, 11.0]))
