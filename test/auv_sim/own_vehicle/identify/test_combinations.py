"""Combinations of coefficients: a hull and its write-back accelerate alike; scaling with length and log."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle as vehicle_file
from auv_path_following.control.hull_model import HullModel
from auv_sim.own_vehicle.identify.combinations import (
    SCALE_POWERS,
    Combinations,
    combinations_of,
    hull_with,
    prior_of,
    scaled_hull,
)
from auv_sim.own_vehicle.identify.filter.planar_filter import planar_accelerations
from auv_sim.own_vehicle.identify.hull_abilities import pole_of, speed_of
from auv_sim.own_vehicle.identify.study.random_hulls import random_vehicle
from auv_sim.vehicle.remus import planar_hull_of, planar_slopes

REMUS = vehicle_file.load("remus100")
speeds = st.tuples(st.floats(0.3, 3.0), st.floats(-0.5, 0.5), st.floats(-0.6, 0.6))
fins = st.floats(-0.6, 0.6)


@given(seed=st.integers(0, 50), stable=st.booleans(), motion=speeds, delta=fins, thrust=st.floats(0.0, 7.0))
@settings(max_examples=40)
def test_a_hull_written_back_with_other_masses_moves_the_same(
    seed: int, stable: bool, motion: tuple[float, float, float], delta: float, thrust: float
) -> None:
    true = random_vehicle(seed, stable)
    found = dataclasses.replace(true, hull=hull_with(combinations_of(true.coefficients), REMUS.coefficients))
    u, v, r = motion
    expected = planar_slopes(planar_hull_of(true)[:], 0.0, u, v, r, delta, thrust)[2:]
    assert planar_slopes(planar_hull_of(found)[:], 0.0, u, v, r, delta, thrust)[2:] == pytest.approx(expected)
    c = combinations_of(true.coefficients)
    assert planar_accelerations(c, u, v, r, c.X1 * thrust, delta) == pytest.approx(expected)


@given(motion=speeds, delta=fins, scale=st.floats(0.9, 1.1))
@settings(max_examples=30)
def test_a_log_that_reads_too_much_multiplies_the_combinations_by_its_powers(
    motion: tuple[float, float, float], delta: float, scale: float
) -> None:
    c = combinations_of(REMUS.coefficients)
    as_read = Combinations(*(np.array(c) * scale**SCALE_POWERS))
    u, v, r = motion
    du, dv, dr = planar_accelerations(c, u, v, r, c.X1 * 5.0, delta)
    found = planar_accelerations(as_read, scale * u, scale * v, r, as_read.X1 * 5.0, delta)
    assert found == pytest.approx((scale * du, scale * dv, dr), rel=1e-9, abs=1e-12)


def test_a_longer_hull_of_the_same_shape_turns_wider_in_proportion() -> None:
    longer = dataclasses.replace(REMUS, hull=scaled_hull(REMUS.coefficients, 2.0))
    angle = REMUS.rudder.max_angle
    u, v, r = HullModel(REMUS).steady_motion(6.0, angle)
    U, V, R = HullModel(longer).steady_motion(6.0, angle)
    assert np.hypot(U, V) / R == pytest.approx(2.0 * np.hypot(u, v) / r)
    assert R > 0.0 and r > 0.0  # starboard, Eq. (14)


def test_a_coefficient_of_the_wrong_sign_is_held_at_the_bound_of_the_file() -> None:
    c = combinations_of(REMUS.coefficients)
    hull = hull_with(c._replace(Yvv=-c.Yvv, Nvv=-c.Nvv), REMUS.coefficients)
    assert -2.0 < hull.Yvv < 0.0


def test_the_prior_holds_its_hull_and_is_wide() -> None:
    prior = prior_of(REMUS.coefficients)
    z = np.linalg.solve(prior.root, np.array(combinations_of(REMUS.coefficients)) - prior.mean)
    assert np.abs(z).max() < 1.0
    spread = np.sqrt(np.diag(prior.root @ prior.root.T)) / np.abs(prior.mean)
    assert spread.min() > 0.25


def test_poles_and_speeds_of_known_hulls() -> None:
    c = combinations_of(REMUS.coefficients)
    assert speed_of(c, 6.48) == pytest.approx(2.0)
    assert pole_of(c, 2.0) == pytest.approx(1.33, abs=0.01)
    assert pole_of(combinations_of(random_vehicle(1, stable=True).coefficients), 2.0) < 0.0


@pytest.mark.parametrize("zeros", [("Xrr",), ("Nvv", "Nvd"), ("Yrr", "Yrd", "Xvr")])
def test_coefficients_that_a_file_leaves_at_zero_have_a_prior(zeros: tuple[str, ...]) -> None:
    sparse = dataclasses.replace(REMUS.coefficients, **dict.fromkeys(zeros, 0.0))
    prior = prior_of(sparse)
    assert np.diag(prior.root).min() > 0.0
    whole = prior_of(REMUS.coefficients)
    assert prior.mean == pytest.approx(whole.mean) and prior.root == pytest.approx(whole.root)


def test_a_hull_whose_file_has_hardly_any_damping_may_have_as_much_as_a_similar_one() -> None:
    hull = vehicle_file.load("remus100").coefficients
    place = Combinations._fields.index("Nur")
    usual, small = (prior_of(dataclasses.replace(hull, Nur=f * hull.Nur)) for f in (1.0, 0.05))
    widths = [np.linalg.norm(prior.root[place]) for prior in (usual, small)]
    assert widths[1] > 0.8 * widths[0]
    assert abs(small.mean[place] - usual.mean[place]) < 2.0 * widths[1]


def test_a_hull_may_damp_its_yaw_rate_many_times_as_much_as_a_similar_one() -> None:
    """Published hulls do; a prior that excludes it makes the rudder's effect and dead time too small."""
    hull = vehicle_file.load("remus100").coefficients
    prior = prior_of(hull)
    damped = dataclasses.replace(hull, Nur=7.0 * hull.Nur)
    place = Combinations._fields.index("Nur")
    off = combinations_of(damped).Nur - prior.mean[place]
    assert abs(off) < 1.5 * float(np.linalg.norm(prior.root[place]))
