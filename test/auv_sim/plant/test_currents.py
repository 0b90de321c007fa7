"""Water that moves."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.plant.currents import CurrentConfig, Jet, Shear, Tide, Variation, WaterCurrent


def water(**parts: object) -> WaterCurrent:
    return WaterCurrent(CurrentConfig(**parts), (3, 0))


def test_by_default_the_water_rests() -> None:
    assert tuple(water().update(10.0, 20.0, 5.0)) == (0.0, 0.0)


def test_it_varies_round_its_mean() -> None:
    current = water(mean=(0.1, 0.2), variation=Variation(deviation=0.05, time=10.0))
    flow = np.array([current.update(0.0, 0.0, 1.0) for _ in range(50_000)])
    assert flow.mean(axis=0) == pytest.approx([0.1, 0.2], abs=0.005)
    assert flow.std(axis=0) == pytest.approx([0.05, 0.05], rel=0.05)
    assert abs(np.corrcoef(flow.T)[0, 1]) < 0.05
    current.reset()
    assert tuple(current.update(0.0, 0.0, 1.0)) == tuple(flow[0])


def test_a_shear_grows_to_starboard_of_its_line() -> None:
    flow = water(shear=Shear(gradient=0.01, course_deg=90.0, point=(5.0, 0.0), limit=0.3))
    assert tuple(flow.at(5.0, 77.0)) == pytest.approx((0.0, 0.0))
    assert tuple(flow.at(-5.0, 0.0)) == pytest.approx((0.0, 0.1))  # ten metres south of an eastward line
    assert tuple(flow.at(15.0, 0.0)) == pytest.approx((0.0, -0.1))
    assert tuple(flow.at(-500.0, 0.0)) == pytest.approx((0.0, 0.3))


def test_a_jet_is_fastest_on_its_axis() -> None:
    flow = water(jet=Jet(speed=0.4, width=20.0, course_deg=0.0, point=(0.0, 10.0)))
    assert tuple(flow.at(123.0, 10.0)) == pytest.approx((0.4, 0.0))
    share = 0.4 / math.cosh(1.0) ** 2
    assert flow.at(0.0, 30.0).Vx == pytest.approx(share)
    assert flow.at(0.0, -10.0).Vx == pytest.approx(share)
    assert flow.at(0.0, 1e9).Vx == pytest.approx(0.0)


@pytest.mark.parametrize(("minor", "turns"), [(0.1, 1.0), (-0.1, -1.0)])
def test_the_tide_runs_round_its_ellipse(minor: float, turns: float) -> None:
    flow = water(tide=Tide(major=0.3, minor=minor, course_deg=30.0, period=100.0))
    flow.update(0.0, 0.0, 0.0)
    first = np.array(flow.at(0.0, 0.0))
    axis = np.array([math.cos(math.radians(30.0)), math.sin(math.radians(30.0))])
    assert first == pytest.approx(0.3 * axis)
    quarter = np.array(flow.update(0.0, 0.0, 25.0))
    assert quarter == pytest.approx(minor * np.array([-axis[1], axis[0]]))
    # Clockwise, seen from above with x north, is a positive turn.
    assert np.sign(first[0] * quarter[1] - first[1] * quarter[0]) == turns
    assert np.array(flow.update(0.0, 0.0, 75.0)) == pytest.approx(first)


def test_parts_add_up() -> None:
    both = water(mean=(0.1, 0.0), jet=Jet(speed=0.2, width=10.0))
    assert tuple(both.at(0.0, 0.0)) == pytest.approx((0.3, 0.0))
