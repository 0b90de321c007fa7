"""The contract's QoS, and message classes by name."""

from __future__ import annotations

import importlib
from functools import cache
from typing import Any

from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from auv_msgs_py.contract.topics import Topic

DEPTH = 10
#: A recorder must never be outrun.
RECORDER_DEPTH = 1000


def offered(topic: Topic) -> QoSProfile:
    """What a publisher offers: reliable; a latched topic is transient local and keeps its newest message.

    With more a late reader is given the oldest of them first, which is what `ros2 topic echo --once` prints.
    """
    return _profile(ReliabilityPolicy.RELIABLE, topic.latched, 1 if topic.latched else DEPTH)


def requested(topic: Topic, reliable: bool, depth: int = DEPTH) -> QoSProfile:
    """What a subscriber asks for: best effort unless `reliable`; latched topics both reliable and kept."""
    wanted = ReliabilityPolicy.RELIABLE if reliable or topic.latched else ReliabilityPolicy.BEST_EFFORT
    return _profile(wanted, topic.latched, depth)


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
