"""Recordings between which the fin was set anew have a trim each; others share one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify.combinations import Numbers, prior_of
from auv_sim.own_vehicle.identify.innovations import Channels, channels_of
from auv_sim.own_vehicle.identify.intervals import spread_of
from auv_sim.own_vehicle.identify.minimise import minimise
from auv_sim.own_vehicle.identify.refine.own_trims import own_trim_columns, with_own_trims
from auv_sim.own_vehicle.identify.study.identified_cases import true_unknowns
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.time_grid import PlanarData
from auv_sim.own_vehicle.identify.unknowns import TRIM, DataSheet, Scaling
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file

REMUS, SEA = vehicle_file.load("remus100"), sea_file.load("moderate")
SCALING = Scaling(prior_of(REMUS.coefficients), DataSheet())
TRUE = true_unknowns(REMUS, SEA)


@pytest.fixture(scope="module")
def flights() -> list[PlanarData]:
    found = [planar_data(simulate(REMUS, SEA, program_file.load("two_minutes"), seed)) for seed in (1, 2)]
    return [data.between(data.t[0], data.t[0] + 60.0) for data in found]


def trimmed(flights: list[PlanarData], degrees: float) -> Channels:
    """Return both flights, the fin of the second standing `degrees` from its command."""
    second = flights[1]._replace(rudder=flights[1].rudder - math.radians(degrees))
    return channels_of([flights[0], second], SCALING.sheet, math.radians(SEA.rudder.dead_band_deg))


@pytest.mark.parametrize("degrees", [3.0, -3.0])
def test_a_fin_that_was_set_anew_has_a_trim_in_each_recording(
    flights: list[PlanarData], degrees: float
) -> None:
    channels = trimmed(flights, degrees)
    shared = minimise(channels, SCALING, SCALING.scaled(TRUE))
    own, estimate = with_own_trims(channels, SCALING, shared, ["a", "b"])
    first, second = (math.degrees(passage.trim) for passage in own.passages)
    assert first == 0.0 and second == pytest.approx(degrees, abs=0.3)
    assert abs(math.degrees(SCALING.physical(estimate.z)[TRIM])) < 0.3
    assert _off(SCALING.physical(estimate.z)) < 0.06 < _off(SCALING.physical(shared.z))
    columns = own_trim_columns(own, SCALING, estimate)
    assert columns.shape == (own.rows.size, 1)
    alone = spread_of(own, SCALING, estimate, columns[:, :0])
    both = spread_of(own, SCALING, estimate, columns)
    assert both.classic[TRIM, TRIM] > alone.classic[TRIM, TRIM]


def test_recordings_of_one_trim_and_parts_of_one_recording_share_it(flights: list[PlanarData]) -> None:
    channels = trimmed(flights, 0.0)
    estimate = minimise(channels, SCALING, SCALING.scaled(TRUE))
    own, same = with_own_trims(channels, SCALING, estimate, ["a", "b"])
    assert own is channels and same is estimate
    assert own_trim_columns(own, SCALING, estimate).shape == (own.rows.size, 0)
    channels = trimmed(flights, 3.0)
    own, _ = with_own_trims(channels, SCALING, estimate, ["a", "a"])
    assert own is channels


def _off(physical: Numbers) -> float:
    """Return the share by which the rudder's effect on yaw is off."""
    return abs(float(np.divide(physical[13], TRUE[13])) - 1.0)
