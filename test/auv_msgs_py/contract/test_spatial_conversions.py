"""Messages of a vehicle with stern planes: what is sent comes back, and every sign as the contract has it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sensor_msgs.msg import Range

from auv_msgs_py.contract.frames import FrameIds, FrameTable
from auv_msgs_py.contract.spatial_conversions import (
    altitude_from,
    fill_error,
    fill_spatial_current,
    fill_spatial_odometry,
    fill_spatial_pose,
    fill_spatial_water,
    spatial_current_from,
    spatial_navigation_from,
    spatial_path_message,
    spatial_water_from,
)
from auv_msgs_py.contract.wire import Odometry, PoseStamped, TwistWithCovarianceStamped, Vector3Stamped
from auv_msgs_py.values.attitude import attitude_over_the_wire
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import SpatialCurrent, SpatialNavigation, SpatialWater

FRAMES = FrameTable(FrameIds())
PAIRS = [("map", "base_link"), ("map_ned", "base_link_frd"), ("odom_ned", "base_link_fsd")]
metres, rate = st.floats(-1000.0, 1000.0), st.floats(-0.5, 0.5)
roll, pitch, heading = st.floats(-1.0, 1.0), st.floats(-1.2, 1.2), st.floats(-3.1, 3.1)


def odometry(world: str, body: str, navigation: SpatialNavigation) -> Odometry:
    message = Odometry(world, body)
    fill_spatial_odometry(message, navigation, (1.5, 0.1, -0.2), 0.03, 5_000_000_000)
    return message


@pytest.mark.parametrize(("world", "body"), PAIRS)
@given(x=metres, y=metres, z=metres, phi=roll, theta=pitch, psi=heading, q=rate, r=rate)
def test_an_odometry_comes_back(world, body, x, y, z, phi, theta, psi, q, r) -> None:
    sent = SpatialNavigation(x, y, z, phi, theta, psi, q, r)
    assert spatial_navigation_from(odometry(world, body, sent), FRAMES, "odom") == pytest.approx(
        sent, abs=1e-9
    )


@given(phi=roll, theta=pitch, psi=heading)
def test_a_closed_loop_rounds_an_attitude_as_the_wire_does(phi: float, theta: float, psi: float) -> None:
    message = Odometry("map", "base_link")
    sent = SpatialNavigation(1.0, 2.0, 3.0, phi, theta, psi, 0.0, 0.0)
    fill_spatial_odometry(message, sent, (1.0, 0.0, 0.0), 0.0, 0)
    found = spatial_navigation_from(message, FrameTable(FrameIds()), "odom")
    assert found[3:6] == attitude_over_the_wire(phi, theta, psi)


def test_on_the_wire_z_is_up_and_a_positive_pitch_is_bow_down() -> None:
    message = odometry("map", "base_link", SpatialNavigation(1.0, 2.0, 10.0, 0.0, 0.2, 0.0, 0.1, 0.05))
    pose, twist = message.pose.pose, message.twist.twist
    assert (pose.position.x, pose.position.y, pose.position.z) == (2.0, 1.0, -10.0)
    q = pose.orientation
    assert math.asin(2.0 * (q.w * q.y - q.z * q.x)) == pytest.approx(-0.2)
    assert (twist.linear.x, twist.linear.y, twist.linear.z) == (1.5, -0.1, 0.2)
    assert (twist.angular.x, twist.angular.y, twist.angular.z) == (0.03, -0.1, -0.05)


def test_in_ned_z_is_depth_and_a_positive_pitch_is_bow_up() -> None:
    message = odometry(
        "map_ned", "base_link_fsd", SpatialNavigation(1.0, 2.0, 10.0, 0.0, 0.2, 0.0, 0.1, 0.05)
    )
    pose, twist = message.pose.pose, message.twist.twist
    assert (pose.position.x, pose.position.y, pose.position.z) == (1.0, 2.0, 10.0)
    q = pose.orientation
    assert math.asin(2.0 * (q.w * q.y - q.z * q.x)) == pytest.approx(0.2)
    assert (twist.linear.z, twist.angular.y) == (-0.2, 0.1)


@pytest.mark.parametrize(
    ("frame", "sign"), [("base_link", -1.0), ("base_link_frd", 1.0), ("base_link_fsd", 1.0)]
)
def test_velocity_through_the_water_comes_back(frame: str, sign: float) -> None:
    message, sent = TwistWithCovarianceStamped(frame), SpatialWater(1.9, 0.05, -0.03)
    fill_spatial_water(message, sent, 0)
    assert message.twist.twist.linear.z == sign * -0.03
    assert spatial_water_from(message, FRAMES, "water") == sent
    message.twist.twist.linear.z = math.nan
    assert spatial_water_from(message, FRAMES, "water") == (1.9, 0.05, 0.0)
    message.twist.twist.linear.z = math.inf
    with pytest.raises(MessageRefused, match="NaN where it is not measured"):
        spatial_water_from(message, FRAMES, "water")


def test_a_current_downwards_is_a_negative_upwelling() -> None:
    message, sent = Vector3Stamped(), SpatialCurrent(0.1, 0.2, 0.05)
    fill_spatial_current(message, sent, 0)
    assert (message.vector.x, message.vector.y, message.vector.z) == (0.2, 0.1, -0.05)
    assert spatial_current_from(message, "current") == sent
    message.vector.z = math.nan
    with pytest.raises(MessageRefused, match=r"vector\.z=nan"):
        spatial_current_from(message, "current")


@pytest.mark.parametrize("found", [0.0, 12.5, math.inf, -math.inf])
def test_ranges_of_rep_117_are_accepted(found: float) -> None:
    assert altitude_from(Range(range=found), "altitude") == found


def test_a_range_that_is_no_distance_is_refused() -> None:
    assert math.isnan(altitude_from(Range(range=math.nan), "altitude"))
    with pytest.raises(MessageRefused, match="a range of -1 m"):
        altitude_from(Range(range=-1.0), "altitude")


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("z", math.nan, "finite numbers"),
        ("z", 20_000.0, "z within 12000 m"),
        ("q", math.inf, "pitch rate=-inf"),
    ],
)
def test_an_odometry_that_is_no_place_is_refused(field: str, value: float, message: str) -> None:
    wrong = SpatialNavigation(0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0)._replace(**{field: value})
    with pytest.raises(MessageRefused, match=message):
        spatial_navigation_from(odometry("map", "base_link", wrong), FRAMES, "odom")


def test_a_path_that_climbs_points_up() -> None:
    pose = PoseStamped()
    fill_spatial_pose(pose, (1.0, 2.0, 8.0), 0.3, 0.0, 0)
    q, place = pose.pose.orientation, pose.pose.position
    assert (place.x, place.y, place.z) == (2.0, 1.0, -8.0)
    assert math.asin(2.0 * (q.w * q.y - q.z * q.x)) == pytest.approx(-0.3)
    path = spatial_path_message([((1.0, 2.0, 8.0), 0.3, 0.0)], 7)
    assert path.poses[0].pose.position.z == -8.0
    assert path.header.stamp.nanosec == 7


def test_errors_stand_in_the_frame_of_the_path() -> None:
    message = Vector3Stamped()
    fill_error(message, (1.0, -2.0, 0.5), 3)
    assert (message.header.frame_id, message.vector.z) == ("path_frd", 0.5)
