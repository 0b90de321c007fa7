"""The vehicle in a sea with imperfections: water, propeller, servo, instruments and navigator in one step."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.currents import Water, flow, vary, water_of
from auv_sim.vehicle.draws import Draws, Now, RunMemory
from auv_sim.vehicle.fins.actuator import FlawedServoState, flawed_servo_of
from auv_sim.vehicle.navigator import Navigator, NavigatorState, navigate, navigator_at, navigator_of
from auv_sim.vehicle.noise import Noise, noise, noise_of
from auv_sim.vehicle.remus import (
    Afloat,
    Plant,
    PlantInputs,
    PlantState,
    ground_velocity,
    plant_of,
    plant_step,
)
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.sensors import Sensors, SensorsState, sense, sensors_of


class VehicleAtSea(NamedTuple):
    """Configuration of a vehicle in one run at sea; `memory` is written to."""

    plant: Plant
    water: Water
    propeller: Noise
    sensors: Sensors
    navigator: Navigator
    memory: RunMemory


class AtSea(NamedTuple):
    """State of a vehicle at sea.

    Attributes:
        afloat: of hull and servo.
        own: the sea's own current where the vehicle is, m/s, NED.
        north, east: variation of the water, m/s.
        propeller: drift of its efficiency.
        sensors, navigator: their states.
        time: since the start, s.
        k: number of the next measurement.
    """

    afloat: Afloat
    own: Current
    north: float
    east: float
    propeller: float
    sensors: SensorsState
    navigator: NavigatorState
    time: float
    k: int


class Seen(NamedTuple):
    """A vehicle's measurements and the truth behind them.

    Attributes:
        navigation: reported by the vehicle, NED.
        water: velocity through the water, reported by its log, m/s, FRD.
        water_lock: whether it was measured now; otherwise it is the last measurement.
        u, v: measured velocity over ground, m/s, FRD; NaN without bottom lock or without a measurement.
        motion: true pose and velocity through the water.
        rudder: measured angle of the servo, rad.
        current: true current where the vehicle is, m/s, NED.
    """

    navigation: Navigation
    water: WaterVelocity
    water_lock: bool
    u: float
    v: float
    motion: PlantState
    rudder: float
    current: Current


def at_sea_of(
    vehicle: Vehicle, initial: PlantState, sea: Sea, seed: int, draws: Draws
) -> tuple[VehicleAtSea, AtSea]:
    """Return configuration and first state of a vehicle at sea, with all numbers of `draws` drawn.

    Args:
        vehicle: hull, rudder, thruster.
        initial: first state of the hull.
        sea: its imperfections.
        seed: of its random numbers.
        draws: an empty layout of the run, for lists or arrays.
    """
    initial = PlantState(*map(float, initial))
    servo = flawed_servo_of(vehicle.rudder, sea.rudder, draws.step)
    plant = plant_of(vehicle)._replace(servo=servo._replace(ring=draws.table(2 * servo.size)))
    water, north, east = water_of(sea.current, (seed, 0), draws)
    propeller, drift = noise_of(sea.thrust, (seed, 1), draws)
    sensors, sensors_state = sensors_of(sea.sensors, (seed, 2), draws)
    navigator = navigator_of(sea.navigator, sensors.position, draws)
    off_x, off_y = (draws.generator((seed, 3)).standard_normal(2) * sea.navigator.start).tolist()
    config = VehicleAtSea(plant, water, propeller, sensors, navigator, draws.memory())
    begin = navigator_at(navigator, initial.x + off_x, initial.y + off_y)
    afloat = Afloat(initial, FlawedServoState())
    return config, AtSea(afloat, Current(0.0, 0.0), north, east, drift, sensors_state, begin, 0.0, 0)


@pure
def measure_at_sea(config: VehicleAtSea, state: AtSea, inputs: PlantInputs, dt: float) -> tuple[AtSea, Seen]:
    """Advance the sea and measure, `dt` seconds after the last measurement; 0 for the first.

    Args:
        config, state: of the vehicle.
        inputs: with the constant current, m/s, NED, added to the sea's own.
        dt: s.
    """
    _, constant, _ = inputs
    return _measure(config, state, state.afloat, state.propeller, constant, dt)


@pure
def step_at_sea(config: VehicleAtSea, state: AtSea, inputs: PlantInputs, dt: float) -> tuple[AtSea, Seen]:
    """Advance by `dt` seconds under a held command, then measure as `measure_at_sea`."""
    own, (command, constant, _) = state.own, inputs
    propeller, error = noise(config.propeller, state.propeller, config.memory, dt)
    current = Current(constant.Vx + own.Vx, constant.Vy + own.Vy)
    inside = command, current, max(1.0 + error, 0.0)
    afloat, _ = plant_step(config.plant, state.afloat, inside, dt)
    return _measure(config, state, afloat, propeller, constant, dt)


@pure
def _measure(
    config: VehicleAtSea, state: AtSea, afloat: Afloat, propeller: float, constant: Current, dt: float
) -> tuple[AtSea, Seen]:
    motion, servo = afloat
    memory, time, k = config.memory, state.time + dt, state.k
    now = Now(memory, time, k)
    north, east = vary(config.water, state.north, state.east, memory, dt)
    own = flow(config.water, north, east, motion.x, motion.y, time)
    current = Current(constant.Vx + own.Vx, constant.Vy + own.Vy)
    u, v = ground_velocity(motion, current)
    sensors, measured = sense(config.sensors, state.sensors, motion, u, v, now, dt)
    navigator, navigation = navigate(config.navigator, state.navigator, measured, now, dt)
    u, v = (measured.u, measured.v) if measured.bottom_lock else (math.nan, math.nan)
    seen = Seen(navigation, measured.water, measured.water_lock, u, v, motion, servo.angle, current)
    return AtSea(afloat, own, north, east, propeller, sensors, navigator, time, k + 1), seen
