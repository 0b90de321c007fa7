"""The simulated vehicle as its driver sees it: commands in, its own navigation out.

Without a sea the navigation is ideal and the water moves as it is told. With one, instruments measure, the
navigator fuses, the servo has play, and only `true_navigation` knows where the vehicle really is.
"""

from __future__ import annotations

import math

import numpy as np

from auv_msgs_py.types import NO_CURRENT, Command, Current, Navigation, WaterVelocity
from auv_path_following.vehicle import Vehicle
from auv_sim.plant.currents import WaterCurrent
from auv_sim.plant.navigator import Navigator, NavigatorOutput
from auv_sim.plant.noise import Noise
from auv_sim.plant.remus import PlantState, RemusPlant
from auv_sim.plant.sea import Sea
from auv_sim.plant.sensors import Measurements, Sensors, Truth


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
        self.plant = RemusPlant(vehicle, initial, flaws=sea.rudder if sea else None)
        self.constant_current = current
        self._at_sea = _AtSea(sea, seed) if sea else None
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        self.plant.reset()
        if self._at_sea is not None:
            self._at_sea.reset(self.plant, self.constant_current)

    @property
    def rudder(self) -> float:
        """The rudder angle that its servo measures, rad."""
        return self.plant.rudder.angle

    def advance(self, command: Command, dt: float) -> None:
        """Let `dt` seconds pass under a held command, then measure."""
        if self._at_sea is None:
            self.plant.advance(command, dt, self.constant_current)
        else:
            self._at_sea.advance(self.plant, command, dt, self.constant_current)

    @property
    def navigation(self) -> Navigation:
        """The vehicle's own opinion of where it is."""
        return self.plant.navigation if self._at_sea is None else self._at_sea.output.navigation

    @property
    def truth(self) -> tuple[Navigation, float, float]:
        """Where it really is, and its true (u, v) over ground, m/s."""
        return self.plant.navigation, *self.plant.ground_velocity(self.current)

    @property
    def passing_water(self) -> WaterVelocity:
        """Velocity through the water while held over ground: the reversed current, m/s, FRD."""
        psi, (Vx, Vy) = self.navigation.psi, self.current
        cos, sin = math.cos(psi), math.sin(psi)
        return WaterVelocity(-cos * Vx - sin * Vy, sin * Vx - cos * Vy)

    @property
    def water_velocity(self) -> WaterVelocity:
        """What its log tells of the water."""
        return self.plant.water_velocity if self._at_sea is None else self._at_sea.measured.water

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
            return self.plant.ground_velocity(self.constant_current)
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

    def reset(self, plant: RemusPlant, constant: Current) -> None:
        for part in (self._water, self._propeller, self._sensors):
            part.reset()
        off = np.random.default_rng(self._seed).standard_normal(2) * self._start
        self._navigator.reset(plant.state.x + float(off[0]), plant.state.y + float(off[1]))
        self._sense(plant, constant, 0.0)

    def advance(self, plant: RemusPlant, command: Command, dt: float, constant: Current) -> None:
        efficiency = max(1.0 + self._propeller.update(dt), 0.0)
        plant.advance(command, dt, _sum(constant, self.current), efficiency)
        self._sense(plant, constant, dt)

    def _sense(self, plant: RemusPlant, constant: Current, dt: float) -> None:
        x, y, psi, ur, vr, r = plant.state
        self.current = self._water.update(x, y, dt)
        u, v = plant.ground_velocity(_sum(constant, self.current))
        self.measured = self._sensors.update(Truth(x, y, psi, r, ur, vr, u, v), dt)
        self.output = self._navigator.update(self.measured, dt)


def _sum(one: Current, other: Current) -> Current:
    return Current(one.Vx + other.Vx, one.Vy + other.Vy)
