"""The vehicle as a whole: ideal without a sea, repeatable in one."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Command, Current
from auv_path_following import config_files, vehicle
from auv_sim.vehicle import sea
from auv_sim.vehicle import simulated as simulated_module
from auv_sim.vehicle.remus import (
    PlantState,
    ground_velocity,
    navigation_of,
    plant_at,
    plant_of,
    plant_step,
)
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import SimulatedVehicle

START = PlantState(1.0, 2.0, 0.3, 1.9, 0.0, 0.0)
COMMANDS = [Command(0.1 * math.sin(0.3 * k), 6.0) for k in range(200)]
CURRENT = Current(0.1, -0.2)


def flown(simulated: SimulatedVehicle) -> list[object]:
    seen: list[object] = []
    for command in COMMANDS:
        seen.append((simulated.navigation, simulated.water_velocity, simulated.truth, simulated.current))
        simulated.advance(command, 0.05)
    return seen


def test_without_a_sea_it_is_the_plant_to_the_last_bit() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, current=CURRENT)
    config, plant = plant_of(vehicle.load("remus100")), plant_at(START)
    for command in COMMANDS:
        assert simulated.navigation == navigation_of(plant.hull)
        assert simulated.water_velocity == (plant.hull.ur, plant.hull.vr)
        assert simulated.rudder == plant.servo.angle
        assert simulated.ground_velocity == ground_velocity(plant.hull, CURRENT)
        assert simulated.truth == (navigation_of(plant.hull), *ground_velocity(plant.hull, CURRENT))
        assert (simulated.current, simulated.water_lock) == (CURRENT, True)
        simulated.advance(command, 0.05)
        plant, _ = plant_step(config, plant, (command, CURRENT, 1.0), 0.05)


def test_reset_brings_back_state_and_rudder() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START)
    simulated.advance(Command(0.5, 6.0), 3.0)
    assert simulated.rudder > 0.0
    simulated.reset()
    assert (simulated.motion, simulated.rudder) == (START, 0.0)


def test_a_vehicle_is_placed_where_it_is_asked_to_be() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START)
    simulated.advance(Command(0.5, 6.0), 3.0)
    rudder = simulated.rudder
    simulated.place(START)
    assert (simulated.motion, simulated.rudder) == (START, rudder)


def test_a_sea_with_nothing_in_it_moves_the_vehicle_no_otherwise() -> None:
    """Its navigator still reckons, but the hull does not feel it."""
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, Sea(name="still"), current=CURRENT)
    config, plant = plant_of(vehicle.load("remus100")), plant_at(START)
    for command in COMMANDS:
        simulated.advance(command, 0.05)
        plant, motion = plant_step(config, plant, (command, CURRENT, 1.0), 0.05)
        assert simulated.truth[0] == navigation_of(motion)
        assert simulated.ground_velocity == ground_velocity(motion, CURRENT)


@pytest.mark.parametrize("name", config_files.shipped("seas"))
def test_a_seed_is_a_run_and_a_reset_begins_it_again(name: str) -> None:
    hull = vehicle.load("remus100")
    simulated = SimulatedVehicle(hull, START, sea.load(name), 4)
    first = flown(simulated)
    simulated.reset()
    assert flown(simulated) == first
    assert flown(SimulatedVehicle(hull, START, sea.load(name), 4)) == first
    other = flown(SimulatedVehicle(hull, START, sea.load(name), 5))
    assert other[-1] != first[-1]
    assert sea.load(name).name == name


def test_drawing_on_leaves_a_run_as_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    hull = vehicle.load("remus100")
    first = flown(SimulatedVehicle(hull, START, sea.load("rough"), 4))
    monkeypatch.setattr(simulated_module, "_BLOCK", 7)
    assert flown(SimulatedVehicle(hull, START, sea.load("rough"), 4)) == first


def test_at_sea_another_step_than_that_of_the_run_is_refused() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, sea.load("calm"), step=0.1)
    simulated.advance(COMMANDS[0], 0.1)
    with pytest.raises(ValueError, match=r"dt: found 0.05 s, expected the step of this run at sea, 0.1 s"):
        simulated.advance(COMMANDS[0], 0.05)


@pytest.mark.parametrize("name", ["rough", "blue_water"])
def test_the_twist_is_nan_without_bottom_lock(name: str) -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, sea.load(name), 4)
    u, v = simulated.ground_velocity
    assert math.isnan(u) == math.isnan(v) == (name == "blue_water")


def test_a_constant_current_comes_on_top_and_may_change() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, sea.load("rough"), 1)
    own = simulated.current
    simulated.constant_current = CURRENT
    assert tuple(simulated.current) == pytest.approx((own.Vx + 0.1, own.Vy - 0.2))


def test_thrust_varies_by_some_per_cent() -> None:
    simulated = SimulatedVehicle(vehicle.load("remus100"), START, sea.load("rough"), 1)
    strong = SimulatedVehicle(vehicle.load("remus100"), START)
    for _ in range(400):
        simulated.advance(Command(0.0, 6.48), 0.05)
        strong.advance(Command(0.0, 6.48), 0.05)
    assert simulated.motion.ur != strong.motion.ur
    assert simulated.motion.ur == pytest.approx(strong.motion.ur, rel=0.15)


@pytest.mark.parametrize(
    ("text", "place", "expected"),
    [
        ("name: x\ncurrents: {}\n", "currents", "only the documented keys"),
        ("name: x\nsensors: {position: {outliers: 1.5}}\n", "sensors.position.outliers", "at most 1"),
        ("name: x\nrudder: {dead_time: -1}\n", "rudder.dead_time", "at least 0"),
        ("name: x\ncurrent: {mean: [1]}\n", "current.mean[1]", "one more item"),
    ],
)
def test_a_file_with_a_mistake_is_refused_with_the_key(
    tmp_path, text: str, place: str, expected: str
) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        sea.load(str(file))
    assert caught.value.where == f"{file}: {place}"
    assert expected in caught.value.expected


def test_an_unknown_sea_is_refused_with_the_known_ones() -> None:
    with pytest.raises(ConfigurationError, match=r"no such sea file, expected .*rough"):
        sea.load("wild")


def test_a_command_in_revolutions_pushes_with_the_newtons_of_its_table() -> None:
    by_force = vehicle.load("remus100")
    by_revolutions = dataclasses.replace(
        by_force, thrust_unit="rpm", thrust_max=1500.0, thrust_table=((750.0, 1.62), (1500.0, 6.48))
    )
    tracks = []
    for hull, thrust in ((by_force, 4.05), (by_revolutions, 1125.0)):
        simulated = SimulatedVehicle(hull, PlantState(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        tracks.append([simulated.advance(Command(0.1, thrust), 0.05).motion for _ in range(200)])
    assert tracks[0][-1].ur > 1.0
    np.testing.assert_allclose(tracks[0], tracks[1], rtol=1e-12)
