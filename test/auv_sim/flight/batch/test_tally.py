"""Time from which the yaw rate on a straight line counts as a limit cycle."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_path_following import config_files, vehicle
from auv_sim.flight.batch import tally
from auv_sim.own_vehicle.tune.trial_flights import line_time


@pytest.mark.parametrize("name", config_files.shipped("vehicles"))
def test_a_brisk_vehicle_is_calm_after_a_minute(name: str) -> None:
    assert tally.calm_time(vehicle.load(name)) == 60.0
    assert line_time(vehicle.load(name)) == 120.0


def test_a_slow_vehicle_has_longer_to_turn_in() -> None:
    """A hull of 5.3 m at 1.9 m/s still turns in after 60 s, which is no limit cycle."""
    remus = vehicle.load("remus100")
    slow = dataclasses.replace(remus, length=5.0, cruise=vehicle.Cruise(thrust=6.0, speed=2.0))
    assert tally.calm_time(slow) == pytest.approx(120.0)
    assert line_time(slow) == pytest.approx(240.0)


def test_the_yaw_rate_counts_from_there_on() -> None:
    whole, subpaths = np.zeros(tally.FLIGHT_TALLIES), np.zeros((1, tally.SUBPATH_TALLIES))
    tally.begin(whole, subpaths)
    for elapsed in (0.0, 60.0, 119.95, 120.0, 120.05):
        tally.count_steadiness(whole, elapsed, 120.0, 0.5, 0.1, False)
    assert whole[tally.CALM_ROWS] == 2.0
    assert math.sqrt(whole[tally.YAW_SQUARES] / 2.0) == pytest.approx(0.1)
    assert whole[tally.FREE_ROWS] == 5.0
