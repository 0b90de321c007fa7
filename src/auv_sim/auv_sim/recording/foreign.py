"""Recordings in other storage (SQLite, packed as a whole, ROS 1), read by `rosbags`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rosbags.highlevel import AnyReader

from auv_msgs_py.errors import ConfigurationError
from auv_sim.recording.bag import Bag, RecordedTopic, Wanted
from auv_sim.recording.definitions import typestore


def read_foreign(bag: Bag, path: Path, files: list[Path], wanted: Wanted) -> None:
    """Fill `bag`.

    Raises:
        ConfigurationError: it cannot be read.
    """
    ros1 = files[0].suffix == ".bag"
    folder = path if path.is_dir() and not ros1 else files[0]
    bag.files = files
    bag.size = sum(file.stat().st_size for file in files)
    try:
        with AnyReader(files if ros1 else [folder], default_typestore=typestore()) as reader:
            for connection in reader.connections:
                topic = bag.topics.setdefault(
                    connection.topic, RecordedTopic(connection.topic, connection.msgtype)
                )
                topic.definition = str(connection.msgdef.data)
                topic.encoding = "ros2msg"
            for connection, log_ns, data in reader.messages():
                if ros1:
                    data = bytes(reader.typestore.ros1_to_cdr(data, connection.msgtype))
                topic = bag.topics[connection.topic]
                bag.order.append((topic, topic.count))
                keep = wanted(topic.name, topic.type)
                topic.put(0, log_ns, log_ns, data, keep)
    except Exception as error:
        # A damaged file makes the reader fail in any way it likes.
        if not bag.count:
            found = f"a recording that cannot be read ({_line(error)})"
            raise ConfigurationError(str(path), found, "a bag") from None
        bag.notes.append(f"only a part is readable ({_line(error)})")


def _line(error: Any) -> str:
    return " ".join(str(error).split())
