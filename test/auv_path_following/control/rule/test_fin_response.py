"""The numbers of a hull's response, against its accelerations and against what a file says."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.hull_model import HullModel, accelerations, rudder_gain, slopes
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.vehicle import Vehicle
from hulls import REMUS, STABLE, drawn

HULLS = {"REMUS": REMUS, "stable": STABLE, "late": drawn(5), "table 2": vehicle.load("remus100_table2")}
MEASURED = Vehicle(
    name="m",
    length=2.0,
    thrust_max=10.0,
    rudder=REMUS.rudder,
    cruise=Cruise(thrust=10.0, speed=1.8),
    turning=Turning(radius=9.0),
)


def jacobian(hull: Vehicle, ur: float, vr: float, r: float) -> np.ndarray:
    """Slopes of sway and yaw by finite differences."""
    model, h = HullModel(hull).sway_yaw, 1e-6
    columns = [
        np.subtract(accelerations(model, ur, vr + dv, r + dr), accelerations(model, ur, vr - dv, r - dr))
        for dv, dr in ((h, 0.0), (0.0, h))
    ]
    return np.array(columns).T / (2.0 * h)


@pytest.mark.parametrize("name", HULLS)
def test_slopes_are_the_derivatives_of_the_accelerations(name: str) -> None:
    model = HullModel(HULLS[name]).sway_yaw
    for motion in ((2.0, 0.0, 0.0), (1.5, 0.2, -0.3), (1.8, -0.1, 0.2)):
        assert np.allclose(slopes(model, *motion), jacobian(HULLS[name], *motion), atol=1e-3, rtol=1e-4)


@pytest.mark.parametrize("name", HULLS)
def test_its_gain_is_that_of_the_linear_hull(name: str) -> None:
    hull = HULLS[name]
    response, A = response_of(hull), jacobian(hull, hull.top_speed, 0.0, 0.0)
    by_fin = rudder_gain(HullModel(hull).sway_yaw, hull.top_speed)
    for w in (0.3, 2.0, 6.0):
        exact = np.linalg.solve(1j * w * np.eye(2) - A, by_fin)[1]
        assert response.gain(w) == pytest.approx(-exact, rel=1e-3)
    assert response.divergence == pytest.approx(np.linalg.eigvals(A).real.max(), abs=1e-3)


@pytest.mark.parametrize("name", HULLS)
def test_slip_is_the_sway_that_a_steady_turn_of_the_bow_begins_with(name: str) -> None:
    """The rudder holds r, the hull does not slip yet."""
    hull = HULLS[name]
    response, A = response_of(hull), jacobian(hull, hull.top_speed, 0.0, 0.0)
    by_sway, by_yaw = rudder_gain(HullModel(hull).sway_yaw, hull.top_speed)
    sideways = A[0, 1] - by_sway * A[1, 1] / by_yaw
    assert response.slip == pytest.approx(-sideways / response.speed, rel=1e-3)
    assert 0.0 < response.slip_at(0.1) < response.slip_at(1.0) < response.slip
    assert response_of(MEASURED).slip_at(1.0) == 0.0


def test_sideslip_makes_some_hulls_late_and_others_early() -> None:
    assert response_of(drawn(5)).lag(4.0) > 0.05
    assert response_of(REMUS).lag(4.0) == pytest.approx(0.0, abs=0.06)
    assert response_of(MEASURED).lag(4.0) == 0.0


def test_sideslip_settles_slowly_on_the_hull_that_drifts() -> None:
    assert response_of(REMUS).drift_time == pytest.approx(0.20, abs=0.01)
    assert response_of(STABLE).drift_time == pytest.approx(0.81, abs=0.02)


def test_what_is_not_measured_is_that_of_a_typical_torpedo() -> None:
    response = response_of(MEASURED)
    assert response.speed == 1.8
    assert response.effect == pytest.approx(1.8 * 0.9**2)
    assert response.divergence == pytest.approx(1.2 * 0.9)
    assert response.turn == pytest.approx(0.75 * 0.2)


def test_what_is_measured_counts_before_the_hull() -> None:
    turning = Turning(radius=6.0, effect=2.0, divergence=0.5, drift_time=0.4)
    cruise = Cruise(thrust=6.48, speed=1.9)
    response = response_of(dataclasses.replace(REMUS, turning=turning, cruise=cruise))
    assert response[:5] == pytest.approx((1.9, 2.0, 0.5, 0.75 * 1.9 / 6.0, 0.4))
    assert abs(response.gain(2.0)) == pytest.approx(2.0 / math.hypot(2.0, 0.5))
