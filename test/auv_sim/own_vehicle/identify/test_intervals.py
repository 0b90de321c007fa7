"""Intervals of an estimate whose derivatives jump where a servo begins to move."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify import intervals
from auv_sim.own_vehicle.identify.combinations import Numbers, prior_of
from auv_sim.own_vehicle.identify.innovations import channels_of
from auv_sim.own_vehicle.identify.intervals import spread_of
from auv_sim.own_vehicle.identify.minimise import STEP, jacobian, minimise
from auv_sim.own_vehicle.identify.study.identified_cases import KNOWN, true_unknowns
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.unknowns import ALL, DEAD_TIME, RATE, DataSheet, Scaling
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea as sea_file


def test_a_jump_of_the_innovations_is_no_knowledge_of_the_servo(monkeypatch: pytest.MonkeyPatch) -> None:
    vehicle, sea = vehicle_file.load(KNOWN), sea_file.load("moderate")
    data = planar_data(simulate(vehicle, sea, program_file.load("two_minutes"), 1))
    scaling = Scaling(prior_of(vehicle.coefficients), DataSheet())
    channels = channels_of([data.between(data.t[0], data.t[0] + 60.0)], scaling.sheet, math.radians(0.2))
    estimate = minimise(channels, scaling, scaling.scaled(true_unknowns(vehicle, sea)), rounds=1)
    none = np.zeros((channels.rows.size, 0))
    spread = spread_of(channels, scaling, estimate, none)
    smooth = spread.deviations[RATE]
    assert 0.001 <= spread.deviations[DEAD_TIME] < 0.01  # not by the curvature alone: the likelihood jumps
    assert spread.unseen(np.eye(ALL)[DEAD_TIME]) == pytest.approx(0.001)

    def jumping(*arguments: Any) -> Numbers:
        """Return derivatives of innovations of which one jumps by 0.1 just above the estimated rate."""
        found = jacobian(*arguments)
        step = arguments[5] if len(arguments) > 5 else STEP
        if step > 0.0:
            found[100, list(arguments[3]).index(RATE)] += 0.1 / step
        return found

    monkeypatch.setattr(intervals, "jacobian", jumping)
    assert spread_of(channels, scaling, estimate, none).deviations[RATE] == pytest.approx(smooth, rel=0.2)
