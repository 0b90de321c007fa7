"""A vehicle that dives in a sea with imperfections, in one step.

Water, bottom, propeller, servos, instruments and navigator.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import NO_SPATIAL_CURRENT, SpatialCurrent
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.diving.bottom import Bottom, bottom_of
from auv_sim.vehicle.diving.diver_navigator import (
    SpatialNavigator,
    SpatialNavigatorState,
    navigate_in_space,
    spatial_navigator_at,
    spatial_navigator_of,
)
from auv_sim.vehicle.diving.diver_sensors import (
    SpatialSensors,
    SpatialSensorsState,
    sense_in_space,
    spatial_sensors_of,
)
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen
from auv_sim.vehicle.diving.water_column import (
    Deviation,
    WaterColumn,
    flow_at_depth,
    vary_column,
    water_column_of,
)
from auv_sim.vehicle.draws import Draws, Now, RunMemory
from auv_sim.vehicle.fins.actuator import FlawedServoState, RudderFlaws, flawed_servo_of
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.hulls.spatial_plant import (
    SpatialAfloat,
    SpatialPlant,
    SpatialPlantInputs,
    spatial_ground_velocity,
    spatial_plant_of,
    spatial_plant_step,
)
from auv_sim.vehicle.noise import Noise, noise, noise_of
from auv_sim.vehicle.sea import Sea


class SpatialVehicleAtSea(NamedTuple):
    """Configuration of a vehicle that dives in one run at sea; `memory` is written to."""

    plant: SpatialPlant
    water: WaterColumn
    bottom: Bottom
    propeller: Noise
    sensors: SpatialSensors
    navigator: SpatialNavigator
    memory: RunMemory


class SpatialAtSea(NamedTuple):
    """State of a vehicle that dives at sea.

    Attributes:
        afloat: of hull and servos.
        own: the sea's own current where the vehicle is, m/s, NED.
        deviation: of the water from its mean.
        propeller: drift of its efficiency.
        sensors, navigator: their states.
        time: since the start, s.
        k: number of the next measurement.
    """

    afloat: SpatialAfloat
    own: SpatialCurrent
    deviation: Deviation
    propeller: float
    sensors: SpatialSensorsState
    navigator: SpatialNavigatorState
    time: float
    k: int


def spatial_at_sea_of(
    vehicle: Vehicle, initial: BodyState, sea: Sea, seed: int, draws: Draws
) -> tuple[SpatialVehicleAtSea, SpatialAtSea]:
    """Return configuration and first state of a vehicle at sea, with all numbers of `draws` drawn.

    Args:
        vehicle: hull, fins, thruster.
        initial: first state of the hull.
        sea: its imperfections.
        seed: of its random numbers; errors that a vehicle in the plane has too are those of its seed.
        draws: an empty layout of the run, for lists or arrays.

    Raises:
        ConfigurationError: the vehicle file lacks stern planes or coefficients.
    """
    initial = BodyState(*map(float, initial))
    plant = _flawed(spatial_plant_of(vehicle), vehicle, (sea.rudder, sea.sternplanes), draws)
    water, deviation = water_column_of(sea.current, (seed, 0), draws)
    propeller, drift = noise_of(sea.thrust, (seed, 1), draws)
    sensors, sensors_state = spatial_sensors_of(sea.sensors, (seed, 2), draws)
    navigator = spatial_navigator_of(sea.navigator, sensors, draws)
    off_x, off_y = (draws.generator((seed, 3)).standard_normal(2) * sea.navigator.start).tolist()
    bottom = bottom_of(sea.bottom, draws)
    config = SpatialVehicleAtSea(plant, water, bottom, propeller, sensors, navigator, draws.memory())
    begin = spatial_navigator_at(navigator, initial.x + off_x, initial.y + off_y)
    afloat = SpatialAfloat(initial, FlawedServoState(), FlawedServoState())
    first = SpatialAtSea(afloat, NO_SPATIAL_CURRENT, deviation, drift, sensors_state, begin, 0.0, 0)
    return config, first


def _flawed(
    plant: SpatialPlant, vehicle: Vehicle, flaws: tuple[RudderFlaws, RudderFlaws], draws: Draws
) -> SpatialPlant:
    """Return the plant with flaws of the servos of rudder and stern planes."""
    assert vehicle.sternplanes is not None  # `spatial_plant_of` refuses such a vehicle
    servos = [
        flawed_servo_of(limits, flawed, draws.step)
        for limits, flawed in zip((vehicle.rudder, vehicle.sternplanes), flaws, strict=True)
    ]
    rudder, sternplanes = (servo._replace(ring=draws.table(2 * servo.size)) for servo in servos)
    return plant._replace(rudder=rudder, sternplanes=sternplanes)


@pure
def measure_diver_at_sea(
    config: SpatialVehicleAtSea, state: SpatialAtSea, inputs: SpatialPlantInputs, dt: float
) -> tuple[SpatialAtSea, SpatialSeen]:
    """Advance the sea and measure, `dt` seconds after the last measurement; 0 for the first.

    Args:
        config, state: of the vehicle.
        inputs: with the constant current, m/s, NED, added to the sea's own.
        dt: s.
    """
    _, constant, _ = inputs
    return _measure(config, state, state.afloat, state.propeller, constant, dt)


@pure
def step_diver_at_sea(
    config: SpatialVehicleAtSea, state: SpatialAtSea, inputs: SpatialPlantInputs, dt: float
) -> tuple[SpatialAtSea, SpatialSeen]:
    """Advance by `dt` seconds under a held command, then measure as `measure_diver_at_sea`."""
    own, (command, constant, _) = state.own, inputs
    propeller, error = noise(config.propeller, state.propeller, config.memory, dt)
    current = SpatialCurrent(constant.Vx + own.Vx, constant.Vy + own.Vy, constant.Vz + own.Vz)
    afloat, _ = spatial_plant_step(config.plant, state.afloat, (command, current, max(1.0 + error, 0.0)), dt)
    return _measure(config, state, afloat, propeller, constant, dt)


@pure
def _measure(
    config: SpatialVehicleAtSea, state: SpatialAtSea, afloat: SpatialAfloat, propeller: float,
    constant: SpatialCurrent, dt: float,
) -> tuple[SpatialAtSea, SpatialSeen]:  # fmt: skip
    body, rudder, sternplanes = afloat
    memory, time, k = config.memory, state.time + dt, state.k
    now = Now(memory, time, k)
    deviation = vary_column(config.water, state.deviation, memory, dt)
    own = flow_at_depth(config.water, deviation, body.x, body.y, body.z, time)
    current = SpatialCurrent(constant.Vx + own.Vx, constant.Vy + own.Vy, constant.Vz + own.Vz)
    over_ground = spatial_ground_velocity(body, current)
    sensors, measured = sense_in_space(
        config.sensors, state.sensors, body, over_ground, config.bottom, now, dt
    )
    navigator, navigation = navigate_in_space(config.navigator, state.navigator, measured, now, dt)
    u, v, w = measured.ground if measured.bottom_lock else (math.nan, math.nan, math.nan)
    seen = SpatialSeen(
        navigation, measured.water, measured.water_lock, u, v, w, measured.altitude, body, rudder.angle,
        sternplanes.angle, current,
    )  # fmt: skip
    return SpatialAtSea(afloat, own, deviation, propeller, sensors, navigator, time, k + 1), seen
