"""Heave and pitch: linearisation, write-back, and an identification of a dive with ideal instruments."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify.dive.dive_combinations import (
    dive_combinations_of,
    dive_prior_of,
    vertical_with,
)
from auv_sim.own_vehicle.identify.dive.dive_data import coupling_of
from auv_sim.own_vehicle.identify.dive.dive_filter import dive_accelerations, dive_jacobian, dive_rates
from auv_sim.own_vehicle.identify.identification import identify_dive
from auv_sim.own_vehicle.identify.study.simulated_data import dive_data
from auv_sim.own_vehicle.identify.unknowns import RATE, DataSheet
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate

REMUS = vehicle_file.load("remus100_6dof")
HULL = REMUS.coefficients
assert HULL.vertical is not None
VERTICAL = HULL.vertical
C = dive_combinations_of(HULL.m, VERTICAL)


@given(
    u=st.floats(0.5, 2.5),
    w=st.floats(-0.3, 0.3).filter(lambda w: abs(w) > 0.01),
    q=st.floats(-0.3, 0.3).filter(lambda q: abs(q) > 0.01),
    theta=st.floats(-0.5, 0.5),
)
@settings(max_examples=30)
def test_the_jacobian_is_that_of_finite_differences(u: float, w: float, q: float, theta: float) -> None:
    level = 0.7  # cosine of the roll
    given_, x, h = (u, level, 0.01, 0.0, 0.0, 0.0, 0.026, 0.0), np.array([theta, w, q]), 1e-6

    def slopes(x: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        return np.array(dive_rates(C, u, given_, *x, 0.1))

    columns = np.array([(slopes(x + h * e) - slopes(x - h * e)) / (2.0 * h) for e in np.eye(3)]).T
    linear = dive_jacobian(C, u, w, q, np.cos(theta), level * np.sin(theta), level)
    found = np.array(linear).reshape(3, 3)
    assert found == pytest.approx(columns, rel=0.03, abs=0.01)


def test_planes_down_push_the_bow_down_and_gravity_rights_the_hull() -> None:
    _, down = dive_accelerations(C, 2.0, 0.0, 0.0, 1.0, 0.0, 0.1)
    _, level = dive_accelerations(C, 2.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    _, up = dive_accelerations(C, 2.0, 0.0, 0.0, 1.0, 0.2, 0.0)
    assert down < level and up < level  # positive pitch is bow up


@given(factor=st.floats(0.7, 1.4), ahead=st.floats(-0.01, 0.01))
@settings(max_examples=20)
def test_a_hull_written_back_with_other_masses_has_the_same_combinations(factor: float, ahead: float) -> None:
    true = dataclasses.replace(VERTICAL, Zuw=factor * VERTICAL.Zuw, Muq=factor * VERTICAL.Muq, xg=ahead)
    assumed = dataclasses.replace(VERTICAL, Zwd=1.2 * VERTICAL.Zwd, Mqd=0.8 * VERTICAL.Mqd)
    c = dive_combinations_of(HULL.m, true)._replace(Zsin=0.0)
    again = dive_combinations_of(HULL.m, vertical_with(c, HULL.m, assumed))._replace(Zsin=0.0)
    assert again == pytest.approx(c, rel=0.02, abs=2e-3)


def test_a_dive_shows_planes_drag_and_righting_moment(tmp_path: Path) -> None:
    flown = simulate(REMUS, None, program_file.load("two_minutes_dive"))
    data = dive_data(flown, coupling_of(HULL, VERTICAL)).between(flown.t[flown.leg > 0][0], 1e9)
    known = dataclasses.replace(VERTICAL, Muud=-4.5, Mqq=-150.0, Zww=-110.0)
    found = identify_dive([data], HULL, known, DataSheet(latency=0.0), 0.0)
    c = dict(zip(C._fields, found.physical, strict=False))
    assert c["Muud"] == pytest.approx(C.Muud, rel=0.2)
    assert c["Msin"] == pytest.approx(C.Msin, rel=0.2)
    assert c["Mqq"] == pytest.approx(C.Mqq, rel=0.2)
    assert np.degrees(found.physical[RATE]) == pytest.approx(15.0, rel=0.05)


def test_a_coefficient_that_the_file_leaves_at_zero_is_found_by_the_data_not_by_the_file() -> None:
    known, left_out = (
        dive_prior_of(HULL, VERTICAL),
        dive_prior_of(HULL, dataclasses.replace(VERTICAL, Muw=0.0)),
    )
    place = C._fields.index("Muw")
    spread = [np.linalg.norm(prior.root[place]) for prior in (known, left_out)]
    assert spread[1] == pytest.approx(spread[0], rel=0.3)
    assert left_out.mean[place] == pytest.approx(known.mean[place], rel=0.3)
