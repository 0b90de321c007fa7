"""Reads a recording as a `Run`: any rosbag2 directory with the topics of the wire contract."""

from __future__ import annotations

import contextlib
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.frames import (
    FrameIds,
    FrameTable,
)
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused
from auv_sim.bags import line_owner
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.columns import Columns, decode
from auv_sim.bags.reading.deserialize import deserializer
from auv_sim.bags.reading.recording import Bag, RecordedTopic
from auv_sim.bags.reading.run_columns import RecordedColumns, assemble
from auv_sim.flight.run_record import Run

#: Every topic with signals of a `Run`.
USED = (
    topics.ODOM,
    topics.WATER_VELOCITY,
    topics.RUDDER_STATE,
    topics.TRUE_CURRENT,
    topics.TRUE_ODOM,
    topics.CURRENT_ESTIMATE,
    topics.DESIRED_YAW,
    topics.DESIRED_YAW_RATE,
    topics.PATH_PARAMETER,
    topics.PATH_ERROR,
    topics.RUDDER_CMD,
    topics.THRUST_CMD,
    *topics.SPATIAL_CONTRACT,
)
#: Its states are intervals of time, not numbers.
_STATE = topics.MISSION_STATE  # fmt: skip


def load(bag: Path, namespace: str | None = None, frame_ids: FrameIds | None = None) -> Run:
    """Read a recording.

    Topics are found by the last part of their names. Stamped messages are matched with the odometry by
    stamp; unstamped ones row by row when there is exactly one for each odometry (lockstep), else by log
    time. In both cases the newest message that is not younger than the odometry counts.

    Args:
        bag: the rosbag2 directory.
        namespace: of the vehicle, needed only when the bag holds several (``/auv``).
        frame_ids: the frame ids to accept; the contract's by default.

    Returns:
        The run in NED / FRD on the odometry's stamps, which strictly increase: a lone older or repeated
        stamp is left out, and reading ends at a backward jump (a reset).

    Raises:
        ConfigurationError: not a readable recording, no odometry, topics of several vehicles, a topic
            of another type, or frame ids that are unknown or change.
    """

    def keeps(name: str, type_name: str) -> bool:
        return is_used(name, type_name) and (namespace is None or line_owner.is_within(name, namespace))

    return run_of(read_bag(bag, keeps), namespace, frame_ids)


def is_used(name: str, type_name: str) -> bool:
    """Return whether a topic has signals of a `Run`; it may be odometry of any name."""
    used = {topic.name for topic in (*USED, _STATE)}
    return type_name == topics.ODOM.type or name.rsplit("/", 1)[-1] in used


def run_of(bag: Bag, namespace: str | None = None, frame_ids: FrameIds | None = None) -> Run:
    """Return the run of a bag in memory, as `load`.

    Raises:
        ConfigurationError: as `load`.
    """
    recorded = {}
    for topic, found in _read(bag, namespace).items():
        # By log time, as every reader sorts them; messages of one time stay in the order of the file.
        rows = np.argsort(np.array(found.log_ns, np.int64), kind="stable")
        messages = [message for k in rows if (message := found.messages[k]) is not None]
        if messages:
            log_ns = np.array(found.log_ns, np.int64)[rows]
            recorded[topic] = RecordedColumns(log_ns, _decoded(topic, messages, bag.path))
    if topics.ODOM not in recorded:
        expected = f"messages on {topics.ODOM.name}, or of type {topics.ODOM.type} on one other topic"
        raise ConfigurationError(str(bag.path), "no odometry", expected)
    table = FrameTable(frame_ids or FrameIds())
    state = bag.find(_STATE.name, namespace)
    states = messages_of(state) if state is not None and state.type == _STATE.type else []
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # numbers of a damaged message
            return assemble(recorded, states, table, bag.path)
    except MessageRefused as refused:
        raise ConfigurationError(f"{bag.path}: {refused.topic}", refused.found, refused.expected) from None


def load_messages(bag: Path, name: str, namespace: str | None = None) -> list[tuple[int, Any]]:
    """Return all messages of one topic, deserialised.

    Args:
        bag: the rosbag2 directory.
        name: last part of the topic's name (``mission_state``).
        namespace: as in `load`.

    Returns:
        (log time in ns, message) in the order of log time; empty when the topic was not recorded.

    Raises:
        ConfigurationError: not a readable recording, or topics of several vehicles.
    """
    content = read_bag(bag, lambda topic, _: topic.rsplit("/", 1)[-1] == name)
    found = content.find(name, namespace)
    if found is None:
        return []
    return messages_of(found)


def messages_of(topic: RecordedTopic) -> list[tuple[int, Any]]:
    """Return (log time in ns, message) of every decodable message, by log time."""
    decode_one = deserializer(topic)
    decoded = []
    for log_ns, cdr in sorted(zip(topic.log_ns, topic.messages, strict=True), key=itemgetter(0)):
        if cdr is not None:
            with contextlib.suppress(Exception):  # damaged bytes raise any exception
                decoded.append((log_ns, decode_one(cdr)))
    return decoded


def _read(bag: Bag, namespace: str | None) -> dict[Topic, RecordedTopic]:
    chosen: dict[Topic, RecordedTopic] = {}
    for topic in USED:
        found = bag.find(topic.name, namespace)
        if found is None:
            continue
        if found.type != topic.type:
            raise ConfigurationError(f"{bag.path}: {found.name}", found.type, topic.type)
        chosen[topic] = found
    return chosen


def _decoded(topic: Topic, messages: list[bytes], bag: Path) -> Columns:
    try:
        return decode(topic.type, messages)
    except Exception as error:
        # Bytes of no such message: rosbags raises any exception.
        reason = " ".join(str(error).split())
        raise ConfigurationError(
            f"{bag}: {topic.name}", f"a damaged message ({reason})", topic.type
        ) from None
