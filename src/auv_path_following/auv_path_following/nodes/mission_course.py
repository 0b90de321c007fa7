"""The mission's course in the guidance node: with its messages."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.course import PlanarCourse, SpatialCourse
from auv_path_following.missions.mission_file import Mission
from auv_path_following.nodes.guidance_output import (
    GuidanceMessages,
    SpatialGuidanceMessages,
    whole_path,
    whole_spatial_path,
)
from auv_path_following.vehicle import Vehicle


class PublishedCourse(PlanarCourse):
    """A planar mission of a planar vehicle."""

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        """Return the messages of a step."""
        return GuidanceMessages(node)

    def message(self, stamp: int) -> Any:
        """Return the message `path`; `stamp` in ns."""
        return whole_path(self.path, stamp)


class PublishedSpatialCourse(SpatialCourse, PublishedCourse):
    """A mission of a vehicle that dives."""

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        return SpatialGuidanceMessages(node)

    def message(self, stamp: int) -> Any:
        return whole_spatial_path(self.path, stamp)


def course_of(mission: Mission, vehicle: Vehicle) -> PublishedCourse:
    """Return the course of a mission for a vehicle.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission.
    """
    return (PublishedSpatialCourse if vehicle.dives else PublishedCourse)(mission, vehicle)
