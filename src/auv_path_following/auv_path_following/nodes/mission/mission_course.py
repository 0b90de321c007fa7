"""The mission's course in the guidance node: with its messages."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.contract import topics
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

#: Without a range to the bottom for this long it is lost, s.
_LOST = 1.0


class PublishedCourse(PlanarCourse):
    """A planar mission of a planar vehicle."""

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        """Return the messages of a step."""
        return GuidanceMessages(node)

    def warning(self, follower: Any) -> str:
        """Return what is wrong with the measurements of a follower's last step; empty: nothing."""
        return ""

    def message(self, stamp: int) -> Any:
        """Return the message `path`; `stamp` in ns."""
        return whole_path(self.path, stamp)


class PublishedSpatialCourse(SpatialCourse, PublishedCourse):
    """A mission of a vehicle that dives."""

    def messages(self, node: SuiteNode) -> GuidanceMessages:
        return SpatialGuidanceMessages(node)

    def warning(self, follower: Any) -> str:
        vertical = follower.vertical
        if vertical.silent <= _LOST:
            return ""
        what = f"no usable range to the bottom ({topics.ALTITUDE.name})"
        climbs = vertical.tracked and vertical.depth == vertical.heard_at
        return f"{what}: " + ("climbing to where the last one was" if climbs else "the depth is held")

    def message(self, stamp: int) -> Any:
        return whole_spatial_path(self.path, stamp)


def course_of(mission: Mission, vehicle: Vehicle) -> PublishedCourse:
    """Return the course of a mission for a vehicle.

    Raises:
        ConfigurationError: the vehicle cannot fly the mission.
    """
    return (PublishedSpatialCourse if vehicle.dives else PublishedCourse)(mission, vehicle)
