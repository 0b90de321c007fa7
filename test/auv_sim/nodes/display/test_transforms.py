"""Transforms and markers stand where the vehicle is, in ENU, whichever frames its odometry has."""

from __future__ import annotations

import math

import numpy as np
import pytest
from geometry_msgs.msg import Quaternion
from hypothesis import given, settings
from hypothesis import strategies as st
from nav_msgs.msg import Odometry
from visualization_msgs.msg import Marker

from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.spatial_conversions import fill_spatial_odometry
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following import vehicle
from auv_sim.nodes.display import markers
from auv_sim.nodes.display.transforms import fixed_transforms, moving_transforms, pose_of

FRAMES = FrameTable(FrameIds())
ANGLE = st.floats(-1.2, 1.2)


def odometry(world: str, body: str, navigation: SpatialNavigation) -> Odometry:
    message = Odometry(child_frame_id=body)
    message.header.frame_id = world
    fill_spatial_odometry(message, navigation, (1.5, 0.0, 0.0), 0.0, 1_000_000_000)
    return message


def turned(q: Quaternion, v: tuple[float, float, float]) -> np.ndarray:
    """Rotate a vector by a quaternion."""
    u, w, v = np.array([q.x, q.y, q.z]), q.w, np.array(v)
    return v + 2.0 * np.cross(u, np.cross(u, v) + w * v)


@settings(max_examples=30)
@given(st.floats(-50, 50), st.floats(-50, 50), st.floats(0, 90), ANGLE, ANGLE, st.floats(-3.1, 3.1))
def test_both_conventions_give_one_pose(
    x: float, y: float, z: float, phi: float, theta: float, psi: float
) -> None:
    navigation = SpatialNavigation(x, y, z, phi, theta, psi, 0.0, 0.0)
    enu = pose_of(odometry("map", "base_link", navigation), FRAMES)
    ned = pose_of(odometry("map_ned", "base_link_frd", navigation), FRAMES)
    assert enu[0] == pytest.approx((y, x, -z)) and ned[0] == pytest.approx((y, x, -z))
    for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        assert turned(enu[1], axis) == pytest.approx(turned(ned[1], axis), abs=1e-9)
    # The bow: north, east and down of Eq. (3D-1), as east, north, up.
    bow = (math.cos(theta) * math.sin(psi), math.cos(theta) * math.cos(psi), math.sin(theta))
    assert turned(enu[1], (1.0, 0.0, 0.0)) == pytest.approx(bow, abs=1e-9)


def test_unknown_frames_are_refused() -> None:
    with pytest.raises(MessageRefused, match="frame_id 'map' with child_frame_id 'base_link_frd'"):
        pose_of(odometry("map", "base_link_frd", SpatialNavigation(*[0.0] * 8)), FRAMES)


def test_the_tree_of_frames_has_fins_that_turn() -> None:
    hull = vehicle.load("remus100_6dof")
    place, attitude = pose_of(odometry("map", "base_link", SpatialNavigation(*[0.0] * 8)), FRAMES)
    stamp = odometry("map", "base_link", SpatialNavigation(*[0.0] * 8)).header.stamp
    body, rudder, planes = moving_transforms(
        stamp, place, attitude, hull, {"rudder_joint": 0.2, "sternplane_joint": 0.1}, "auv1/"
    )
    assert (body.header.frame_id, body.child_frame_id) == ("map", "auv1/base_link")
    assert (rudder.header.frame_id, rudder.child_frame_id) == ("auv1/base_link", "auv1/rudder")
    assert body.header.stamp == rudder.header.stamp == stamp
    assert turned(rudder.transform.rotation, (-1, 0, 0))[1] == pytest.approx(math.sin(0.2))
    assert turned(planes.transform.rotation, (-1, 0, 0))[2] == pytest.approx(-math.sin(0.1))
    assert rudder.transform.translation.x < -0.4 * hull.length


def test_base_link_frd_has_y_to_starboard_and_z_down() -> None:
    (fixed,) = fixed_transforms("")
    assert (fixed.header.frame_id, fixed.child_frame_id) == ("base_link", "base_link_frd")
    q = fixed.transform.rotation
    assert turned(q, (1, 0, 0)) == pytest.approx((1, 0, 0))
    assert turned(q, (0, 1, 0)) == pytest.approx((0, -1, 0))
    assert turned(q, (0, 0, 1)) == pytest.approx((0, 0, -1))


@pytest.mark.parametrize("theta", [0.4, -0.4])
def test_the_hull_lies_along_the_bow_of_a_diving_vehicle(theta: float) -> None:
    message = odometry("map", "base_link", SpatialNavigation(10.0, 20.0, 5.0, 0.2, theta, 0.7, 0.0, 0.0))
    place, attitude = pose_of(message, FRAMES)
    hull = markers.vehicle_marker(place, attitude, 1.6, 0.19, message.header.stamp)
    along = turned(hull.pose.orientation, (0.0, 0.0, 1.0))  # a cylinder's axis
    assert along == pytest.approx(turned(attitude, (1.0, 0.0, 0.0)), abs=1e-9)
    assert math.copysign(1.0, along[2]) == math.copysign(1.0, theta)  # bow up is up
    assert (hull.pose.position.x, hull.pose.position.y, hull.pose.position.z) == (20.0, 10.0, -5.0)
    assert (hull.scale.x, hull.scale.z) == (0.19, 1.6)


def test_the_fence_stands_at_the_surface_and_at_the_deepest_point() -> None:
    path = [(0.0, 0.0, -2.0), (5.0, 0.0, -12.0), (9.0, 0.0, -4.0)]
    corners = [(0.0, 0.0, 0.0), (9.0, 0.0, 0.0), (9.0, 9.0, 0.0)]
    line, joints, fence = markers.mission_markers(path, [], corners)
    assert [point.z for point in line.points] == [-2.0, -12.0, -4.0]
    assert {point.z for point in fence.points} == {0.0, -12.0} and len(fence.points) == 12
    assert joints.action == Marker.DELETE and line.action == fence.action == Marker.ADD


def test_the_errors_are_readable_with_their_signs() -> None:
    text = markers.error_marker((1.0, 2.0, -3.0), "running", (0.5, -1.25), Odometry().header.stamp)
    assert text.text == "running  ye +0.50 m  ze -1.25 m"
    assert text.pose.position.z == 1.0
