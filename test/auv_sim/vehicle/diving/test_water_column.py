"""Currents over depth and the vertical one."""

from __future__ import annotations

import numpy as np
import pytest

from auv_msgs_py.values.types import SpatialCurrent
from auv_sim.vehicle.currents import CurrentConfig, Upwelling, Variation, flow, vary, water_of
from auv_sim.vehicle.diving.water_column import flow_at_depth, vary_column, water_column_of
from auv_sim.vehicle.draws import Draws

SEED = (3, 0)


class Column:
    """The water of a run in steps of 1 s."""

    def __init__(self, steps: int = 1, **parts: object) -> None:
        draws = Draws(1.0, steps)
        self.config, self.state = water_column_of(CurrentConfig(**parts), SEED, draws)  # type: ignore[arg-type]
        self.memory, self.time = draws.memory(), 0.0

    def at(self, z: float) -> SpatialCurrent:
        return flow_at_depth(self.config, self.state, 0.0, 0.0, z, self.time)

    def update(self, dt: float, z: float = 10.0) -> SpatialCurrent:
        self.time += dt
        self.state = vary_column(self.config, self.state, self.memory, dt)
        return self.at(z)


def test_by_default_the_water_rests() -> None:
    assert Column().update(5.0) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("speed", [0.05, -0.05])
def test_upwelling_lifts_and_down_is_positive_inside(speed: float) -> None:
    assert Column(upwelling=Upwelling(mean=speed)).at(10.0) == (0.0, 0.0, -speed)


def test_upwelling_varies_round_its_mean() -> None:
    water = Column(30_000, upwelling=Upwelling(mean=0.05, deviation=0.02, time=10.0, limit=0.05))
    down = np.array([water.update(1.0).Vz for _ in range(30_000)])
    assert (down.mean(), down.std()) == pytest.approx((-0.05, 0.02), abs=0.002)
    assert np.corrcoef(down[:-10], down[10:])[0, 1] == pytest.approx(np.exp(-1.0), abs=0.05)
    assert abs(down + 0.05).max() <= 0.05


def test_the_horizontal_current_has_a_factor_over_depth() -> None:
    water = Column(
        mean=(0.2, -0.1), upwelling=Upwelling(mean=0.03), over_depth=((5.0, 1.0), (15.0, 0.5), (25.0, -0.1))
    )
    assert water.at(0.0) == water.at(5.0) == pytest.approx((0.2, -0.1, -0.03))
    assert water.at(10.0) == pytest.approx((0.15, -0.075, -0.03))
    assert water.at(40.0) == pytest.approx((-0.02, 0.01, -0.03))


def test_a_schedule_has_a_vertical_part_too() -> None:
    water = Column(schedule=((0.0, 0.1, 0.0, 0.0), (10.0, 0.1, 0.0, 0.2)))
    assert water.update(5.0) == pytest.approx((0.1, 0.0, 0.1))
    assert water.update(50.0) == pytest.approx((0.1, 0.0, 0.2))


def test_upwelling_leaves_the_horizontal_current_of_a_seed_as_it_is() -> None:
    variation = Variation(deviation=0.05, time=10.0)
    water = Column(50, variation=variation, upwelling=Upwelling(deviation=0.02))
    draws = Draws(1.0, 50)
    config, north, east = water_of(CurrentConfig(variation=variation), SEED, draws)
    memory = draws.memory()
    for k in range(50):
        north, east = vary(config, north, east, memory, 1.0)
        assert water.update(1.0)[:2] == flow(config, north, east, 0.0, 0.0, k + 1.0)
