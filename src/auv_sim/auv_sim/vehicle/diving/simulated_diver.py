"""A vehicle that dives as its driver sees it, and the choice between it and one in the plane."""

from __future__ import annotations

from auv_msgs_py.values.attitude import quaternion_of
from auv_msgs_py.values.types import (
    NO_CURRENT,
    NO_SPATIAL_CURRENT,
    SPATIAL_STOP,
    Current,
    SpatialCommand,
    SpatialCurrent,
    SpatialNavigation,
    SpatialWater,
)
from auv_path_following.vehicle import Vehicle
from auv_sim.vehicle.diving.diver_at_sea import spatial_at_sea_of
from auv_sim.vehicle.diving.ideal_diver import SpatialSeen
from auv_sim.vehicle.hulls.remus_6dof import Remus6dof
from auv_sim.vehicle.hulls.rigid_body import BodyState, to_body
from auv_sim.vehicle.hulls.spatial_plant import (
    spatial_ground_velocity,
    spatial_navigation_of,
    spatial_plant_at,
    spatial_plant_of,
)
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.simulated import Kind, Simulated, SimulatedVehicle


class SimulatedDiver(Simulated[BodyState, SpatialCommand, SpatialCurrent, SpatialSeen]):
    """A vehicle that dives; arguments as those of `SimulatedVehicle`.

    Raises:
        ConfigurationError: the vehicle file lacks stern planes or coefficients.
    """

    kind = Kind(SPATIAL_STOP, spatial_plant_of, spatial_plant_at, spatial_at_sea_of)

    def __init__(
        self,
        vehicle: Vehicle,
        initial: BodyState,
        sea: Sea | None = None,
        seed: int = 0,
        current: SpatialCurrent = NO_SPATIAL_CURRENT,
        step: float = 0.05,
    ) -> None:
        super().__init__(vehicle, initial, sea, seed, current, step)

    def ballast(self, force: float) -> None:
        """Change the buoyancy in flight until the next reset: water that comes in, or weight that is lost.

        Args:
            force: N, up positive.

        Raises:
            TypeError: a hull that is a program has no buoyancy that can be changed.
        """
        plant = self._config if self._sea is None else self._config.plant
        if not isinstance(plant.hull, Remus6dof):
            raise TypeError(f"{self._vehicle.name}: a hull without coefficients cannot be ballasted")
        terms = plant.hull.terms
        plant = plant._replace(hull=plant.hull._replace(terms=terms._replace(B=terms.B + force)))
        self._config = plant if self._sea is None else self._config._replace(plant=plant)

    @property
    def navigation(self) -> SpatialNavigation:
        """Navigation reported by the vehicle."""
        return self.seen.navigation

    @property
    def truth(self) -> tuple[SpatialNavigation, float, float, float]:
        """True navigation, and true (u, v, w) over ground, m/s."""
        return spatial_navigation_of(self.motion), *spatial_ground_velocity(self.motion, self.current)

    @property
    def passing_water(self) -> SpatialWater:
        """Velocity through the water while held over ground: the reversed current, m/s, FRD."""
        n, (Vx, Vy, Vz) = self.navigation, self.current
        return SpatialWater(*to_body(*quaternion_of(n.phi, n.theta, n.psi), -Vx, -Vy, -Vz))

    @property
    def water_velocity(self) -> SpatialWater:
        """Velocity through the water reported by the log, m/s, FRD."""
        return self.seen.water

    @property
    def current(self) -> SpatialCurrent:
        """The true current where the vehicle is, m/s, NED."""
        constant = self.constant_current
        if self._sea is None:
            return constant
        own = self.state.own
        return SpatialCurrent(constant.Vx + own.Vx, constant.Vy + own.Vy, constant.Vz + own.Vz)

    @property
    def ground_velocity(self) -> tuple[float, float, float]:
        """(u, v, w) over ground in the body frame, m/s, as measured; NaN without bottom lock."""
        if self._sea is None:
            return spatial_ground_velocity(self.motion, self.constant_current)
        return self.seen.u, self.seen.v, self.seen.w

    @property
    def sternplanes(self) -> float:
        """Measured angle of the stern planes, rad."""
        return self.seen.sternplanes

    @property
    def altitude(self) -> float:
        """Measured range to the bottom along body z, m; infinite: no echo; NaN: no altimeter."""
        return self.seen.altitude


def simulated_vehicle(
    vehicle: Vehicle,
    initial: PlantState | BodyState,
    sea: Sea | None = None,
    seed: int = 0,
    current: Current | SpatialCurrent | None = None,
    step: float = 0.05,
) -> SimulatedVehicle | SimulatedDiver:
    """Return the simulation of a vehicle: in three dimensions if it has stern planes.

    Args:
        vehicle, sea, seed, step: as in `SimulatedVehicle`.
        initial: first state; a `BodyState` for a vehicle that dives.
        current: constant, m/s, NED; none by default. For a vehicle that dives, a `Current` is horizontal.

    Raises:
        TypeError: the first state or the current is not of the vehicle's kind.
    """
    if not vehicle.dives:
        if not isinstance(initial, PlantState) or isinstance(current, SpatialCurrent):
            raise TypeError(f"{vehicle.name}: a vehicle in the plane starts from a PlantState in a Current")
        return SimulatedVehicle(vehicle, initial, sea, seed, current or NO_CURRENT, step)
    if not isinstance(initial, BodyState):
        raise TypeError(f"{vehicle.name}: a vehicle that dives starts from a BodyState")
    if isinstance(current, Current):
        current = SpatialCurrent(current.Vx, current.Vy, 0.0)
    return SimulatedDiver(vehicle, initial, sea, seed, current or NO_SPATIAL_CURRENT, step)
