"""The latched topics that show a mission: its path, its geofence and its origin."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point32, PolygonStamped
from sensor_msgs.msg import NavSatFix, NavSatStatus

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import MAP, set_stamp
from auv_msgs_py.contract.frames import swap_axes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.missions.mission_file import Mission


class MissionBoard:
    """Post a mission when it is chosen.

    Args:
        node: ailos_guidance.
    """

    def __init__(self, node: SuiteNode) -> None:
        self._node = node
        self._path = node.advertise(topics.PATH)
        self._geofence = node.advertise(topics.GEOFENCE)
        self._origin = node.advertise(topics.ORIGIN)
        self._has_origin = False

    def post(self, mission: Mission, path: Any) -> None:
        """Publish a mission.

        Args:
            mission: with geofence and origin.
            path: the message `path`.
        """
        stamp = self._node.get_clock().now().nanoseconds
        self._path.publish(path)
        self._geofence.publish(_fence(mission, stamp))
        if mission.origin is not None or self._has_origin:
            self._origin.publish(_fix(mission, stamp))
            self._has_origin = mission.origin is not None


def _fence(mission: Mission, stamp: int) -> PolygonStamped:
    message = PolygonStamped()
    message.header.frame_id = MAP
    set_stamp(message.header.stamp, stamp)
    for north, east in mission.geofence:
        x, y = swap_axes(north, east)
        message.polygon.points.append(Point32(x=x, y=y, z=0.0))
    return message


def _fix(mission: Mission, stamp: int) -> NavSatFix:
    """Return the origin; without one, a fix that says so and takes back the last mission's."""
    message = NavSatFix()
    message.header.frame_id = MAP
    set_stamp(message.header.stamp, stamp)
    message.status.status = NavSatStatus.STATUS_NO_FIX
    if mission.origin is not None:
        message.status.status = NavSatStatus.STATUS_FIX
        message.latitude, message.longitude = mission.origin.latitude_deg, mission.origin.longitude_deg
    return message
