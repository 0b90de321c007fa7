"""Keeps what is heard of a vehicle's topics, for the checks."""

from __future__ import annotations

import os
from typing import Any

from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.topics import Topic
from auv_sim.checks.vehicle_check.samples import (
    Endpoint,
    OdometrySample,
    RangeSample,
    Recording,
    Value,
    WaterSample,
)

_DEPTH = 1000
#: The diagonal of a 6 x 6 covariance.
_DIAGONAL = slice(0, 36, 7)
#: Nodes that read commands without being the vehicle.
_BYSTANDERS = {topics.RECORDER, topics.AUTOPILOT, topics.LAUNCHER}
#: The commands, in the order of `Command`, and in that of `SpatialCommand`.
COMMANDS = (topics.RUDDER_CMD, topics.THRUST_CMD)
DIVING_COMMANDS = (topics.RUDDER_CMD, topics.STERNPLANE_CMD, topics.THRUST_CMD)
_LISTENED = (topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_STATE, *COMMANDS)
_LISTENED_OF_DIVERS = (topics.STERNPLANE_CMD, topics.STERNPLANE_STATE, topics.ALTITUDE)


def _endpoint(topic: Topic, publishes: bool, info: Any) -> Endpoint:
    reliable = info.qos_profile.reliability == ReliabilityPolicy.RELIABLE
    latched = info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return Endpoint(topic.name, publishes, info.topic_type, info.node_name, reliable, latched)


def _domain(node: Node) -> str:
    """Return a node's ROS domain and discovery range, for people: what publishes elsewhere is not found."""
    local_only = os.environ.get("ROS_LOCALHOST_ONLY") == "1"
    reach = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or ("LOCALHOST" if local_only else "SUBNET")
    return f"ROS domain {node.context.get_domain_id()}, discovery range {reach}"


class VehicleListener:
    """Keeps a `Recording` of one vehicle's topics.

    Args:
        node: whose subscriptions and clock are used.
        namespace: of the vehicle's topics.
        hears_commands: whether to listen to commands as well; not beside a small test, which keeps its own.
        dives: whether the vehicle has stern planes.
    """

    def __init__(self, node: Node, namespace: str, hears_commands: bool = True, dives: bool = False) -> None:
        self.node, self._dives = node, dives
        self.recording = recording = Recording()
        self._namespace = namespace
        self._listen(topics.ODOM, self._on_odometry)
        self._listen(topics.WATER_VELOCITY, self._on_water)
        self._listen(topics.RUDDER_STATE, self._keep(recording.rudder_state))
        if dives:
            self._listen(topics.STERNPLANE_STATE, self._keep(recording.sternplane_state))
            self._listen(topics.ALTITUDE, self._on_altitude)
        if hears_commands:
            for topic, values in self.commands():
                self._listen(topic, self._keep(values))

    def commands(self) -> list[tuple[Topic, list[Value]]]:
        """Return the topics of the commands in the order of their fields, and where each is kept."""
        kept = self.recording
        values = {
            topics.RUDDER_CMD: kept.rudder_cmd, topics.STERNPLANE_CMD: kept.sternplane_cmd,
            topics.THRUST_CMD: kept.thrust_cmd,
        }  # fmt: skip
        return [(topic, values[topic]) for topic in (DIVING_COMMANDS if self._dives else COMMANDS)]

    def name(self, topic: Topic) -> str:
        """Return the topic's full name."""
        return topics.full_name(self._namespace, topic.name)

    def now(self) -> float:
        """Return ROS time, s."""
        return float(self.node.get_clock().now().nanoseconds) * 1e-9

    def _listen(self, topic: Topic, callback: Any) -> None:
        kind, profile = qos.message_class(topic.type), qos.requested(topic, reliable=False, depth=_DEPTH)
        self.node.create_subscription(kind, self.name(topic), callback, profile)

    def _on_odometry(self, message: Odometry) -> None:
        header, pose, twist = message.header, message.pose.pose, message.twist.twist
        q = pose.orientation
        sample = OdometrySample(
            self.now(), nanoseconds(header.stamp) * 1e-9, header.frame_id, message.child_frame_id,
            pose.position.x, pose.position.y, (q.x, q.y, q.z, q.w),
            twist.linear.x, twist.linear.y, twist.angular.z,
            tuple(message.pose.covariance[_DIAGONAL]), tuple(message.twist.covariance[_DIAGONAL]),
            pose.position.z, twist.linear.z, twist.angular.x, twist.angular.y,
        )  # fmt: skip
        self.recording.odom.append(sample)

    def _on_water(self, message: TwistWithCovarianceStamped) -> None:
        stamp, linear = nanoseconds(message.header.stamp) * 1e-9, message.twist.twist.linear
        covariance = tuple(message.twist.covariance[_DIAGONAL])
        self.recording.water.append(
            WaterSample(self.now(), stamp, message.header.frame_id, linear.x, linear.y, covariance, linear.z)
        )

    def _on_altitude(self, message: Any) -> None:
        stamp = nanoseconds(message.header.stamp) * 1e-9
        self.recording.altitude.append(
            RangeSample(self.now(), stamp, message.range, message.min_range, message.max_range)
        )

    def _keep(self, values: list[Value]) -> Any:
        return lambda message: values.append(Value(self.now(), message.data))

    def other_commanders(self) -> list[str]:
        """Return the other nodes that publish commands; the small test must not begin beside them."""
        names = {topic.name for topic, _ in self.commands()}
        return sorted({e.node for e in self.endpoints() if e.publishes and e.topic in names})

    def endpoints(self) -> tuple[Endpoint, ...]:
        """Return publishers and subscriptions of the vehicle's topics, without this node and bystanders."""
        found = []
        for topic in (*_LISTENED, *(_LISTENED_OF_DIVERS if self._dives else ())):
            for info in self.node.get_publishers_info_by_topic(self.name(topic)):
                found.append(_endpoint(topic, True, info))
            for info in self.node.get_subscriptions_info_by_topic(self.name(topic)):
                if info.node_name not in _BYSTANDERS:
                    found.append(_endpoint(topic, False, info))
        return tuple(endpoint for endpoint in found if endpoint.node != self.node.get_name())

    def finish(self, begin: float, sim_time: bool) -> Recording:
        """Return the recording, completed with what discovery found.

        Args:
            begin: ROS time at which listening began, s.
            sim_time: whether ROS time came from /clock.
        """
        self.recording.listened_in = _domain(self.node)
        self.recording.endpoints = self.endpoints()
        self.recording.duration = self.now() - begin
        self.recording.sim_time = sim_time
        return self.recording
