"""Velocities and odometry of other makers as messages of the wire contract."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import FrameIds
from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.other_makers.message_parts import vector_in
from auv_sim.bags.reading.recording import RecordedTopic
from auv_sim.vehicle.hulls.rigid_body import to_body

#: Type of a velocity through the water -> where its vector is. The contract's type is the first.
VELOCITIES = {
    topics.WATER_VELOCITY.type: "twist.twist.linear",
    "geometry_msgs/msg/TwistStamped": "twist.linear",
    "geometry_msgs/msg/Vector3Stamped": "vector",
    "geometry_msgs/msg/TwistWithCovariance": "twist.linear",
    "geometry_msgs/msg/Twist": "linear",
    "geometry_msgs/msg/Vector3": "",
    topics.ODOM.type: "twist.twist.linear",
}
Times = NDArray[np.int64]


def velocity_as_contract(
    topic: RecordedTopic, stamp_of: Callable[[Times], NDArray[np.float64]]
) -> RecordedTopic:
    """Return a velocity through the water as the contract's type.

    A message without a header has the time of its log and an empty frame id; one whose type has a
    `child_frame_id` is in that frame.

    Args:
        topic: as recorded.
        stamp_of: log times (ns) -> times of the odometry's clock, s; NaN after the last odometry.

    Raises:
        Exception: bytes that are no such message.
    """
    part = topic.part or VELOCITIES[topic.type]
    if topic.type == topics.WATER_VELOCITY.type and part == VELOCITIES[topic.type]:
        return topic
    decoder, logged = deserializer(topic), stamp_of(np.array(topic.log_ns, np.int64))
    messages: list[bytes | None] = []
    for data, at in zip(topic.messages, logged, strict=True):
        message = None if data is None else decoder(data)
        vector = None if message is None else vector_in(message, part)
        header = getattr(message, "header", None)
        header = header if hasattr(header, "stamp") else None
        if vector is None or (header is None and np.isnan(at)):
            messages.append(None)
            continue
        stamp = round(at * 1e9) if header is None else header.stamp.sec * 10**9 + header.stamp.nanosec
        frame = "" if header is None else getattr(message, "child_frame_id", header.frame_id)
        messages.append(_velocity(stamp, frame, vector))
    return dataclasses.replace(topic, type=topics.WATER_VELOCITY.type, messages=messages, part="")


def _velocity(stamp: int, frame: str, vector: tuple[float, float, float]) -> bytes:
    """Return a serialised velocity through the water."""
    kinds = typestore().types
    time = kinds["builtin_interfaces/msg/Time"](*divmod(stamp, 10**9))
    still = kinds["geometry_msgs/msg/Vector3"](0.0, 0.0, 0.0)
    twist = kinds["geometry_msgs/msg/Twist"](kinds["geometry_msgs/msg/Vector3"](*vector), still)
    covered = kinds["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36))
    message = kinds[topics.WATER_VELOCITY.type](kinds["std_msgs/msg/Header"](time, frame), covered)
    return bytes(typestore().serialize_cdr(message, topics.WATER_VELOCITY.type))


def twist_world(frames: tuple[tuple[str, ...], ...], ids: FrameIds) -> tuple[str, str] | None:
    """Return the world frame that the twist of an odometry is in, and the body frame of the same axes.

    The twist of an odometry is in its `child_frame_id`, here a world frame of the same axes as `frame_id`.
    The body's axes are FLU in ENU, FRD in NED.

    Args:
        frames: pairs of frame ids that an odometry has.
        ids: accepted frame ids.

    Returns:
        None where the twist is in another frame, or its frame changes.
    """
    if len(frames) != 1:
        return None
    world, child = (name.rsplit("/", 1)[-1] for name in frames[0])
    if not child or child in (*ids.flu_body, *ids.frd_body):
        return None
    for worlds, bodies in ((ids.enu_world, ids.flu_body), (ids.ned_world, ids.frd_body)):
        if {world, child} <= set(worlds) and bodies:
            return frames[0][1], bodies[0]
    return None


def twist_in_body(topic: RecordedTopic, body: str) -> RecordedTopic:
    """Return an odometry with its twist turned from the world into the body by the attitude in each message.

    Args:
        topic: odometry.
        body: frame id of the body.

    Raises:
        Exception: bytes that are no odometry, or an orientation that is no attitude.
    """
    messages = [None if data is None else _turned(data, body) for data in topic.messages]
    return dataclasses.replace(topic, messages=messages)


def _turned(data: bytes, body: str) -> bytes:
    """Return a serialised odometry with its twist turned from the world into the body."""
    message: Any = typestore().deserialize_cdr(data, topics.ODOM.type)
    q = message.pose.pose.orientation
    length = math.hypot(q.w, q.x, q.y, q.z)
    if not 0.0 < length < math.inf:
        raise ValueError(f"an orientation of length {length:g}")
    attitude = q.w / length, q.x / length, q.y / length, q.z / length
    for vector in (message.twist.twist.linear, message.twist.twist.angular):
        vector.x, vector.y, vector.z = to_body(*attitude, vector.x, vector.y, vector.z)
    message.child_frame_id = body
    return bytes(typestore().serialize_cdr(message, topics.ODOM.type))
