"""The part of a recording that is left out of its identification."""

from __future__ import annotations

import numpy as np
import pytest

from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.verbs.left_out import LAST, divided, turning_part


def turning(begin: float, end: float, rate: float) -> PlanarData:
    """Return 300 s that turn between two times, with the noise of a gyro."""
    t = np.arange(0.0, 300.0, 0.05)
    r = np.where((t >= begin) & (t < end), rate, 0.0) + np.random.default_rng(0).normal(0.0, 1e-3, t.size)
    water, zeros = t[::4], np.zeros(t.size)
    u = np.ones(water.size)
    return PlanarData("r", t, r, water, u, 0.0 * u, t, zeros, t, zeros, zeros, zeros, zeros, zeros)


@pytest.mark.parametrize("rate", [0.2, -0.2])
def test_a_straight_at_the_end_is_not_what_the_model_is_judged_by(rate: float) -> None:
    data = turning(60.0, 180.0, rate)
    begin, end = turning_part(data)
    assert end - begin == pytest.approx(LAST)
    assert 60.0 < end <= 225.0
    used, left_out = divided([data], None)
    assert left_out is not None
    assert np.mean(left_out.r**2) >= np.mean(data.r**2)
    assert [round(part.t[-1] - part.t[0]) for part in used] == [round(begin), round(data.t[-1] - end)]


def test_the_last_part_is_left_out_where_it_turns() -> None:
    data = turning(100.0, 300.0, 0.2)
    assert turning_part(data)[1] == pytest.approx(data.t[-1])


def test_the_only_turn_of_a_recording_is_not_left_out_of_its_identification() -> None:
    for data in (turning(150.0, 165.0, 0.2), turning(150.0, 180.0, 0.2)):
        used, _ = divided([data], None)
        assert sum(np.sum(part.r**2) for part in used) > 0.4 * np.sum(data.r**2)
    again = turning(150.0, 165.0, 0.2)
    assert divided([again, data], None)[1] is not None  # the other recording turns as well
