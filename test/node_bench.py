"""A test bench for one node over real DDS: it plays the rest of the vehicle."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.experimental import EventsExecutor
from rclpy.parameter import Parameter
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import fill_odometry, fill_water_velocity
from auv_msgs_py.contract.spatial_conversions import fill_spatial_odometry, fill_spatial_water
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.types import Navigation, SpatialNavigation, SpatialWater, WaterVelocity

#: The bench's stamps have nothing to do with the clock, and on a busy machine seconds may pass between two of
#: its messages: the bounds of wall time are the largest that the parameters allow, unless a test sets them.
_NAVIGATED = {"lateness": 60.0, "odometry_timeout": 10.0}
_PATIENT = {
    "CurrentObserverNode": _NAVIGATED,
    "GuidanceNode": {**_NAVIGATED, "holding__hold_after": 60.0},
    "HeadingAutopilotNode": {**_NAVIGATED, "reference_timeout": 10.0},
    "ManoeuvresNode": _NAVIGATED,
}
NORTHWARD = Navigation(0.0, 0.0, 0.0, 0.0)


class Bench:
    """A node that publishes what the node under test needs and keeps what it answers."""

    def __init__(self) -> None:
        self.node = rclpy.create_node("bench", namespace="/auv")
        self.executor = EventsExecutor()
        self.executor.add_node(self.node)
        self.received: dict[str, list[Any]] = defaultdict(list)
        self._publishers: dict[str, Any] = {}
        self._under_test: list[SuiteNode] = []

    def start(self, make: Callable[..., SuiteNode], role: str = "", **parameters: Any) -> SuiteNode:
        """Create the node under test and wait until the bench is matched with it.

        Args:
            make: the node's class.
            role: whose place in the table of topics it takes; its own by default.
            parameters: overrides, with `__` for a dot.
        """
        parameters = {**_PATIENT.get(getattr(make, "__name__", ""), {}), **parameters}
        overrides = [Parameter(name.replace("__", "."), value=value) for name, value in parameters.items()]
        node = make(namespace="/auv", parameter_overrides=overrides, use_global_arguments=False)
        self._under_test.append(node)
        self.executor.add_node(node)
        role = role or node.get_name()
        heard = {subscription.topic_name for subscription in node.subscriptions}
        spatial = [topic for topic in topics.SPATIAL_CONTRACT if topic in node.publishers_by_topic]
        for topic in (*topics.CONTRACT, *spatial, topics.STERNPLANE_CMD):
            if topic.publisher == role or topic is topics.DIAGNOSTICS:
                self._listen(topic)
            elif role in topic.subscribers and node.resolve_topic_name(topic.name) in heard:
                kind = qos.message_class(topic.type)
                self._publishers[topic.name] = self.node.create_publisher(
                    kind, topic.name, qos.offered(topic)
                )
        self.until(
            lambda: (
                all(publisher.get_subscription_count() for publisher in self._publishers.values())
                and all(publisher.get_subscription_count() for publisher in node.publishers_by_topic.values())
            )
        )
        return node

    def _listen(self, topic: Topic) -> None:
        kind = qos.message_class(topic.type)
        keep = self.received[topic.name].append
        self.node.create_subscription(kind, topic.name, keep, qos.requested(topic, reliable=True, depth=100))

    def until(self, condition: Callable[[], Any], patience: float = 180.0) -> None:
        deadline = time.monotonic() + patience
        while not condition():
            assert time.monotonic() < deadline, "the node did not do what was waited for"
            self.executor.spin_once(timeout_sec=0.02)

    def until_newest(self, topic: Topic, condition: Callable[[Any], Any]) -> Any:
        """Wait until the newest message of a topic fulfils the condition; return it.

        Latched topics are waited for in this way and not by number: their writers keep one message, so that
        a late reader receives the newest alone.
        """
        kept = self.received[topic.name]
        self.until(lambda: kept and condition(kept[-1]))
        return kept[-1]

    def spin(self, seconds: float) -> None:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.executor.spin_once(timeout_sec=0.02)

    def send(self, topic: Topic, message: Any) -> None:
        self._publishers[topic.name].publish(message)

    def odometry(
        self, seconds: float, navigation: Navigation, frames: tuple[str, str] = ("map", "base_link")
    ) -> None:
        message = Odometry()
        message.header.frame_id, message.child_frame_id = frames
        fill_odometry(message, navigation, 1.9, 0.0, round(seconds * 1e9))
        self.send(topics.ODOM, message)

    def water(self, seconds: float, ur: float, vr: float = 0.0, frame: str = "base_link") -> None:
        message = TwistWithCovarianceStamped()
        message.header.frame_id = frame
        fill_water_velocity(message, WaterVelocity(ur, vr), round(seconds * 1e9))
        self.send(topics.WATER_VELOCITY, message)

    def measurement(self, seconds: float, navigation: Navigation, ur: float, frames: tuple[str, str]) -> None:
        """Water velocity, then odometry: two topics, between which DDS keeps no order."""
        self.water(seconds, ur, frame=frames[1])
        self.spin(0.01)
        self.odometry(seconds, navigation, frames)

    def diving(self, seconds: float, navigation: SpatialNavigation, water: SpatialWater | None) -> None:
        """Velocity through the water, if it is measured, then odometry."""
        if water is not None:
            message = TwistWithCovarianceStamped()
            message.header.frame_id = "base_link"
            fill_spatial_water(message, water, round(seconds * 1e9))
            self.send(topics.WATER_VELOCITY, message)
            self.spin(0.01)
        odometry = Odometry()
        odometry.header.frame_id, odometry.child_frame_id = "map", "base_link"
        fill_spatial_odometry(odometry, navigation, (1.9, 0.0, 0.0), 0.0, round(seconds * 1e9))
        self.send(topics.ODOM, odometry)

    def reference(self, yaw: float, rate: float, thrust: float) -> None:
        for topic, value in zip(
            (topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST),
            (yaw, rate, thrust),
            strict=True,
        ):
            self.send(topic, Float64(data=value))

    def call(self, service: str) -> Trigger.Response:
        client = self.node.create_client(Trigger, service)
        self.until(client.service_is_ready)
        future = client.call_async(Trigger.Request())
        self.until(future.done)
        return future.result()

    def values(self, topic: Topic) -> list[float]:
        return [message.data for message in self.received[topic.name]]

    def diagnosed(self, text: str) -> bool:
        arrays: list[DiagnosticArray] = self.received[topics.DIAGNOSTICS.name]
        return any(
            text in part
            for array in arrays for status in array.status
            for part in (status.message, *(pair.value for pair in status.values))
        )  # fmt: skip

    def close(self) -> None:
        for node in self._under_test:
            node.close()
            node.destroy_node()
        self.node.destroy_node()
