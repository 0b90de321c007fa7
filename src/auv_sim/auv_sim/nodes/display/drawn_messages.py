"""What is drawn of the newest messages: the mission, the vehicle, its fins."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from geometry_msgs.msg import Quaternion
from visualization_msgs.msg import Marker

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_path_following.missions import mission_file
from auv_path_following.vehicle import Vehicle
from auv_sim.nodes.display import markers
from auv_sim.nodes.display.markers import Place
from auv_sim.nodes.display.robot_model import RUDDER, STERNPLANE, diameter_of

#: A joint of the mission file farther from every point of `path` than this is not drawn, m.
_ON_PATH = 1.0


def mission_drawn(path: Any | None, fence: Any | None, joints: Sequence[tuple[float, float]]) -> list[Marker]:
    """Return the markers of a mission.

    Args:
        path, fence: messages; None where none has come.
        joints: of the mission's file, as `joints_of` returns them.
    """
    line = [_place(each.pose.position) for each in path.poses] if path else []
    corners = [(each.x, each.y, 0.0) for each in fence.polygon.points] if fence else []
    return markers.mission_markers(line, _on_path(joints, line), corners)


def vehicle_drawn(
    newest: Mapping[Topic, Any], hull: Vehicle, place: Place, attitude: Quaternion, stamp: Any
) -> list[Marker]:
    """Return the markers of the vehicle: hull, current, virtual point, errors.

    Args:
        newest: topic -> its newest message.
        hull: of the vehicle.
        place, attitude: of it, as `transforms.pose_of` returns them.
        stamp: of its odometry.
    """
    shown = [markers.vehicle_marker(place, attitude, hull.length, diameter_of(hull), stamp)]
    if current := newest.get(topics.CURRENT_ESTIMATE):
        shown.append(markers.current_marker(place, _place(current.vector), stamp))
    state = newest[topics.MISSION_STATE].data if topics.MISSION_STATE in newest else ""
    if virtual := newest.get(topics.VIRTUAL_POINT):
        shown.append(markers.virtual_point_marker(place, _place(virtual.pose.position), stamp))
    if error := newest.get(topics.PATH_ERROR):
        spatial = newest.get(topics.PATH_ERROR_3D)
        errors = (error.vector.y, spatial.vector.z) if spatial else (error.vector.y,)
        shown.append(markers.error_marker(place, state, errors, stamp))
    return shown


def fin_angles(newest: Mapping[Topic, Any]) -> dict[str, float]:
    """Return the measured angles of the fins: joint -> rad."""
    fins = (RUDDER, topics.RUDDER_STATE), (STERNPLANE, topics.STERNPLANE_STATE)
    return {joint: newest[topic].data for joint, topic in fins if topic in newest}


def joints_of(mission: str, vehicle: Vehicle) -> list[tuple[float, float]]:
    """Return the ends of a mission's subpaths, east and north, m."""
    path = mission_file.load(mission, vehicle).path
    return [(point.y, point.x) for point in (path.at(float(k)) for k in range(path.n + 1))]


def _on_path(joints: Sequence[tuple[float, float]], line: Sequence[Place]) -> list[Place]:
    """Return the joints at the depth of the path there; a path of another mission has none of them."""
    found = []
    for east, north in joints:
        nearest = min(line, key=lambda place: math.hypot(place[0] - east, place[1] - north), default=None)
        if nearest is not None and math.hypot(nearest[0] - east, nearest[1] - north) <= _ON_PATH:
            found.append((east, north, nearest[2]))
    return found


def _place(vector: Any) -> Place:
    return vector.x, vector.y, vector.z
