"""Identification of a hull whose likelihood has a second minimum, far from the truth."""

from __future__ import annotations

import math

import pytest

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify import combinations
from auv_sim.own_vehicle.identify.combinations import COUNT
from auv_sim.own_vehicle.identify.identification import identify
from auv_sim.own_vehicle.identify.study.identified_cases import KNOWN, true_unknowns
from auv_sim.own_vehicle.identify.study.random_hulls import random_vehicle
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.unknowns import DEAD_TIME
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file


def test_one_of_the_starts_finds_the_deeper_minimum(monkeypatch: pytest.MonkeyPatch) -> None:
    """Starts that all begin on the same part of this recording end with half the rudder's effect.

    They do with a prior that is narrow in the damping of the yaw rate.
    """
    monkeypatch.setitem(combinations._DAMPING, "Nur", 1.0)
    hull, sea = random_vehicle(1058, stable=False), sea_file.load("moderate")
    flown = simulate(hull, sea, program_file.load("eight_minutes"), 1058)
    found = identify([planar_data(flown)], vehicle_file.load(KNOWN).coefficients, dead_band=math.radians(0.2))
    true = true_unknowns(hull, sea)
    assert abs(found.physical[DEAD_TIME] - true[DEAD_TIME]) < 0.01
    assert abs(found.physical[COUNT - 1] / true[COUNT - 1] - 1.0) < 0.06
    assert max(found.misfits) > 1000.0, "the other starts end elsewhere"
