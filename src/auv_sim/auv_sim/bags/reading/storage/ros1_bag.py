"""Reads ROS 1 bags with `rosbags`, every message in the notation of ROS 2."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from rosbags.convert.converter import is_same_wireformat, migrate_bytes
from rosbags.highlevel import AnyReader
from rosbags.interfaces import Connection
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.recording import Bag, RecordedTopic, TopicFilter

_ROS1 = "a ROS 1 bag"
_HEADER = "std_msgs/msg/Header"


def read_ros1(bag: Bag, file: Path, keeps: TopicFilter) -> None:
    """Add a file to a recording.

    Raises:
        ConfigurationError: nothing in it can be read.
    """
    before = bag.count
    try:
        with AnyReader([file]) as reader:
            converters: dict[int, tuple[RecordedTopic, Callable[[bytes], bytes]]] = {}
            store = _store(reader.typestore)
            for connection in reader.connections:
                topic = _topic(bag, file, connection, store)
                if topic is not None:
                    converters[connection.id] = topic, _converter(reader.typestore, store, topic.type)
            for connection, log_ns, data in reader.messages():
                if connection.id in converters:
                    topic, convert = converters[connection.id]
                    cdr = convert(data)
                    bag.order.append((topic, topic.count))
                    topic.put(0, log_ns, log_ns, cdr, keeps(topic.name, topic.type))
    except Exception as error:
        # A damaged file makes the reader raise any exception.
        reason = " ".join(str(error).split())
        if bag.count == before:
            found = f"a recording that cannot be read ({reason})"
            raise ConfigurationError(str(file), found, _ROS1) from None
        bag.notes.append(f"{file.name}: only a part is readable ({reason})")


def _store(recorded: Typestore) -> Typestore:
    """Return ROS 2 Jazzy's types, with its header without `seq`, and the recorded types that it lacks."""
    store = get_typestore(Stores.ROS2_JAZZY)
    known = typestore().fielddefs
    store.register({name: kind for name, kind in recorded.fielddefs.items() if name not in known})
    return store


def _topic(bag: Bag, file: Path, connection: Connection, store: Typestore) -> RecordedTopic | None:
    topic = bag.topics.get(connection.topic)
    if topic is None:
        topic = bag.topics[connection.topic] = RecordedTopic(connection.topic, connection.msgtype)
        topic.definition, _ = store.generate_msgdef(connection.msgtype, ros_version=2)
        topic.encoding = "ros2msg"
    elif topic.type != connection.msgtype:
        second = f"messages of a second type {connection.msgtype!r} on {topic.name} left out"
        bag.notes.append(f"{file.name}: {second}")
        return None
    return topic


def _converter(recorded: Typestore, store: Typestore, name: str) -> Callable[[bytes], bytes]:
    """Return the converter: realign where ROS 2's type has the same fields (except `seq`), else migrate."""
    if is_same_wireformat(recorded, store, name, name):
        return lambda data: bytes(store.ros1_to_cdr(data, name))
    cache: dict[str, Any] = {}
    return lambda data: bytes(
        migrate_bytes(recorded, store, name, name, cache, data, src_is2=False, dst_is2=True)
    )
