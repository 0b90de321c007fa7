"""The parts of the light messages of `wire`: the attributes of ROS's messages, and nothing else. ROS-free."""

from __future__ import annotations

from collections.abc import Sequence

_NO_COVARIANCE = (0.0,) * 36


class Time:
    """builtin_interfaces/msg/Time."""

    __slots__ = ("nanosec", "sec")

    def __init__(self) -> None:
        self.sec = self.nanosec = 0


class Header:
    """std_msgs/msg/Header."""

    __slots__ = ("frame_id", "stamp")

    def __init__(self) -> None:
        self.stamp, self.frame_id = Time(), ""


class Vector:
    """geometry_msgs/msg/Vector3 and Point."""

    __slots__ = ("x", "y", "z")

    def __init__(self) -> None:
        self.x = self.y = self.z = 0.0


class Quaternion:
    """geometry_msgs/msg/Quaternion."""

    __slots__ = ("w", "x", "y", "z")

    def __init__(self) -> None:
        self.x = self.y = self.z = 0.0
        self.w = 1.0


class Pose:
    """geometry_msgs/msg/Pose."""

    __slots__ = ("orientation", "position")

    def __init__(self) -> None:
        self.position, self.orientation = Vector(), Quaternion()


class Twist:
    """geometry_msgs/msg/Twist."""

    __slots__ = ("angular", "linear")

    def __init__(self) -> None:
        self.linear, self.angular = Vector(), Vector()


class PoseWithCovariance:
    """geometry_msgs/msg/PoseWithCovariance."""

    __slots__ = ("covariance", "pose")

    def __init__(self) -> None:
        self.pose = Pose()
        self.covariance: Sequence[float] = _NO_COVARIANCE


class TwistWithCovariance:
    """geometry_msgs/msg/TwistWithCovariance."""

    __slots__ = ("covariance", "twist")

    def __init__(self) -> None:
        self.twist = Twist()
        self.covariance: Sequence[float] = _NO_COVARIANCE
