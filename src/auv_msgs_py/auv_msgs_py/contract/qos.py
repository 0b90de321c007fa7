"""The contract's QoS, and message classes by name."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic

#: Depth of subscriptions' queues, and of publishers' outside lockstep.
DEPTH = 10
#: Depth of a recorder's queues: it must not lose a message.
RECORDER_DEPTH = 1000


def offered(topic: Topic, lockstep: bool = False) -> QoSProfile:
    """Return a publisher's profile: reliable; a latched topic is transient local with a depth of 1.

    With a larger depth a late reader receives the oldest message first: `ros2 topic echo --once` prints that.

    Args:
        topic: to publish.
        lockstep: whether to keep all messages of the simulator's lead over the recorder, `RECORDING_LEAD`;
            of a latched topic the newest is enough.
    """
    depth = topics.RECORDING_LEAD if lockstep else DEPTH
    return _profile(ReliabilityPolicy.RELIABLE, topic.latched, 1 if topic.latched else depth)


def requested(topic: Topic, reliable: bool, depth: int = DEPTH) -> QoSProfile:
    """Return a subscriber's profile: best effort unless `reliable`; latched topics reliable and latched."""
    reliability = ReliabilityPolicy.RELIABLE if reliable or topic.latched else ReliabilityPolicy.BEST_EFFORT
    return _profile(reliability, topic.latched, depth)


def _profile(reliability: ReliabilityPolicy, latched: bool, depth: int) -> QoSProfile:
    return QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=depth,
        reliability=reliability,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


@cache
def message_class(name: str) -> Any:
    """`nav_msgs/msg/Odometry` -> the class."""
    package, kind, cls = name.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), cls)
