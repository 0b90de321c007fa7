"""The vehicle that dives as a whole: ideal without a sea, and chosen by its stern planes."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.values.types import Current, SpatialCommand, SpatialCurrent
from auv_path_following import vehicle
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver, simulated_vehicle
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.hulls.spatial_plant import (
    spatial_ground_velocity,
    spatial_navigation_of,
    spatial_plant_at,
    spatial_plant_of,
    spatial_plant_step,
)
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle
from hulls import DIVER

START = body_at(1.0, 2.0, 10.0, 0.0, 0.1, 0.3, 1.9)
COMMANDS = [SpatialCommand(0.1 * math.sin(0.3 * k), 0.05 * math.cos(0.2 * k), 6.0) for k in range(200)]
CURRENT = SpatialCurrent(0.1, -0.2, 0.05)
NONE = SpatialCurrent(0.0, 0.0, 0.0)


def test_without_a_sea_it_is_the_plant_to_the_last_bit() -> None:
    simulated = SimulatedDiver(DIVER, START, current=CURRENT)
    config, plant = spatial_plant_of(DIVER), spatial_plant_at(START)
    for command in COMMANDS:
        over_ground = spatial_ground_velocity(plant.hull, CURRENT)
        assert simulated.navigation == spatial_navigation_of(plant.hull)
        assert simulated.water_velocity == (plant.hull.ur, plant.hull.vr, plant.hull.wr)
        assert (simulated.rudder, simulated.sternplanes) == (plant.rudder.angle, plant.sternplanes.angle)
        assert simulated.ground_velocity == simulated.seen[3:6] == over_ground
        assert simulated.truth == (spatial_navigation_of(plant.hull), *over_ground)
        assert (simulated.current, simulated.water_lock) == (CURRENT, True)
        assert math.isnan(simulated.altitude)
        assert simulated.advance(command, 0.05) is simulated.seen
        plant, _ = spatial_plant_step(config, plant, (command, CURRENT, 1.0), 0.05)
    assert simulated.motion == plant.hull


def test_reset_restarts_and_place_keeps_the_fins() -> None:
    simulated = SimulatedDiver(DIVER, START)
    simulated.advance(SpatialCommand(0.3, 0.2, 6.0), 0.5)
    rudder, sternplanes = simulated.rudder, simulated.sternplanes
    assert (rudder > 0.0, sternplanes > 0.0) == (True, True)
    simulated.place(START)
    assert simulated.motion == simulated.seen.motion == START
    assert (simulated.rudder, simulated.sternplanes) == (rudder, sternplanes)
    simulated.reset()
    assert (simulated.motion, simulated.rudder, simulated.sternplanes) == (START, 0.0, 0.0)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_current_carries_it_along_in_all_three_directions(side: float) -> None:
    """Down positive: a negative Vz lifts."""
    current = SpatialCurrent(0.2 * side, -0.1 * side, 0.05 * side)
    carried, still = SimulatedDiver(DIVER, START, current=current), SimulatedDiver(DIVER, START)
    for command in COMMANDS:
        carried.advance(command, 0.05)
        still.advance(command, 0.05)
    off = [carried.motion[k] - still.motion[k] for k in range(3)]
    assert off == pytest.approx([10.0 * speed for speed in current], abs=1e-9)
    assert carried.motion[3:] == pytest.approx(still.motion[3:], abs=1e-9)


def test_water_that_passes_a_held_vehicle_is_the_reversed_current_in_its_axes() -> None:
    """Bow up in a rising current: the water pushes against the keel, seen from below."""
    held = SimulatedDiver(
        DIVER, body_at(0.0, 0.0, 10.0, 0.0, 0.3, 0.0, 0.0), current=SpatialCurrent(0, 0, -0.1)
    )
    assert held.passing_water == pytest.approx((-0.1 * math.sin(0.3), 0.0, 0.1 * math.cos(0.3)))


def test_less_efficiency_is_less_thrust() -> None:
    config, state = spatial_plant_of(DIVER), spatial_plant_at(START)
    half, _ = spatial_plant_step(config, state, (SpatialCommand(0.0, 0.0, 6.0), NONE, 0.5), 0.05)
    same, _ = spatial_plant_step(config, state, (SpatialCommand(0.0, 0.0, 3.0), NONE, 1.0), 0.05)
    assert half == same


def test_stern_planes_choose_the_simulation() -> None:
    planar = vehicle.load("remus100")
    flat = PlantState(0.0, 0.0, 0.0, 1.9, 0.0, 0.0)
    assert (DIVER.dives, planar.dives) == (True, False)
    assert isinstance(simulated_vehicle(planar, flat), SimulatedVehicle)
    diver = simulated_vehicle(DIVER, START, current=Current(0.1, 0.2))
    assert isinstance(diver, SimulatedDiver)
    assert diver.current == (0.1, 0.2, 0.0)
    assert isinstance(diver.motion, BodyState)
    with pytest.raises(TypeError, match="starts from a BodyState"):
        simulated_vehicle(DIVER, flat)
    with pytest.raises(TypeError, match="starts from a PlantState"):
        simulated_vehicle(planar, START)


@pytest.mark.parametrize(("force", "sinks"), [(-12.0, True), (12.0, False)])
def test_ballast_sinks_the_hull_or_lifts_it(force: float, sinks: bool) -> None:
    diver = SimulatedDiver(vehicle.load("remus100_6dof"), body_at(0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 0.0))
    diver.ballast(force)
    for _ in range(200):
        seen = diver.advance(SpatialCommand(0.0, 0.0, 0.0), 0.05)
    assert (seen.navigation.z > 20.1) == sinks
    assert (seen.navigation.z < 19.9) != sinks


def test_a_hull_that_is_a_program_cannot_be_ballasted() -> None:
    diver = SimulatedDiver(vehicle.load("mss_remus100"), START)
    with pytest.raises(TypeError, match="without coefficients"):
        diver.ballast(-12.0)
