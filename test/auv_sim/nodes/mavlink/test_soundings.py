"""An echo sounder's DISTANCE_SENSOR and the range that it becomes."""

from __future__ import annotations

import math

import pytest
from pymavlink.dialects.v20 import common as mavlink

from auv_sim.nodes.mavlink.soundings import distance_sensor, sounding_of


def test_a_range_arrives_in_metres() -> None:
    sounding = sounding_of(distance_sensor(5_000, 12.344))
    assert sounding == pytest.approx((12.34, 0.3, 50.0))


@pytest.mark.parametrize(
    ("distance", "expected"), [(0.1, -math.inf), (50.0, math.inf), (math.inf, math.inf), (49.9, 49.9)]
)
def test_beyond_its_limits_it_is_infinite(distance: float, expected: float) -> None:
    sounding = sounding_of(distance_sensor(5_000, distance))
    assert sounding is not None
    assert sounding.range == pytest.approx(expected)


def test_an_invalid_signal_is_no_echo() -> None:
    message = distance_sensor(5_000, 12.0)
    message.signal_quality = 1
    sounding = sounding_of(message)
    assert sounding is not None
    assert sounding.range == math.inf


def test_only_a_sensor_that_looks_down_measures_the_altitude() -> None:
    message = distance_sensor(5_000, 12.0)
    message.orientation = mavlink.MAV_SENSOR_ROTATION_NONE
    assert sounding_of(message) is None


def test_a_sensor_without_limits_is_taken_at_its_word() -> None:
    message = distance_sensor(5_000, 12.0)
    message.min_distance = message.max_distance = 0
    assert sounding_of(message) == pytest.approx((12.0, 0.0, 0.0))
