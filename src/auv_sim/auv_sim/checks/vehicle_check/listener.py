"""Listens to a vehicle's topics for the checks, and, when asked to, gives the commands of the small test."""

from __future__ import annotations

import math
import os
from typing import Any

from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.types import STOP
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.samples import Endpoint, OdometrySample, Recording, Value, WaterSample
from auv_sim.checks.vehicle_check.wiggle import END, FAREWELL, Wiggle

_DEPTH = 1000
#: The diagonal of a 6 x 6 covariance.
_DIAGONAL = slice(0, 36, 7)
#: Nodes that read commands without being the vehicle.
_BYSTANDERS = {topics.RECORDER, topics.AUTOPILOT, topics.LAUNCHER}
#: The small test ends at this silence of the odometry (s) and at this distance from where it began (m).
_SILENCE, _FAR = 1.0, 100.0
#: Without odometry a command is sent so often, s.
_PERIOD = 0.1


_COMMANDS = (topics.RUDDER_CMD, topics.THRUST_CMD)
_LISTENED = (topics.ODOM, topics.WATER_VELOCITY, topics.RUDDER_STATE, *_COMMANDS)


def _endpoint(topic: Topic, publishes: bool, info: Any) -> Endpoint:
    reliable = info.qos_profile.reliability == ReliabilityPolicy.RELIABLE
    latched = info.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return Endpoint(topic.name, publishes, info.topic_type, info.node_name, reliable, latched)


def _domain(node: Node) -> str:
    """Return where a node looks for others, for people: what publishes elsewhere is not found."""
    local_only = os.environ.get("ROS_LOCALHOST_ONLY") == "1"
    reach = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE") or ("LOCALHOST" if local_only else "SUBNET")
    return f"ROS domain {node.context.get_domain_id()}, discovery range {reach}"


class VehicleListener:
    """Keeps a `Recording` of one vehicle's topics.

    Args:
        node: whose subscriptions and clock are used.
        namespace: of the vehicle's topics.
        vehicle: whose limits the small test keeps; None to listen only.
    """

    def __init__(self, node: Node, namespace: str, vehicle: Vehicle | None) -> None:
        self.node = node
        self.recording = Recording()
        self.cut_short = ""
        self._answered = 0
        self._namespace = namespace
        self._wiggle = Wiggle.of(vehicle) if vehicle is not None else None
        self._begin: float | None = None
        self._origin: OdometrySample | None = None
        self._publishers: dict[Topic, Any] = {}
        self._listen(topics.ODOM, self._on_odometry)
        self._listen(topics.WATER_VELOCITY, self._on_water)
        self._listen(topics.RUDDER_STATE, self._keep(self.recording.rudder_state))
        recording = self.recording
        values_of = (recording.rudder_cmd, recording.thrust_cmd)
        for topic, values in zip(_COMMANDS, values_of, strict=True):
            if self._wiggle is None:
                self._listen(topic, self._keep(values))
            else:
                kind = qos.message_class(topic.type)
                self._publishers[topic] = node.create_publisher(kind, self.name(topic), qos.offered(topic))

    def name(self, topic: Topic) -> str:
        """The topic's full name."""
        return topics.full_name(self._namespace, topic.name)

    def now(self) -> float:
        """ROS time, s."""
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
        )  # fmt: skip
        self.recording.odom.append(sample)

    def _on_water(self, message: TwistWithCovarianceStamped) -> None:
        stamp, linear = nanoseconds(message.header.stamp) * 1e-9, message.twist.twist.linear
        covariance = tuple(message.twist.covariance[_DIAGONAL])
        self.recording.water.append(
            WaterSample(self.now(), stamp, message.header.frame_id, linear.x, linear.y, covariance)
        )

    def _keep(self, values: list[Value]) -> Any:
        return lambda message: values.append(Value(self.now(), message.data))

    def other_commanders(self) -> list[str]:
        """Other nodes that publish commands; the small test must not begin beside them."""
        return sorted({e.node for e in self.endpoints() if e.publishes and e.topic in
                       (topics.RUDDER_CMD.name, topics.THRUST_CMD.name)})  # fmt: skip

    def endpoints(self) -> tuple[Endpoint, ...]:
        """Publishers and subscriptions of the vehicle's topics, without this listener and bystanders."""
        found = []
        for topic in _LISTENED:
            for info in self.node.get_publishers_info_by_topic(self.name(topic)):
                found.append(_endpoint(topic, True, info))
            for info in self.node.get_subscriptions_info_by_topic(self.name(topic)):
                if info.node_name not in _BYSTANDERS:
                    found.append(_endpoint(topic, False, info))
        return tuple(endpoint for endpoint in found if endpoint.node != self.node.get_name())

    def tick(self) -> bool:
        """Give the next command; False when the small test is over."""
        assert self._wiggle is not None
        self._answered = len(self.recording.odom)
        now, odom = self.now(), self.recording.odom
        if self._begin is None:
            self._begin, self._origin = now, odom[-1] if odom else None
        seconds = now - self._begin
        command = STOP if self.cut_short else self._wiggle.at(seconds)
        if command != STOP:
            self.cut_short = self._danger(now)
            command = STOP if self.cut_short else command
        kept = (self.recording.rudder_cmd, self.recording.thrust_cmd)
        for publisher, value, values in zip(self._publishers.values(), command, kept, strict=True):
            values.append(Value(now, value))
            publisher.publish(Float64(data=value))
        return seconds < END + FAREWELL

    def due(self) -> bool:
        """Whether the next command is due: an odometry has come, or none for too long."""
        last = self.recording.thrust_cmd[-1].received
        return len(self.recording.odom) > self._answered or not last <= self.now() < last + _PERIOD

    def _danger(self, now: float) -> str:
        odom = self.recording.odom
        if not odom or now - odom[-1].received > _SILENCE:
            return f"no odometry for {_SILENCE:g} s"
        if self._origin is not None:
            far = math.hypot(odom[-1].x - self._origin.x, odom[-1].y - self._origin.y)
            if far > _FAR:
                return f"{far:.0f} m away from where it began"
        return ""

    def stop(self) -> None:
        """Zero commands, whatever happened."""
        for publisher in self._publishers.values():
            publisher.publish(Float64(data=0.0))

    def finish(self, begin: float, sim_time: bool) -> Recording:
        """The recording, complete with what discovery found."""
        self.recording.wiggled = self._wiggle is not None
        self.recording.listened_in = _domain(self.node)
        self.recording.endpoints = self.endpoints()
        self.recording.duration = self.now() - begin
        self.recording.sim_time = sim_time
        return self.recording
