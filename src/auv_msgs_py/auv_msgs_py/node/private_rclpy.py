"""Everything that the suite takes from rclpy's private parts; no other module does, which a test checks.

rclpy may change these names in any release. They were tried with rclpy 7.1.6, the one of ROS 2 Jazzy that is
pinned. For another release, run the tests of this module first.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy._rclpy_pybind11 import RCLError
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

__all__ = ["RCLError", "parameter_overrides", "raw_sender", "stop_reading_clock", "take_polled"]


def parameter_overrides(node: Node) -> dict[str, Parameter]:
    """Return the parameters that a node was started with, by name, as a dictionary that counts when changed.

    rclpy offers no public way to list them before they are declared.
    """
    overrides: dict[str, Parameter] = node._parameter_overrides
    return overrides


def raw_sender(publisher: Publisher) -> Callable[[bytes], None]:
    """Return the function that sends serialised messages.

    `Publisher.publish` ends with it for bytes; its checks before take as long again.
    """
    sender: Callable[[bytes], None] = publisher.handle.publish_raw
    return sender


def stop_reading_clock(node: Node) -> None:
    """Destroy the node's reader of /clock; its clock stays under simulated time and is set by its owner.

    The public way, `use_sim_time` false, would put the clock back to the machine's time.
    """
    node._time_source.detach_node()


def take_polled(node: Node, subscription: Subscription) -> Callable[[Any, bool], Any]:
    """Hide a subscription from executors and return the function that takes its next message.

    Call it before an executor has looked at the node, which would wake up for every message. The function
    takes the message class and whether to return bytes; it returns the message and its information, or None.
    """
    node._subscriptions.remove(subscription)
    take: Callable[[Any, bool], Any] = subscription.handle.take_message
    return take
