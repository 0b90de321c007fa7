"""Convert messages to the suite's types and back; frames are resolved only here."""

from __future__ import annotations

import math
from typing import Any

from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped, TwistWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry, Path

from auv_msgs_py.contract.frames import (
    Convention,
    FrameTable,
    flip_yaw,
    is_frd,
    is_ned,
    quaternion_of_yaw,
    swap_axes,
    yaw_of_quaternion,
)
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity

MAP = "map"
PATH_FRAME = "path_frd"
_BILLION = 1_000_000_000
#: The largest second that builtin_interfaces/msg/Time can hold.
_LAST_SECOND = 2**31 - 1
#: Largest coordinate of a position, m: more than twice around the Earth, and its square does not overflow.
FARTHEST = 1e8


def nanoseconds(stamp: Time) -> int:
    """Return a stamp in ns, unchecked: for records. Flight code uses `stamp_of`."""
    return int(stamp.sec) * _BILLION + int(stamp.nanosec)


def stamp_of(stamp: Time, topic: str) -> int:
    """Return the stamp of a message on `topic`, ns.

    Raises:
        MessageRefused: a negative time, a second beyond int32, or a nanosecond part of a second or more.
    """
    if not (0 <= stamp.sec <= _LAST_SECOND and 0 <= stamp.nanosec < _BILLION):
        found = f"a stamp of {stamp.sec} s and {stamp.nanosec} ns"
        raise MessageRefused(topic, found, "a time from 0 s on, with less than 1e9 ns")
    return int(stamp.sec) * _BILLION + int(stamp.nanosec)


def set_stamp(stamp: Time, ns: int) -> None:
    """Write nanoseconds into a stamp that exists already."""
    stamp.sec, stamp.nanosec = divmod(ns, _BILLION)


def navigation_from(message: Odometry, frames: FrameTable, topic: str) -> Navigation:
    """Return pose and yaw rate, NED.

    Raises:
        MessageRefused: unknown frames, a value that is not finite, a coordinate beyond `FARTHEST`, or a
            quaternion without unit norm.
    """
    convention = frames.of_pose(topic, message.header.frame_id, message.child_frame_id)
    pose = message.pose.pose
    x, y, q, rate = pose.position.x, pose.position.y, pose.orientation, message.twist.twist.angular.z
    if not math.isfinite(x + y + rate):
        raise MessageRefused(topic, f"x={x}, y={y}, yaw rate={rate}", "finite numbers")
    if not (abs(x) < FARTHEST and abs(y) < FARTHEST):
        raise MessageRefused(topic, f"x={x:g}, y={y:g}", f"coordinates within {FARTHEST:g} m")
    norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w
    if not abs(norm - 1.0) < 0.02:
        raise MessageRefused(topic, f"a quaternion of norm {math.sqrt(abs(norm)):.3f}", "a unit quaternion")
    yaw = yaw_of_quaternion(q.x, q.y, q.z, q.w)
    if convention is Convention.NED_FRD:
        return Navigation(x, y, yaw, rate)
    north, east = swap_axes(x, y)
    return Navigation(north, east, flip_yaw(yaw), -rate)


def water_velocity_from(message: TwistWithCovarianceStamped, frames: FrameTable, topic: str) -> WaterVelocity:
    """Return (ur, vr), FRD, m/s.

    Raises:
        MessageRefused: an unknown frame or a value that is not finite.
    """
    convention = frames.of_body(topic, message.header.frame_id)
    linear = message.twist.twist.linear
    if not math.isfinite(linear.x + linear.y):
        raise MessageRefused(topic, f"({linear.x}, {linear.y})", "finite numbers")
    return WaterVelocity(linear.x, linear.y if convention is Convention.NED_FRD else -linear.y)


def current_from(message: Vector3Stamped, topic: str) -> Current:
    """Return the current, NED, m/s.

    Raises:
        MessageRefused: not in `map`, or a value that is not finite.
    """
    if message.header.frame_id.rsplit("/", 1)[-1] != MAP:
        raise MessageRefused(topic, f"frame_id '{message.header.frame_id}'", MAP)
    if not math.isfinite(message.vector.x + message.vector.y):
        raise MessageRefused(topic, f"({message.vector.x}, {message.vector.y})", "finite numbers")
    return Current(*swap_axes(message.vector.x, message.vector.y))


def finite(value: float, topic: str) -> float:
    """Return the value of a Float64 message.

    Raises:
        MessageRefused: it is not finite.
    """
    if not math.isfinite(value):
        raise MessageRefused(topic, str(value), "a finite number")
    return value


def fill_current(message: Vector3Stamped, current: Current, ns: int) -> None:
    """Write the current (NED, m/s) as a vector in `map` (ENU)."""
    set_stamp(message.header.stamp, ns)
    message.header.frame_id = MAP
    message.vector.x, message.vector.y = swap_axes(current.Vx, current.Vy)


def fill_odometry(message: Odometry, navigation: Navigation, u: float, v: float, ns: int) -> None:
    """Write an odometry in the frames that its frame_id names; u, v: velocity over ground, FRD, m/s."""
    set_stamp(message.header.stamp, ns)
    pose, twist = message.pose.pose, message.twist.twist
    twist.linear.x = u
    if is_ned(message.header.frame_id):
        pose.position.x, pose.position.y = navigation.x, navigation.y
        yaw, twist.linear.y, twist.angular.z = navigation.psi, v, navigation.r
    else:
        pose.position.x, pose.position.y = swap_axes(navigation.x, navigation.y)
        yaw, twist.linear.y, twist.angular.z = flip_yaw(navigation.psi), -v, -navigation.r
    pose.orientation.z, pose.orientation.w = quaternion_of_yaw(yaw)


def fill_water_velocity(message: TwistWithCovarianceStamped, water: WaterVelocity, ns: int) -> None:
    """Write (ur, vr) in the body frame that its frame_id names."""
    set_stamp(message.header.stamp, ns)
    linear = message.twist.twist.linear
    linear.x = water.ur
    linear.y = water.vr if is_frd(message.header.frame_id) else -water.vr


def fill_pose(message: PoseStamped, x: float, y: float, psi: float, ns: int) -> None:
    """Write a pose (NED, m, rad) in `map` (ENU)."""
    set_stamp(message.header.stamp, ns)
    message.header.frame_id = MAP
    message.pose.position.x, message.pose.position.y = swap_axes(x, y)
    orientation = message.pose.orientation
    orientation.z, orientation.w = quaternion_of_yaw(flip_yaw(psi))


def path_message(points: Any, ns: int) -> Path:
    """Return nav_msgs/Path in `map` (ENU) from rows of (x, y, chi_p), NED."""
    message = Path()
    message.header.frame_id = MAP
    set_stamp(message.header.stamp, ns)
    for x, y, chi in points:
        pose = PoseStamped()
        fill_pose(pose, float(x), float(y), float(chi), ns)
        message.poses.append(pose)
    return message
