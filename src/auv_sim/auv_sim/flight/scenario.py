"""The complete configuration of one flight."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from auv_msgs_py.values.types import NO_CURRENT, Current, SpatialCurrent
from auv_path_following.comparators.mss_pilot import MssPilot
from auv_path_following.control.autopilot import AutopilotConfig
from auv_path_following.control.pitch_plane import pitch_gains
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.spatial.vertical_modes import FOLLOW_PATH
from auv_path_following.navigation.current_observer import CurrentObserverConfig
from auv_path_following.vehicle import Vehicle
from auv_sim.sim_parameters import CRUISE
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sea import Sea


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """The complete configuration of one flight.

    A vehicle with stern planes flies in three dimensions; a planar path is then at its surface depth.

    Attributes:
        path: what to follow; with `spatial` its plan.
        vehicle: the plant's hull.
        thrust: N, while the mission runs.
        initial: the plant's first state; the path's start at cruising speed if None.
        current: constant current, m/s, NED, added to the sea's own.
        sea: imperfections; None: an ideal sea.
        seed: of the sea's random numbers.
        step: time between odometries, s.
        command_delay: added to the dead time of the plant's fins, s; of any length.
        guidance, observer, autopilot: laws and gains.
        pitch: gains of the pitch autopilot, for a vehicle that dives.
        mode: what the vertical plane follows, of `vertical_modes.vertical_step`.
        controller_vehicle: the hull that guidance and autopilots assume; the plant's own if None.
        time_limit: latest end of the flight, s.
        spatial: what to follow, in three dimensions.
        peer: gains of the law of MSS, which then replaces observer, guidance and autopilot: along straight
            legs, in the plane.
    """

    path: CompositePath
    vehicle: Vehicle
    thrust: float
    initial: PlantState | BodyState | None = None
    current: Current | SpatialCurrent = NO_CURRENT
    sea: Sea | None = None
    seed: int = 0
    step: float = 0.05
    command_delay: float = 0.0
    guidance: PathFollowerConfig = field(default_factory=PathFollowerConfig)
    observer: CurrentObserverConfig = field(default_factory=CurrentObserverConfig)
    autopilot: AutopilotConfig = field(default_factory=AutopilotConfig)
    pitch: AutopilotConfig = field(default_factory=pitch_gains)
    mode: Any = FOLLOW_PATH
    controller_vehicle: Vehicle | None = None
    time_limit: float = 3600.0
    spatial: SpatialPath | None = None
    peer: MssPilot | None = None

    @property
    def step_ns(self) -> int:
        """Step in whole ns, as stamps have it."""
        return round(self.step * 1e9)

    @property
    def plant_vehicle(self) -> Vehicle:
        """The plant's hull with the delay of its commands."""
        if not self.command_delay:
            return self.vehicle
        rudder, planes = self.vehicle.rudder, self.vehicle.sternplanes
        return replace(
            self.vehicle,
            rudder=replace(rudder, dead_time=rudder.dead_time + self.command_delay),
            sternplanes=planes and replace(planes, dead_time=planes.dead_time + self.command_delay),
        )

    @property
    def in_newtons(self) -> Scenario:
        """The same flight with every thrust in N.

        Raises:
            ConfigurationError: a vehicle's thrust has another unit, and its file no table of newtons.
        """
        if self.vehicle.thrust_unit == "N":
            return self
        model = self.controller_vehicle and self.controller_vehicle.in_newtons
        thrust = self.vehicle.newtons(self.thrust)
        return replace(self, vehicle=self.vehicle.in_newtons, controller_vehicle=model, thrust=thrust)

    @property
    def dt(self) -> float:
        """Step as the difference of two stamps, s."""
        return self.step_ns * 1e-9


def start_of(path: CompositePath) -> PlantState:
    """Return the state on the path's first point, along its tangent, at cruising speed."""
    x, y, chi = path.start_pose
    return PlantState(x, y, chi, CRUISE, 0.0, 0.0)


def spatial_start_of(path: SpatialPath, vehicle: Vehicle) -> BodyState:
    """Return the state on the path's first point, along its tangent, at cruising speed.

    A path that begins above the floating hull is begun afloat: from higher the hull would fall into the
    water.
    """
    x, y, z, gamma, chi = path.start_pose
    if z < vehicle.shallowest:
        z, gamma = vehicle.shallowest, 0.0
    return body_at(x, y, z, 0.0, gamma, chi, CRUISE)
