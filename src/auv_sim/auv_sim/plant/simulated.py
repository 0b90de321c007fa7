"""The simulated vehicle as its driver sees it: commands in, its own navigation out.

Without a sea the navigation is ideal and the water moves as it is told. With one, instruments measure, the
navigator fuses, the servo has play, and only `true_navigation` knows where the vehicle really is.
"""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.types import NO_CURRENT, Command, Current, Navigation, WaterVelocity
from auv_path_following.vehicle import Vehicle
from auv_sim.plant.actuator import FlawedServoState, flawed_servo_of
from auv_sim.plant.currents import WaterCurrent
from auv_sim.plant.navigator import Navigator, NavigatorOutput
from auv_sim.plant.noise import Noise
from auv_sim.plant.remus import (
    Afloat,
    Plant,
    PlantInputs,
    PlantState,
    ground_velocity,
    navigation_of,
    plant_at,
    plant_of,
    plant_step,
)
from auv_sim.plant.sea import Sea
from auv_sim.plant.sensors import Measurements, Sensors, Truth

#: Shortest time between two commands at sea, s.
_SHORTEST_STEP = 0.001


class SimulatedVehicle:
    """Hull, water, instruments and navigator under one clock. The node and `closed_loop` both drive this.

    Args:
        vehicle: hull, rudder, thruster.
        initial: state to begin with, and to go back to on reset.
        sea: what is not ideal; None: nothing.
        seed: of everything that is random in it.
        current: constant current, m/s, NED, on top of the sea's own; may be changed at any time.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        initial: PlantState,
        sea: Sea | None = None,
        seed: int = 0,
        current: Current = NO_CURRENT,
    ) -> None:
        self._config, self._initial = plant_of(vehicle), plant_at(initial)
        if sea is not None:
            servo = flawed_servo_of(vehicle.rudder, sea.rudder, _SHORTEST_STEP)
            self._config = self._config._replace(servo=servo)
            self._initial = Afloat(self._initial.hull, FlawedServoState())
        self.constant_current = current
        self._at_sea = _AtSea(sea, seed) if sea else None
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        self.state = self._initial
        if self._at_sea is not None:
            self._at_sea.reset(self.motion, self.constant_current)

    @property
    def motion(self) -> PlantState:
        """True pose and velocity through the water."""
        return self.state.hull  # type: ignore[no-any-return]

    def place(self, motion: PlantState) -> None:
        """Move the hull; servo, instruments and navigator keep their state."""
        self.state = Afloat(motion, self.state.servo)

    @property
    def rudder(self) -> float:
        """The rudder angle that its servo measures, rad."""
        return self.state.servo.angle  # type: ignore[no-any-return]

    def advance(self, command: Command, dt: float) -> None:
        """Let `dt` seconds pass under a held command, then measure."""
        if self._at_sea is None:
            inputs = PlantInputs(command, self.constant_current)
            self.state, _ = plant_step(self._config, self.state, inputs, dt)
        else:
            self.state = self._at_sea.advance(self._config, self.state, command, dt, self.constant_current)

    @property
    def navigation(self) -> Navigation:
        """Navigation as the vehicle reports it."""
        return navigation_of(self.motion) if self._at_sea is None else self._at_sea.output.navigation

    @property
    def truth(self) -> tuple[Navigation, float, float]:
        """True navigation, and true (u, v) over ground, m/s."""
        return navigation_of(self.motion), *ground_velocity(self.motion, self.current)

    @property
    def passing_water(self) -> WaterVelocity:
        """Velocity through the water while held over ground: the reversed current, m/s, FRD."""
        psi, (Vx, Vy) = self.navigation.psi, self.current
        cos, sin = math.cos(psi), math.sin(psi)
        return WaterVelocity(-cos * Vx - sin * Vy, sin * Vx - cos * Vy)

    @property
    def water_velocity(self) -> WaterVelocity:
        """Velocity through the water as its log reports it, m/s, FRD."""
        if self._at_sea is not None:
            return self._at_sea.measured.water
        motion = self.motion
        return WaterVelocity(motion.ur, motion.vr)

    @property
    def water_lock(self) -> bool:
        """Whether that was measured; else it is the last that was."""
        return self._at_sea is None or self._at_sea.measured.water_lock

    @property
    def current(self) -> Current:
        """The true current where the vehicle is, m/s, NED."""
        own = self._at_sea.current if self._at_sea else NO_CURRENT
        return _sum(self.constant_current, own) if self._at_sea else self.constant_current

    @property
    def ground_velocity(self) -> tuple[float, float]:
        """(u, v) over ground in the body frame, m/s, as measured; NaN without bottom lock."""
        if self._at_sea is None:
            return ground_velocity(self.motion, self.constant_current)
        return self._at_sea.output.u, self._at_sea.output.v


class _AtSea:
    """What is random about a vehicle."""

    current: Current
    measured: Measurements
    output: NavigatorOutput

    def __init__(self, sea: Sea, seed: int) -> None:
        self._start, self._seed = sea.navigator.start, (seed, 3)
        self._water = WaterCurrent(sea.current, (seed, 0))
        self._propeller = Noise(sea.thrust, (seed, 1))
        self._sensors = Sensors(sea.sensors, (seed, 2))
        self._navigator = Navigator(sea.navigator)

    def reset(self, motion: PlantState, constant: Current) -> None:
        for part in (self._water, self._propeller, self._sensors):
            part.reset()
        off = np.random.default_rng(self._seed).standard_normal(2) * self._start
        self._navigator.reset(motion.x + float(off[0]), motion.y + float(off[1]))
        self._sense(motion, constant, 0.0)

    def advance(self, plant: Plant, state: Afloat, command: Command, dt: float, constant: Current) -> Afloat:
        efficiency = max(1.0 + self._propeller.update(dt), 0.0)
        inputs = PlantInputs(command, _sum(constant, self.current), efficiency)
        state, motion = plant_step(plant, state, inputs, dt)
        self._sense(motion, constant, dt)
        return state

    def _sense(self, motion: PlantState, constant: Current, dt: float) -> None:
        x, y, psi, ur, vr, r = motion
        self.current = self._water.update(x, y, dt)
        u, v = ground_velocity(motion, _sum(constant, self.current))
        self.measured = self._sensors.update(Truth(x, y, psi, r, ur, vr, u, v), dt)
        self.output = self._navigator.update(self.measured, dt)


def _sum(one: Current, other: Current) -> Current:
    return Current(one.Vx + other.Vx, one.Vy + other.Vy)
