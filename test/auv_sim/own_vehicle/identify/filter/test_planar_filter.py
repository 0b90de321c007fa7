"""The filter's linearisation, its compiled and uncompiled forms, and what it makes of exact data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify.combinations import combinations_of
from auv_sim.own_vehicle.identify.filter.filter_covariance import spread, transition
from auv_sim.own_vehicle.identify.filter.planar_filter import (
    planar_accelerations,
    planar_advance,
    planar_jacobian,
)
from auv_sim.own_vehicle.identify.innovations import (
    _uncompiled,
    channels_of,
    innovations,
    many_innovations,
)
from auv_sim.own_vehicle.identify.study.simulated_data import planar_data
from auv_sim.own_vehicle.identify.unknowns import TRIM, DataSheet
from auv_sim.own_vehicle.manoeuvres import program_file
from auv_sim.own_vehicle.manoeuvres.manoeuvre_flight import simulate

REMUS = vehicle_file.load("remus100")
C = combinations_of(REMUS.coefficients)
TRUE = np.array([*C, REMUS.rudder.max_rate, *[0.0] * 7])


@given(
    u=st.floats(0.3, 3.0),
    v=st.floats(-0.4, 0.4).filter(lambda v: abs(v) > 0.01),
    r=st.floats(-0.5, 0.5).filter(lambda r: abs(r) > 0.01),
    delta=st.floats(-0.6, 0.6),
)
@settings(max_examples=30)
def test_the_jacobian_is_that_of_finite_differences(u: float, v: float, r: float, delta: float) -> None:
    x, h = np.array([u, v, r]), 1e-6

    def slopes(x: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        return np.array(planar_accelerations(C, *x, 0.2, delta))

    columns = [(slopes(x + h * e) - slopes(x - h * e)) / (2.0 * h) for e in np.eye(3)]
    assert np.array(planar_jacobian(C, u, v, r, delta)).reshape(3, 3) == pytest.approx(
        np.array(columns).T, rel=1e-5, abs=1e-6
    )


def test_the_transition_is_that_of_finite_differences_over_a_step() -> None:
    x, h, step = np.array([1.8, 0.05, 0.2]), 1e-5, 0.05

    def after(x: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        return np.array(planar_advance(C, *x, 0.2, 0.1, 0.0, step))

    columns = np.array([(after(x + h * e) - after(x - h * e)) / (2.0 * h) for e in np.eye(3)]).T
    found = np.array(transition(planar_jacobian(C, *x, 0.1), step)).reshape(3, 3)
    assert found == pytest.approx(columns, abs=0.03)


def test_a_covariance_stays_that_of_the_matrix_product() -> None:
    root = np.random.default_rng(0).normal(size=(3, 3))
    P, F = root @ root.T, np.random.default_rng(1).normal(size=(3, 3))
    flat = P[np.triu_indices(3)]
    assert np.array(spread(tuple(flat), tuple(F.ravel()))) == pytest.approx((F @ P @ F.T)[np.triu_indices(3)])


def test_exact_data_leave_no_innovations_and_both_forms_agree() -> None:
    data = planar_data(simulate(REMUS, None, program_file.load("two_minutes"))).between(0.0, 30.0)
    sheet = DataSheet(latency=0.0)
    channels = channels_of([data], sheet, 0.0)
    found = innovations(channels, TRUE)
    r, u, v = (found[channels.rows == channel] for channel in range(3))
    assert np.abs(r).max() < 2e-4 and np.abs(u).max() < 1e-3 and np.abs(v).max() < 1e-3
    other = TRUE.copy()
    other[13] *= 1.1
    assert np.abs(innovations(channels, other)[channels.rows == 0]).max() > 1e-3
    compiled = many_innovations(channels, [TRUE, other])
    assert _uncompiled(channels, [TRUE, other]) == pytest.approx(compiled, abs=1e-9)


@pytest.mark.parametrize("trim", [0.035, -0.035])
def test_a_fin_that_stands_off_its_command_is_one_with_a_trim(trim: float) -> None:
    data = planar_data(simulate(REMUS, None, program_file.load("two_minutes"))).between(0.0, 30.0)
    channels = channels_of([data._replace(rudder=data.rudder - trim)], DataSheet(latency=0.0), 0.0)
    trimmed = TRUE.copy()
    trimmed[TRIM] = trim
    # The servo's way from neutral to the first command differs, for a moment.
    settled = (channels.rows == 0) & (channels.passages[0].rows > data.t[0] + 5.0)
    assert np.abs(innovations(channels, trimmed)[settled]).max() < 2e-4
    assert np.abs(innovations(channels, TRUE)[settled]).max() > 1e-3
