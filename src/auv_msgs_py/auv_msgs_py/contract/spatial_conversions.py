"""Convert the messages of a vehicle with stern planes; `conversions` has those of a planar one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from geometry_msgs.msg import PoseStamped, TwistWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry, Path

from auv_msgs_py.contract.conversions import (
    FARTHEST,
    MAP,
    PATH_FRAME,
    current_from,
    fill_current,
    set_stamp,
    water_velocity_from,
)
from auv_msgs_py.contract.frames import Convention, FrameTable, is_frd, is_ned, swap_axes
from auv_msgs_py.values.attitude import Quaternion, angles_of_quaternion, quaternion_of, turned_over
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import DEEPEST, Current, SpatialCurrent, SpatialNavigation, SpatialWater

if TYPE_CHECKING:  # only vehicles with an altimeter load it
    from sensor_msgs.msg import Range


def spatial_navigation_from(message: Odometry, frames: FrameTable, topic: str) -> SpatialNavigation:
    """Return pose and rates, NED.

    Raises:
        MessageRefused: unknown frames, a value that is not finite, a coordinate beyond `FARTHEST`, or a
            quaternion without unit norm.
    """
    convention = frames.of_pose(topic, message.header.frame_id, message.child_frame_id)
    place, q = message.pose.pose.position, message.pose.pose.orientation
    rates = message.twist.twist.angular
    if not math.isfinite(place.x + place.y + place.z + rates.y + rates.z):
        found = f"x={place.x}, y={place.y}, z={place.z}, pitch rate={rates.y}, yaw rate={rates.z}"
        raise MessageRefused(topic, found, "finite numbers")
    if not (abs(place.x) < FARTHEST and abs(place.y) < FARTHEST and abs(place.z) < DEEPEST):
        found = f"x={place.x:g}, y={place.y:g}, z={place.z:g}"
        raise MessageRefused(topic, found, f"coordinates within {FARTHEST:g} m, z within {DEEPEST:g} m")
    norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    if not abs(norm - 1.0) < 0.02:
        raise MessageRefused(topic, f"a quaternion of norm {math.sqrt(abs(norm)):.3f}", "a unit quaternion")
    if convention is Convention.NED_FRD:
        phi, theta, psi = angles_of_quaternion(q.w, q.x, q.y, q.z)
        return SpatialNavigation(place.x, place.y, place.z, phi, theta, psi, rates.y, rates.z)
    phi, theta, psi = angles_of_quaternion(*turned_over(q.w, q.x, q.y, q.z))
    north, east = swap_axes(place.x, place.y)
    return SpatialNavigation(north, east, -place.z, phi, theta, psi, -rates.y, -rates.z)


def spatial_water_from(message: TwistWithCovarianceStamped, frames: FrameTable, topic: str) -> SpatialWater:
    """Return (ur, vr, wr), FRD, m/s; a wr that is not measured (NaN) is 0.

    Raises:
        MessageRefused: an unknown frame or another value that is not finite.
    """
    ur, vr = water_velocity_from(message, frames, topic)
    wr = message.twist.twist.linear.z
    if math.isinf(wr):
        raise MessageRefused(topic, f"linear.z={wr}", "a finite number, or NaN where it is not measured")
    if math.isnan(wr):
        return SpatialWater(ur, vr, 0.0)
    downwards = frames.of_body(topic, message.header.frame_id) is Convention.NED_FRD
    return SpatialWater(ur, vr, wr if downwards else -wr)


def spatial_current_from(message: Vector3Stamped, topic: str) -> SpatialCurrent:
    """Return the current, NED, m/s.

    Raises:
        MessageRefused: not in `map`, or a value that is not finite.
    """
    across, upwards = current_from(message, topic), message.vector.z
    if not math.isfinite(upwards):
        raise MessageRefused(topic, f"vector.z={upwards}", "a finite number")
    return SpatialCurrent(across.Vx, across.Vy, -upwards)


def altitude_from(message: Range, topic: str) -> float:
    """Return the range to the bottom along body z, m, as in REP-117: infinite without an echo, minus infinite
    where it is too close.

    Raises:
        MessageRefused: a range below 0.
    """
    found = float(message.range)
    if found < 0.0 and not math.isinf(found):
        raise MessageRefused(topic, f"a range of {found:g} m", "0 m or more, +inf or -inf")
    return found


def fill_spatial_odometry(
    message: Odometry, navigation: SpatialNavigation, velocity: tuple[float, float, float], p: float, ns: int
) -> None:
    """Write an odometry in the frames that its frame_id names.

    Args:
        message: written.
        navigation: pose and rates, NED.
        velocity: over ground, FRD, m/s.
        p: roll rate, rad/s.
        ns: stamp.
    """
    set_stamp(message.header.stamp, ns)
    place, linear, angular = (
        message.pose.pose.position,
        message.twist.twist.linear,
        message.twist.twist.angular,
    )
    x, y, z, phi, theta, psi, q, r = navigation
    u, v, w = velocity
    attitude = quaternion_of(phi, theta, psi)
    linear.x, angular.x = u, p
    if is_ned(message.header.frame_id):
        place.x, place.y, place.z = x, y, z
        linear.y, linear.z, angular.y, angular.z = v, w, q, r
    else:
        (place.x, place.y), place.z = swap_axes(x, y), -z
        linear.y, linear.z, angular.y, angular.z = -v, -w, -q, -r
        attitude = turned_over(*attitude)
    _set_orientation(message.pose.pose.orientation, attitude)


def fill_spatial_water(message: TwistWithCovarianceStamped, water: SpatialWater, ns: int) -> None:
    """Write (ur, vr, wr) in the body frame that its frame_id names."""
    set_stamp(message.header.stamp, ns)
    linear = message.twist.twist.linear
    sign = 1.0 if is_frd(message.header.frame_id) else -1.0
    linear.x, linear.y, linear.z = water.ur, sign * water.vr, sign * water.wr


def fill_spatial_current(message: Vector3Stamped, current: SpatialCurrent, ns: int) -> None:
    """Write the current (NED, m/s) as a vector in `map` (ENU): z is upwelling."""
    fill_current(message, Current(current.Vx, current.Vy), ns)
    message.vector.z = -current.Vz


def fill_spatial_pose(
    message: PoseStamped, place: tuple[float, float, float], gamma: float, chi: float, ns: int
) -> None:
    """Write a place of the path (NED, m) in `map` (ENU), along its elevation and course (rad)."""
    set_stamp(message.header.stamp, ns)
    message.header.frame_id = MAP
    position = message.pose.position
    (position.x, position.y), position.z = swap_axes(place[0], place[1]), -place[2]
    _set_orientation(message.pose.orientation, turned_over(*quaternion_of(0.0, gamma, chi)))


def fill_error(message: Vector3Stamped, errors: tuple[float, float, float], ns: int) -> None:
    """Write xe, ye, ze, m, of the path's frame."""
    set_stamp(message.header.stamp, ns)
    message.header.frame_id = PATH_FRAME
    message.vector.x, message.vector.y, message.vector.z = errors


def spatial_path_message(points: Any, ns: int) -> Path:
    """Return nav_msgs/Path in `map` (ENU) from rows of ((x, y, z), gamma_p, chi_p), NED."""
    message = Path()
    message.header.frame_id = MAP
    set_stamp(message.header.stamp, ns)
    for place, gamma, chi in points:
        pose = PoseStamped()
        fill_spatial_pose(pose, place, gamma, chi, ns)
        message.poses.append(pose)
    return message


def _set_orientation(orientation: Any, attitude: Quaternion) -> None:
    orientation.w, orientation.x, orientation.y, orientation.z = attitude
