"""Publishes the transforms of a vehicle on /tf and /tf_static, where tf2_msgs is installed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from geometry_msgs.msg import Quaternion
from rclpy.node import Node

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_path_following.vehicle import Vehicle
from auv_sim.nodes.display import transforms
from auv_sim.nodes.display.markers import Place


class TransformPublisher:
    """Publishes the fixed transforms once and the moving ones on request.

    Args:
        node: the display.
        message: the class TFMessage.
        vehicle: with its fins.
        prefix: of the vehicle's frames, such as ``auv1/``.
    """

    def __init__(self, node: Node, message: Any, vehicle: Vehicle, prefix: str) -> None:
        self._message, self._vehicle, self._prefix = message, vehicle, prefix
        static = Topic("/tf_static", "tf2_msgs/msg/TFMessage", topics.DISPLAY, latched=True)
        self._static = node.create_publisher(message, static.name, qos.offered(static))
        self._static.publish(message(transforms=transforms.fixed_transforms(prefix)))
        self._moving = node.create_publisher(message, "/tf", 100)

    def publish(self, stamp: Any, place: Place, attitude: Quaternion, angles: Mapping[str, float]) -> None:
        """Publish the vehicle's transform and those of its fins, see `transforms.moving_transforms`."""
        moving = transforms.moving_transforms(stamp, place, attitude, self._vehicle, angles, self._prefix)
        self._moving.publish(self._message(transforms=moving))


def transform_publisher(node: Node, vehicle: Vehicle, prefix: str) -> TransformPublisher | None:
    """Return the publisher of a vehicle's transforms; None without tf2_msgs."""
    try:
        from tf2_msgs.msg import TFMessage
    except ImportError:
        node.get_logger().info("no transforms: tf2_msgs is not installed (ros-jazzy-tf2-msgs)")
        return None
    return TransformPublisher(node, TFMessage, vehicle, prefix)
