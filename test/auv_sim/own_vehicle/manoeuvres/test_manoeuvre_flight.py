"""Programs flown on simulated hulls, stable and unstable ones: they stay within their box."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate
from auv_sim.vehicle import sea
from hulls import STABLE, drawn

MODERATE = sea.load("moderate")
TWO = program_file.load("two_minutes")


@pytest.mark.parametrize(
    "hull",
    [vehicle.load("remus100"), vehicle.load("remus100_table2"), STABLE, drawn(4), drawn(5)],
    ids=["Prestero", "Table 2", "stable", "strong", "weak"],
)
def test_two_minutes_reverse_often_and_stay_within_a_box(hull: Vehicle) -> None:
    flown = simulate(hull, MODERATE, TWO, 1)
    assert flown.t[-1] - flown.t[0] == pytest.approx(120.0, abs=0.1)
    assert np.hypot(flown.x, flown.y).max() < 150.0
    for number, leg in enumerate(TWO.legs):
        if leg.zigzag:
            sides = np.sign(flown.rudder[flown.leg == number])
            assert np.count_nonzero(np.diff(sides)) >= 3


@pytest.mark.parametrize("hull", [vehicle.load("remus100_table2"), STABLE], ids=["unstable", "stable"])
def test_a_straight_is_held_where_neutral_rudder_would_end_in_a_turn(hull: Vehicle) -> None:
    straight = program_file.LegSpec(straight=program_file.Straight(seconds=60.0))
    flown = simulate(hull, MODERATE, program_file.Program(version=1, name="straight", legs=(straight,)), 3)
    assert np.degrees(np.abs(flown.psi[flown.t > 21.0])).max() < 15.0


def test_planes_move_the_vehicle_within_a_few_metres() -> None:
    program = program_file.load("two_minutes_dive")
    flown = simulate(vehicle.load("remus100_6dof"), MODERATE, program, 1)
    assert flown.z.min() > 5.0 and flown.z.max() < 15.0
    assert np.degrees(np.abs(flown.theta)).max() < 35.0
    assert flown.q.std() > math.radians(3.0)


def test_the_log_has_its_own_rate_and_age() -> None:
    flown = simulate(vehicle.load("remus100"), MODERATE, TWO, 2)
    assert len(flown.water_t) == pytest.approx(120.0 * 5.0, abs=2)
    assert flown.water_latency == pytest.approx(0.1)
    assert np.isin(flown.water_t, flown.t).all()
    # Without errors the log is the truth: over ground less the current.
    ideal = simulate(vehicle.load("remus100"), None, TWO)
    assert len(ideal.water_t) == len(ideal.t)
    np.testing.assert_allclose(ideal.water_u, ideal.u, atol=1e-12)


def test_a_seed_repeats_a_flight() -> None:
    first, again, other = (simulate(vehicle.load("remus100"), MODERATE, TWO, seed) for seed in (7, 7, 8))
    assert np.array_equal(first.r, again.r)
    assert not np.array_equal(first.r, other.r)
