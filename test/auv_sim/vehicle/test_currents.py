"""Water that moves."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_msgs_py.values.types import Current
from auv_sim.vehicle.currents import CurrentConfig, Jet, Shear, Tide, Variation, flow, vary, water_of
from auv_sim.vehicle.draws import Draws


class Flow:
    """The water of a run in steps of 1 s."""

    def __init__(self, steps: int = 1, **parts: object) -> None:
        draws = Draws(1.0, steps)
        self.config, self.north, self.east = water_of(CurrentConfig(**parts), (3, 0), draws)  # type: ignore[arg-type]
        self.memory, self.time = draws.memory(), 0.0

    def at(self, x: float, y: float) -> Current:
        return flow(self.config, self.north, self.east, x, y, self.time)

    def update(self, dt: float) -> Current:
        self.time += dt
        self.north, self.east = vary(self.config, self.north, self.east, self.memory, dt)
        return self.at(0.0, 0.0)


def test_by_default_the_water_rests() -> None:
    assert tuple(Flow().update(5.0)) == (0.0, 0.0)


def test_it_varies_round_its_mean() -> None:
    water = Flow(50_000, mean=(0.1, 0.2), variation=Variation(deviation=0.05, time=10.0))
    seen = np.array([water.update(1.0) for _ in range(50_000)])
    assert seen.mean(axis=0) == pytest.approx([0.1, 0.2], abs=0.005)
    assert seen.std(axis=0) == pytest.approx([0.05, 0.05], rel=0.05)
    assert abs(np.corrcoef(seen.T)[0, 1]) < 0.05


def test_a_shear_grows_to_starboard_of_its_line() -> None:
    water = Flow(shear=Shear(gradient=0.01, course_deg=90.0, point=(5.0, 0.0), limit=0.3))
    assert tuple(water.at(5.0, 77.0)) == pytest.approx((0.0, 0.0))
    assert tuple(water.at(-5.0, 0.0)) == pytest.approx((0.0, 0.1))  # ten metres south of an eastward line
    assert tuple(water.at(15.0, 0.0)) == pytest.approx((0.0, -0.1))
    assert tuple(water.at(-500.0, 0.0)) == pytest.approx((0.0, 0.3))


def test_a_jet_is_fastest_on_its_axis() -> None:
    water = Flow(jet=Jet(speed=0.4, width=20.0, course_deg=0.0, point=(0.0, 10.0)))
    assert tuple(water.at(123.0, 10.0)) == pytest.approx((0.4, 0.0))
    share = 0.4 / math.cosh(1.0) ** 2
    assert water.at(0.0, 30.0).Vx == pytest.approx(share)
    assert water.at(0.0, -10.0).Vx == pytest.approx(share)
    assert water.at(0.0, 1e9).Vx == pytest.approx(0.0)


@pytest.mark.parametrize(("minor", "turns"), [(0.1, 1.0), (-0.1, -1.0)])
def test_the_tide_runs_round_its_ellipse(minor: float, turns: float) -> None:
    water = Flow(tide=Tide(major=0.3, minor=minor, course_deg=30.0, period=100.0))
    water.update(0.0)
    first = np.array(water.at(0.0, 0.0))
    axis = np.array([math.cos(math.radians(30.0)), math.sin(math.radians(30.0))])
    assert first == pytest.approx(0.3 * axis)
    quarter = np.array(water.update(25.0))
    assert quarter == pytest.approx(minor * np.array([-axis[1], axis[0]]))
    # Clockwise, seen from above with x north, is a positive turn.
    assert np.sign(first[0] * quarter[1] - first[1] * quarter[0]) == turns
    assert np.array(water.update(75.0)) == pytest.approx(first)


def test_parts_add_up() -> None:
    both = Flow(mean=(0.1, 0.0), jet=Jet(speed=0.2, width=10.0))
    assert tuple(both.at(0.0, 0.0)) == pytest.approx((0.3, 0.0))


def test_a_schedule_is_linear_in_time_and_held_before_and_after() -> None:
    water = Flow(mean=(0.1, 0.0), schedule=((10.0, 0.0, 0.2, 0.0), (20.0, 0.4, 0.2, 0.1)))
    seen = {time: tuple(water.update(5.0)) for time in (5.0, 10.0, 15.0, 20.0, 25.0)}
    assert seen[5.0] == seen[10.0] == pytest.approx((0.1, 0.2))
    assert seen[15.0] == pytest.approx((0.3, 0.2))
    assert seen[20.0] == seen[25.0] == pytest.approx((0.5, 0.2))
