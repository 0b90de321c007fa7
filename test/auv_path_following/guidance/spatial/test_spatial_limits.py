"""How steeply and how slowly a vehicle may dive."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following import vehicle
from auv_path_following.guidance.spatial.spatial_limits import (
    Steepness,
    steepest_at,
    steepest_of,
)
from hulls import DIVER, PRINTED, REMUS, with_vertical

CRUISE_THRUST = 6.48


@pytest.mark.parametrize(("speed", "degrees"), [(1.0, 12.7), (1.5, 29.6), (1.6, 30.0)])
def test_the_remus_may_pitch_by_30_degrees_from_1_6_metres_per_second_up(speed, degrees) -> None:
    bound = steepest_at(steepest_of(DIVER, CRUISE_THRUST), speed)
    assert math.degrees(bound) == pytest.approx(degrees, abs=0.05)


@given(st.floats(0.0, 5.0), st.floats(0.0, 5.0))
def test_a_faster_vehicle_may_be_steeper(one: float, other: float) -> None:
    config = steepest_of(DIVER, CRUISE_THRUST)
    slow, fast = sorted((one, other))
    assert 0.0 <= steepest_at(config, slow) <= steepest_at(config, fast) <= config.largest


def test_buoyancy_takes_no_more_than_its_share_of_the_thrust() -> None:
    depth = dataclasses.replace(DIVER.depth, minimum_speed=1.5)
    light = dataclasses.replace(DIVER, hull=with_vertical(B=PRINTED.W + 9.0), depth=depth)
    bound = steepest_at(steepest_of(light, 3.86), 3.0)
    assert 9.0 * math.sin(bound) == pytest.approx(0.35 * 3.86)


def test_without_coefficients_only_the_file_bounds_the_pitch() -> None:
    config = steepest_of(REMUS, CRUISE_THRUST)
    assert config == Steepness(REMUS.depth.max_pitch, math.inf, 0.5 * math.pi, 0.0)
    assert steepest_at(config, 0.1) == REMUS.depth.max_pitch


def test_a_measured_climb_bounds_the_pitch() -> None:
    measured = vehicle.load("mss_remus100")
    config = steepest_of(measured, 29.2)
    at_cruise = math.asin(min(0.6 * math.sin(math.radians(66.5)), 1.0))
    assert steepest_at(config, measured.cruise.speed) == pytest.approx(min(at_cruise, config.largest))
    assert math.sin(steepest_at(config, 1.0)) == pytest.approx(math.sin(at_cruise) / 2.165**2, rel=1e-3)
