"""The mission's path as guidance flies it: in the plane, or in three dimensions."""

from __future__ import annotations

import math
from typing import Any

from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.curves.spatial.spatial_rows import spatial_rows
from auv_path_following.guidance import guide
from auv_path_following.guidance.approach import agility_of
from auv_path_following.guidance.guide import Guide
from auv_path_following.guidance.measured import Measured, SpatialMeasured
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.guidance.spatial.spatial_follower import mode_of
from auv_path_following.missions import limits
from auv_path_following.missions.mission_file import Mission
from auv_path_following.nodes.guidance_output import (
    GuidanceMessages,
    SpatialGuidanceMessages,
    whole_path,
    whole_spatial_path,
)
from auv_path_following.nodes.navigation_input import Inputs
from auv_path_following.nodes.readings import PLANAR, SPATIAL
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.vehicle import Vehicle


class PlanarCourse:
    """A planar mission of a planar vehicle.

    Args:
        mission: to fly.
        vehicle: the hull.

    Attributes:
        path: with `length` and `distance_to_go`.
        rows: of the path.
        with_altitude: whether guidance needs the range to the bottom.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission.
    """

    path: Any
    rows: Any
    with_altitude = False

    def __init__(self, mission: Mission, vehicle: Vehicle) -> None:
        mission.require_planar()
        self.mission, self.vehicle = mission, vehicle
        self.path, self.rows = mission.path, mission.path.rows
        self._agility = agility_of(vehicle, mission.thrust)

    def prepare(self, parameters: GuidanceParameters) -> Guide:
        """Return guidance's configuration."""
        hold_after, bounds = self._bounds(parameters)
        return guide.prepare(parameters.guidance, self._agility, self.mission.thrust, hold_after, bounds)

    def _bounds(self, p: GuidanceParameters) -> tuple[float, limits.MissionLimits]:
        hold_after = math.inf if p.lockstep else p.holding.hold_after
        return hold_after, limits.prepare(p.limits.stricter(self.mission.limits), self.mission.geofence)

    def measured(self, inputs: Inputs, to_go: float, now: float) -> Any:
        """Return what guidance measured."""
        water, has_water = inputs.water or PLANAR.no_water, inputs.water is not None
        return Measured(inputs.navigation, water, has_water, inputs.moved, to_go, now)

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        """Return the messages of a step."""
        return GuidanceMessages(node)

    def message(self, stamp: int) -> Any:
        """Return the message `path`; `stamp` in ns."""
        return whole_path(self.path, stamp)


class SpatialCourse(PlanarCourse):
    """A mission of a vehicle that dives; a planar one is flown at the vehicle's surface depth."""

    def __init__(self, mission: Mission, vehicle: Vehicle) -> None:
        self.mission, self.vehicle = mission, vehicle
        self.path = flown_path(mission.path, mission.spatial, vehicle, mission.thrust)
        self.rows = spatial_rows(self.path)
        self.with_altitude = mission.altitude is not None

    def prepare(self, parameters: GuidanceParameters) -> Guide:
        hold_after, bounds = self._bounds(parameters)
        config, hull = parameters.guidance, self.vehicle
        mode = mode_of(self.mission, config, parameters.limits, hull)
        return guide.prepare_spatial(config, hull, self.mission.thrust, mode, hold_after, bounds)

    def measured(self, inputs: Inputs, to_go: float, now: float) -> Any:
        water, has_water = inputs.water or SPATIAL.no_water, inputs.water is not None
        return SpatialMeasured(inputs.navigation, water, has_water, inputs.moved, to_go, now, inputs.altitude)

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        return SpatialGuidanceMessages(node)

    def message(self, stamp: int) -> Any:
        return whole_spatial_path(self.path, stamp)


def course_of(mission: Mission, vehicle: Vehicle) -> PlanarCourse:
    """Return the course of a mission for a vehicle.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission.
    """
    return SpatialCourse(mission, vehicle) if vehicle.dives else PlanarCourse(mission, vehicle)
