"""The search for a servo leaves a minimum that the dead band makes, where derivatives cannot."""

from __future__ import annotations

import math

import numpy as np

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify.combinations import prior_of
from auv_sim.own_vehicle.identify.innovations import channels_of
from auv_sim.own_vehicle.identify.minimise import minimise
from auv_sim.own_vehicle.identify.refine.model_errors import with_model_errors
from auv_sim.own_vehicle.identify.refine.servo_search import search_servo
from auv_sim.own_vehicle.identify.study.identified_cases import KNOWN, true_unknowns
from auv_sim.own_vehicle.identify.study.random_hulls import random_vehicle
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME, HALF_PLAY, DataSheet, Scaling
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file


def test_a_servo_in_a_wrong_minimum_is_found_and_the_filter_trusts_it_less_where_it_is_wrong() -> None:
    hull, sea = random_vehicle(1019, stable=True), sea_file.load("moderate")
    flown = simulate(hull, sea, program_file.load("two_minutes"), 1019)
    true = true_unknowns(hull, sea)
    scaling = Scaling(prior_of(vehicle_file.load(KNOWN).coefficients), DataSheet())
    channels = channels_of([planar_data(flown)], scaling.sheet, math.radians(0.2))
    begun = true.copy()
    begun[DEAD_TIME] -= 0.008
    begun[HALF_PLAY] *= 2.0
    stuck = minimise(channels, scaling, scaling.scaled(begun))
    assert abs(scaling.physical(stuck.z)[DEAD_TIME] - true[DEAD_TIME]) > 0.003
    _, found = search_servo(channels, scaling, stuck, is_band_known=True)
    assert found.cost < stuck.cost - 10.0
    assert abs(scaling.physical(found.z)[DEAD_TIME] - true[DEAD_TIME]) < 0.0015
    coarse = channels.with_noise(5, 1e-4)
    trusted, _ = with_model_errors(coarse, scaling, found)
    assert np.isclose(trusted.noise[5], channels.noise[5]), "yaw has nearly no growth of its own"
