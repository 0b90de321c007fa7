"""The course of a mission: the path as one vehicle follows it, and the configuration of its guidance."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from auv_msgs_py.values.types import NO_SPATIAL_WATER, NO_WATER
from auv_path_following.curves.spatial.spatial_rows import spatial_rows
from auv_path_following.guidance import guide
from auv_path_following.guidance.approach import agility_of
from auv_path_following.guidance.failsafe import guard
from auv_path_following.guidance.guide import Guide
from auv_path_following.guidance.measured import Measured, SpatialMeasured
from auv_path_following.guidance.spatial.flown_path import flown_path
from auv_path_following.guidance.spatial.spatial_follower import mode_of
from auv_path_following.missions import limits
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.mission_file import Mission
from auv_path_following.missions.orders.start_place import path_parameter_of
from auv_path_following.parameters import GuidanceParameters
from auv_path_following.vehicle import Vehicle

#: Without `limits.max_depth` a mission ends at this many times the largest depth of the vehicle file: a path
#: at that depth is allowed, and is not held to the millimetre.
HULL_MARGIN = 1.05


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

    def prepare(self, parameters: GuidanceParameters, is_limited: bool = True) -> Guide:
        """Return guidance's configuration.

        Args:
            parameters: of guidance. In lockstep no mission holds, as the nodes' watchdogs rest.
            is_limited: whether limits and geofence end the mission.

        Raises:
            ConfigurationError: `start_at` is no place of the path.
        """
        p = parameters
        hold_after = math.inf if p.lockstep else p.holding.hold_after
        bounds: Any = None
        if is_limited:
            bounds = limits.prepare(self._limits(p), self.mission.geofence)
        return self._guide_of(p, hold_after, bounds, path_parameter_of(p.start_at, self.path))

    def _limits(self, p: GuidanceParameters) -> LimitsConfig:
        return p.limits.stricter(self.mission.limits)

    def _guide_of(self, p: GuidanceParameters, hold_after: float, bounds: Any, begins_at: float) -> Guide:
        return guide.prepare(p.guidance, self._agility, self.mission.thrust, hold_after, bounds, begins_at)

    def depth_and_heading(self, navigation: Any) -> tuple[float, float]:
        """Return depth (m) and heading (rad) of what was measured."""
        return 0.0, navigation.psi

    def measured(self, inputs: Any, to_go: float, now: float) -> Any:
        """Return one measurement for guidance.

        Args:
            inputs: with `navigation` (NED), `water` (FRD; None where no fresh one is known), `moved` and
                `altitude` (m; NaN where no fresh one is known).
            to_go: length of path to the end, m; only for limits.
            now: ROS time, s.
        """
        water, has_water = inputs.water or NO_WATER, inputs.water is not None
        return Measured(inputs.navigation, water, has_water, inputs.moved, to_go, now)


class SpatialCourse(PlanarCourse):
    """A mission of a vehicle that dives; a planar one is flown at the vehicle's surface depth."""

    def __init__(self, mission: Mission, vehicle: Vehicle) -> None:
        self.mission, self.vehicle = mission, vehicle
        self.path = flown_path(mission.path, mission.spatial, vehicle, mission.thrust)
        self.rows = spatial_rows(self.path)
        self.with_altitude = mission.altitude is not None

    def _guide_of(self, p: GuidanceParameters, hold_after: float, bounds: Any, begins_at: float) -> Guide:
        config, hull, thrust = p.guidance, self.vehicle, self.mission.thrust
        mode = mode_of(self.mission, config, p.limits, hull)
        watch = None if bounds is None else guard.prepare(p.diving, p.ascent, hull, thrust)
        return guide.prepare_spatial(config, hull, thrust, mode, hold_after, bounds, watch, begins_at)

    def _limits(self, p: GuidanceParameters) -> LimitsConfig:
        found = super()._limits(p)
        return found if found.max_depth else replace(found, max_depth=HULL_MARGIN * self.vehicle.depth.max)

    def depth_and_heading(self, navigation: Any) -> tuple[float, float]:
        return navigation.z, navigation.psi

    def measured(self, inputs: Any, to_go: float, now: float) -> Any:
        water, has_water = inputs.water or NO_SPATIAL_WATER, inputs.water is not None
        return SpatialMeasured(inputs.navigation, water, has_water, inputs.moved, to_go, now, inputs.altitude)


def course_of(mission: Mission, vehicle: Vehicle) -> PlanarCourse:
    """Return the course of a mission for a vehicle.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission.
    """
    return (SpatialCourse if vehicle.dives else PlanarCourse)(mission, vehicle)
