"""The vehicle's tightest turn, found from its plant."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from scipy.optimize import fsolve

from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.types import NO_CURRENT
from auv_path_following import config_files, vehicle
from auv_path_following.vehicle import Turning
from auv_sim.plant.remus import PlantState, RemusDynamics
from auv_sim.plant.turning import tightest_turn


@pytest.mark.parametrize("name", config_files.shipped("vehicles"))
def test_it_is_where_all_forces_balance(name):
    """The root of Eq. (19) with full rudder, found without letting time pass."""
    hull = vehicle.load(name)
    dynamics, rudder = RemusDynamics(hull), hull.rudder.max_angle

    def accelerations(state):
        return dynamics.derivative(PlantState(0.0, 0.0, 0.0, *state), rudder, hull.thrust_max, NO_CURRENT)[3:]

    turn = tightest_turn(hull)
    guess = (0.98 * turn.speed, 0.2, -turn.speed / turn.radius)
    ur, vr, r = fsolve(accelerations, guess, xtol=1e-12)
    assert turn.radius == pytest.approx(float(np.hypot(ur, vr) / abs(r)), rel=1e-5)
    assert turn.source == "found from the hull"


def test_the_thrust_does_not_matter():
    hull = vehicle.load("remus100")
    slow = dataclasses.replace(hull, thrust_max=0.25 * hull.thrust_max)
    assert tightest_turn(slow).radius == pytest.approx(tightest_turn(hull).radius, rel=1e-5)
    assert tightest_turn(slow).speed == pytest.approx(0.5 * tightest_turn(hull).speed, rel=1e-5)


def test_a_measured_radius_wins():
    measured = dataclasses.replace(vehicle.load("remus100"), turning=Turning(radius=9.5))
    assert (tightest_turn(measured).radius, tightest_turn(measured).source) == (9.5, "measured")


def test_speed_and_thrust_belong_together():
    hull = vehicle.load("remus100")
    assert hull.speed_at(6.48) == pytest.approx(2.0)
    assert hull.thrust_at(hull.speed_at(5.0)) == pytest.approx(5.0)


def test_a_turn_that_never_settles_asks_for_a_measured_one():
    hull = vehicle.load("remus100")
    # Almost no damping in yaw: far from steady after hundreds of lengths.
    slippery = dataclasses.replace(hull.hull, Izz=2e5, Nrr=-94.0)
    with pytest.raises(ConfigurationError, match="a measured radius"):
        tightest_turn(dataclasses.replace(hull, hull=slippery))
