"""The simulated vehicle as its driver sees it: commands in, its own navigation out.

Without a sea the navigation is ideal, and the water moves only with the given current. With a sea,
instruments, navigator and servo have errors, and the truth is available separately.
"""

from __future__ import annotations

import math
from typing import Any, Generic, NamedTuple, TypeVar

from auv_msgs_py.values.pure import dispatched, pure
from auv_msgs_py.values.types import (
    NO_CURRENT,
    STOP,
    Command,
    Current,
    Navigation,
    WaterVelocity,
)
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.at_sea import Seen, VehicleAtSea, at_sea_of, measure_at_sea, step_at_sea
from auv_sim.vehicle.diving.diver_at_sea import SpatialVehicleAtSea, measure_diver_at_sea, step_diver_at_sea
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen, measure_ideally, step_ideally
from auv_sim.vehicle.draws import Draws
from auv_sim.vehicle.hulls.spatial_plant import SpatialPlant
from auv_sim.vehicle.remus import (
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
from auv_sim.vehicle.sea import Sea

#: Steps after which random numbers are drawn anew.
_BLOCK = 1000


@pure
def measure(config: Plant, state: Afloat, inputs: PlantInputs, dt: float) -> tuple[Afloat, Seen]:
    """Return ideal measurements, without velocity over ground."""
    hull, (_, current, _) = state.hull, inputs
    water = WaterVelocity(hull.ur, hull.vr)
    seen = Seen(navigation_of(hull), water, True, math.nan, math.nan, hull, state.servo.angle, current)
    return state, seen


@pure
def step(config: Plant, state: Afloat, inputs: PlantInputs, dt: float) -> tuple[Afloat, Seen]:
    """Advance by `dt` seconds under a held command and current, then measure."""
    state, _ = plant_step(config, state, inputs, dt)
    return measure(config, state, inputs, dt)


#: The first measurement of a vehicle, and one step of it: (configuration, state, `PlantInputs` with the
#: constant current, dt) -> (state, `Seen`). Without a sea there is no cost for one. For a vehicle that dives,
#: `SpatialPlantInputs` and `SpatialSeen`.
vehicle_measure = dispatched(
    {
        Plant: measure,
        VehicleAtSea: measure_at_sea,
        SpatialPlant: measure_ideally,
        SpatialVehicleAtSea: measure_diver_at_sea,
    }
)
vehicle_step = dispatched(
    {
        Plant: step,
        VehicleAtSea: step_at_sea,
        SpatialPlant: step_ideally,
        SpatialVehicleAtSea: step_diver_at_sea,
    }
)

Motion = TypeVar("Motion")
Order = TypeVar("Order")
Flow = TypeVar("Flow")
View = TypeVar("View", bound=Seen | SpatialSeen)


class Kind(NamedTuple):
    """What differs between vehicles: the command to stop; makers of plant, its state, and both at sea."""

    stop: Any
    plant_of: Any
    plant_at: Any
    at_sea_of: Any


class Simulated(Generic[Motion, Order, Flow, View]):
    """Hull, water, instruments and navigator under one clock."""

    kind: Kind

    def __init__(
        self, vehicle: Vehicle, initial: Motion, sea: Sea | None, seed: int, current: Flow, step: float
    ) -> None:
        self._vehicle, self._initial, self._sea, self._seed = vehicle, initial, sea, seed
        self._step = step
        self.constant_current = current
        self.reset()

    def reset(self) -> None:
        """Restart the same run."""
        self._left = _BLOCK
        self._config: Any
        self.state: Any
        self.seen: View
        kind = self.kind
        if self._sea is None:
            self._config = kind.plant_of(self._vehicle)
            self.state = kind.plant_at(self._initial, self._config)
        else:
            # One more step for the first measurement.
            self._draws = Draws(self._step, _BLOCK + 1)
            self._config, self.state = kind.at_sea_of(
                self._vehicle, self._initial, self._sea, self._seed, self._draws
            )
        inputs = kind.stop, self.constant_current, 1.0
        self.state, self.seen = vehicle_measure(self._config, self.state, inputs, 0.0)

    def advance(self, command: Order, dt: float) -> View:
        """Advance by `dt` seconds under a held command, its thrust in the vehicle's unit, then measure.

        Returns:
            The measurements, which `seen` keeps.

        Raises:
            ValueError: at sea, `dt` is not the step of the random numbers and rings.
        """
        if self._sea is not None:
            if dt != self._step:
                raise ValueError(
                    f"dt: found {dt:g} s, expected the step of this run at sea, {self._step:g} s"
                )
            if self._left == 0:
                self._draws.refill(self._config.memory)
                self._left = _BLOCK
            self._left -= 1
        if self._vehicle.thrust_unit != "N":
            order: Any = command
            command = order._replace(thrust=self._vehicle.newtons(order.thrust))
        inputs = command, self.constant_current, 1.0
        self.state, self.seen = vehicle_step(self._config, self.state, inputs, dt)
        return self.seen

    def place(self, motion: Motion) -> None:
        """Move the hull; servos, instruments and navigator keep their state."""
        afloat = self._afloat._replace(hull=motion)
        self.state = afloat if self._sea is None else self.state._replace(afloat=afloat)
        if self._sea is None:
            inputs = self.kind.stop, self.constant_current, 1.0
            self.state, self.seen = vehicle_measure(self._config, afloat, inputs, 0.0)

    @property
    def _afloat(self) -> Any:
        return self.state if self._sea is None else self.state.afloat

    @property
    def motion(self) -> Motion:
        """True pose and velocity through the water."""
        return self._afloat.hull  # type: ignore[no-any-return]

    @property
    def rudder(self) -> float:
        """Measured rudder angle, rad."""
        return self.seen.rudder

    @property
    def water_lock(self) -> bool:
        """Whether `water_velocity` was measured now; otherwise it is the last measurement."""
        return self.seen.water_lock


class SimulatedVehicle(Simulated[PlantState, Command, Current, Seen]):
    """A vehicle in the horizontal plane. The node and `closed_loop` both drive this.

    Args:
        vehicle: hull, rudder, thruster.
        initial: first state, also after a reset.
        sea: imperfections; None: an ideal sea.
        seed: of its random numbers.
        current: constant current, m/s, NED, added to the sea's own; may be changed at any time.
        step: time of each `advance` at sea, s.
    """

    kind = Kind(STOP, plant_of, plant_at, at_sea_of)

    def __init__(
        self,
        vehicle: Vehicle,
        initial: PlantState,
        sea: Sea | None = None,
        seed: int = 0,
        current: Current = NO_CURRENT,
        step: float = 0.05,
    ) -> None:
        super().__init__(vehicle, initial, sea, seed, current, step)

    @property
    def navigation(self) -> Navigation:
        """Navigation reported by the vehicle."""
        return self.seen.navigation

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
        """Velocity through the water reported by the log, m/s, FRD."""
        return self.seen.water

    @property
    def current(self) -> Current:
        """The true current where the vehicle is, m/s, NED."""
        constant = self.constant_current
        if self._sea is None:
            return constant
        own = self.state.own
        return Current(constant.Vx + own.Vx, constant.Vy + own.Vy)

    @property
    def ground_velocity(self) -> tuple[float, float]:
        """(u, v) over ground in the body frame, m/s, as measured; NaN without bottom lock."""
        if self._sea is None:
            return ground_velocity(self.motion, self.constant_current)
        return self.seen.u, self.seen.v
