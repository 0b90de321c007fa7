"""Depth of the bottom."""

from __future__ import annotations

import math

import pytest

from auv_sim.vehicle.diving.bottom import BottomConfig, BottomWaves, bottom_at, bottom_of
from auv_sim.vehicle.draws import Draws


def depth(config: BottomConfig, x: float, y: float) -> float:
    return bottom_at(bottom_of(config, Draws(0.1, 1)), x, y)


def test_by_default_there_is_none() -> None:
    assert depth(BottomConfig(), 3.0, 4.0) == math.inf


def test_a_level_one_is_equally_deep_everywhere() -> None:
    assert depth(BottomConfig(depth=30.0), 1e4, -1e4) == 30.0


@pytest.mark.parametrize(("x", "y", "expected"), [(5.0, 20.0, 30.0), (5.0, 70.0, 35.0), (99.0, -30.0, 25.0)])
def test_a_slope_goes_down_along_its_course_from_its_point(x: float, y: float, expected: float) -> None:
    config = BottomConfig(depth=30.0, slope=0.1, course_deg=90.0, point=(5.0, 20.0))
    assert depth(config, x, y) == pytest.approx(expected)


def test_waves_have_their_amplitude_and_length() -> None:
    config = BottomConfig(depth=30.0, waves=BottomWaves(amplitude=4.0, length=150.0, phase_deg=90.0))
    seen = [depth(config, 37.5 * k, 7.0) for k in range(5)]
    assert seen == pytest.approx([34.0, 30.0, 26.0, 30.0, 34.0])


def test_a_table_is_added() -> None:
    config = BottomConfig(depth=30.0, slope=0.01, table=((0.0, 0.0), (60.0, 8.0), (100.0, -2.0)))
    assert [depth(config, x, 0.0) for x in (-10.0, 30.0, 60.0, 200.0)] == pytest.approx(
        [29.9, 34.3, 38.6, 30.0]
    )
