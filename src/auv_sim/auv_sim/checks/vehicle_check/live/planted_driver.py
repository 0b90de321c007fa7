"""A planted vehicle's side of the wire: the topics of a driver with one mistake, for the check to find."""

from __future__ import annotations

from typing import Any

from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos
from auv_msgs_py.contract.conversions import set_stamp
from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.planted import Planted, PlantedVehicle
from auv_sim.checks.vehicle_check.samples import OdometrySample, WaterSample

_DEPTH = 100


class PlantedDriver:
    """A planted vehicle on ROS topics of its own namespace.

    Args:
        node: whose publishers and subscriptions are used.
        planted: the mistake.
        hull: the vehicle.
        begin: time of the start, s.
    """

    def __init__(self, node: Node, planted: Planted, hull: Vehicle, begin: float) -> None:
        self.planted = planted
        self.namespace = f"/{planted.name.replace('-', '_')}"
        self.vehicle = PlantedVehicle(planted, hull, begin)
        self.sent = 0
        self.heard = 0
        self._rudder = 0.0
        self._water_type = qos.message_class(planted.water_type)
        self._odometry = node.create_publisher(Odometry, f"{self.namespace}/odom", _DEPTH)
        self._water = node.create_publisher(
            self._water_type, f"{self.namespace}/velocity_through_water", _DEPTH
        )
        self._state = (
            None if planted.bare else node.create_publisher(Float64, f"{self.namespace}/rudder_state", _DEPTH)
        )
        profile = QoSProfile(depth=_DEPTH)
        if planted.latched_commands:
            profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
        node.create_subscription(Float64, f"{self.namespace}/rudder_cmd", self._on_rudder, profile)
        node.create_subscription(Float64, f"{self.namespace}/thrust_cmd", self._on_thrust, profile)

    def _on_rudder(self, message: Float64) -> None:
        self._rudder = message.data

    def _on_thrust(self, message: Float64) -> None:
        self.heard += 1
        self.vehicle.order(Command(self._rudder, message.data))

    def is_ready(self) -> bool:
        """Whether its topics are matched, as far as the mistake allows."""
        publishers = (self._odometry, self._state) if self._state is not None else (self._odometry,)
        return all(publisher.get_subscription_count() for publisher in publishers)

    def live(self, until: float) -> None:
        """Let time pass until `until` (s) and publish what is measured meanwhile."""
        for odometry, water, rudder in self.vehicle.live(until):
            self._odometry.publish(odometry_of(odometry))
            self._water.publish(water_of(self._water_type, water))
            if self._state is not None:
                self._state.publish(Float64(data=rudder))
            self.sent += 1


def odometry_of(sample: OdometrySample) -> Odometry:
    message = Odometry()
    set_stamp(message.header.stamp, round(sample.stamp * 1e9))
    message.header.frame_id, message.child_frame_id = sample.frame, sample.child
    pose, twist = message.pose.pose, message.twist.twist
    pose.position.x, pose.position.y = sample.x, sample.y
    q = pose.orientation
    q.x, q.y, q.z, q.w = sample.orientation
    twist.linear.x, twist.linear.y, twist.angular.z = sample.u, sample.v, sample.r
    pose.position.z, twist.linear.z, twist.angular.x, twist.angular.y = sample.z, sample.w, sample.p, sample.q
    message.pose.covariance[0:36:7] = sample.pose_covariance
    return message


def water_of(kind: type[Any], sample: WaterSample) -> Any:
    message = kind()
    set_stamp(message.header.stamp, round(sample.stamp * 1e9))
    message.header.frame_id = sample.frame
    twist = message.twist.twist if hasattr(message.twist, "twist") else message.twist
    twist.linear.x, twist.linear.y, twist.linear.z = sample.u, sample.v, sample.w
    return message
