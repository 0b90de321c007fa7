"""The vehicle's tightest turn: the balance of forces against the simulated plant, rudder hard over."""

from __future__ import annotations

import dataclasses
import math

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Command
from auv_path_following import config_files, vehicle
from auv_path_following.abilities import Cruise, Turning
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle
from hulls import REMUS, STABLE, drawn

SHIPPED = {name: vehicle.load(name) for name in config_files.shipped("vehicles")}
HULLS = {
    **{name: hull for name, hull in SHIPPED.items() if not hull.dives},
    "stable": STABLE,
    **{f"drawn {number}": drawn(number) for number in range(8)},
}


def simulated(hull: Vehicle, seconds: float = 60.0) -> PlantState:
    """The plant after so long with all its thrust and the rudder hard over to port."""
    plant = SimulatedVehicle(hull, PlantState(0.0, 0.0, 0.0, hull.top_speed, 0.0, 0.0))
    plant.advance(Command(hull.rudder.max_angle, hull.thrust_max), seconds)
    return plant.motion


@pytest.mark.parametrize("name", HULLS)
def test_it_is_that_of_the_simulated_plant(name):
    turn, plant = tightest_turn(HULLS[name]), simulated(HULLS[name])
    assert turn.rate == pytest.approx(-plant.r, rel=0.005)
    assert turn.speed == pytest.approx(math.hypot(plant.ur, plant.vr), rel=0.005)
    assert turn.radius == pytest.approx(turn.speed / -plant.r, rel=0.005)
    assert turn.source == "found from the hull"


@pytest.mark.parametrize(
    ("name", "rate", "radius"),
    [("remus100", 0.347, 4.21), ("remus100_table2", 0.933, 1.28), ("stable", 0.208, 6.44)],
)
def test_what_sway_and_lost_speed_leave_of_it(name, rate, radius):
    assert tightest_turn(HULLS[name]).rate == pytest.approx(rate, abs=5e-4)
    assert tightest_turn(HULLS[name]).radius == pytest.approx(radius, abs=5e-3)


def test_the_thrust_changes_the_speed_and_not_the_radius():
    slow, fast = tightest_turn(REMUS, 0.25 * REMUS.thrust_max), tightest_turn(REMUS)
    assert slow.radius == pytest.approx(fast.radius)
    assert slow.speed == pytest.approx(0.5 * fast.speed)


def test_a_measured_radius_takes_precedence():
    turn = tightest_turn(dataclasses.replace(REMUS, turning=Turning(radius=9.5)))
    assert (turn.radius, turn.source) == (9.5, "measured")
    assert turn.rate == pytest.approx(2.0 / 9.5)


def test_a_vehicle_without_a_hull_turns_at_its_measured_radius_and_speed():
    measured = dataclasses.replace(
        REMUS, hull=None, turning=Turning(radius=9.5), cruise=Cruise(thrust=6.48, speed=1.9)
    )
    assert tightest_turn(measured).rate == pytest.approx(1.9 / 9.5)


def test_speed_and_thrust_belong_together():
    assert REMUS.speed_at(6.48) == pytest.approx(2.0)
    assert REMUS.thrust_at(REMUS.speed_at(5.0)) == pytest.approx(5.0)


@pytest.mark.parametrize(
    "changes",
    [{"Xrr": 400.0}, {"Nuv": 60.0, "Nur": 20.0, "Yvv": -50.0}],
    ids=["a turn that drives it on", "a rudder that turns it the wrong way"],
)
def test_a_hull_without_a_steady_turn_asks_for_a_measured_one(changes):
    odd = dataclasses.replace(REMUS, hull=dataclasses.replace(REMUS.coefficients, **changes))
    with pytest.raises(ConfigurationError, match="a measured radius"):
        tightest_turn(odd)
