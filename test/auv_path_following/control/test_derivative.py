"""dr/dt behind a filter."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following.control.derivative import DerivativeConfig, DerivativeState, derivative
from laws import Stepped


def behind(bandwidth: float, values: list[float], dt: float) -> list[float]:
    law = Stepped(derivative, DerivativeConfig(bandwidth=bandwidth), DerivativeState())
    return [law.update(value, dt if k else 0.0) for k, value in enumerate(values)]


def test_without_a_filter_it_is_the_difference() -> None:
    assert behind(0.0, [1.0, 1.5, 0.5], 0.5) == [0.0, 1.0, -2.0]


@settings(max_examples=50)
@given(st.floats(0.5, 50.0), st.floats(0.01, 1.0), st.floats(-5.0, 5.0))
def test_it_finds_the_slope_of_a_straight_line(bandwidth: float, dt: float, slope: float) -> None:
    steps = math.ceil(30.0 / (bandwidth * dt)) + 1
    assert behind(bandwidth, [3.0 + slope * k * dt for k in range(steps)], dt)[-1] == pytest.approx(
        slope, abs=1e-6
    )


@pytest.mark.parametrize("bandwidth", [2.0, 5.0, 20.0])
def test_it_has_the_response_of_two_equal_lags(bandwidth: float) -> None:
    dt, omega = 0.001, 3.0
    values = behind(bandwidth, [math.sin(omega * k * dt) for k in range(20_000)], dt)
    response = 1j * omega / (1.0 + 1j * omega / bandwidth) ** 2
    for k in (19_000, 19_500, 19_999):
        expected = (response * cmath.exp(1j * omega * k * dt)).imag
        assert values[k] == pytest.approx(expected, abs=2e-3 * omega)


@pytest.mark.parametrize("bandwidth", [2.0, 4.0, 8.0])
def test_it_multiplies_white_noise_as_the_page_says(bandwidth: float) -> None:
    noise = np.random.default_rng(1).standard_normal(40_000).tolist()
    assert np.std(behind(0.0, noise, 0.05)) == pytest.approx(math.sqrt(2.0) / 0.05, rel=0.03)
    rule = 0.5 * math.sqrt(bandwidth**3 * 0.05)
    # The rule is that of a continuous signal; samples joined by straight lines are a little smoother.
    assert 0.75 * rule < np.std(behind(bandwidth, noise, 0.05)) < rule


@settings(max_examples=50)
@given(
    st.floats(0.01, 1000.0),
    st.lists(st.tuples(st.floats(-10.0, 10.0), st.floats(1e-4, 10.0)), min_size=1, max_size=50),
)
def test_no_step_makes_it_unstable(bandwidth: float, samples: list[tuple[float, float]]) -> None:
    law = Stepped(derivative, DerivativeConfig(bandwidth=bandwidth), DerivativeState())
    steepest, last = 0.0, None
    for value, dt in samples:
        rate = law.update(value, dt)
        if last is not None:
            steepest = max(steepest, abs(value - last) / dt)
        last = value
        assert abs(rate) <= steepest * (1.0 + 1e-9) + 1e-9


def test_a_reset_forgets() -> None:
    law = Stepped(derivative, DerivativeConfig(bandwidth=5.0), DerivativeState())
    for k in range(10):
        law.update(float(k), 0.1)
    law.reset()
    assert law.update(3.0, 0.1) == 0.0
    assert law.update(3.0, 0.1) == 0.0


def test_the_bandwidth_can_be_changed_in_flight_without_a_jump_of_the_rate() -> None:
    law = Stepped(derivative, DerivativeConfig(bandwidth=5.0), DerivativeState())
    rates = [law.update(0.1 * k, 0.05) for k in range(100)]
    law.config = DerivativeConfig(bandwidth=10.0)
    assert law.update(0.1 * 100, 0.05) == pytest.approx(rates[-1], rel=1e-6)
