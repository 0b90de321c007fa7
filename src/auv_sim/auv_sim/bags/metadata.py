"""rosbag2's metadata.yaml, version 9: its content and its YAML."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from auv_msgs_py.settings.result_files import write_text

METADATA_FILE = "metadata.yaml"
METADATA_VERSION = 9
ROS_DISTRO = "jazzy"


class TopicMetadata(NamedTuple):
    """One topic: QoS profiles as `rosbags` dumps them, messages serialised as `encoding`."""

    name: str
    type: str
    messages: int
    qos: list[Any]
    type_hash: str
    encoding: str = "cdr"


class FileMetadata(NamedTuple):
    """One storage file: first and last log time (ns), messages, bytes."""

    name: str
    first_ns: int
    last_ns: int
    messages: int
    size: int


def information(
    topics: Sequence[TopicMetadata], files: Sequence[FileMetadata], storage: str = "mcap"
) -> dict[str, Any]:
    """Return the content below the file's one key, in rosbag2's order; `storage` names the format."""
    held = [file for file in files if file.messages]
    first = min((file.first_ns for file in held), default=0)
    last = max((file.last_ns for file in held), default=0)
    return {
        "version": METADATA_VERSION,
        "storage_identifier": storage,
        "duration": {"nanoseconds": last - first},
        "starting_time": {"nanoseconds_since_epoch": first},
        "message_count": sum(file.messages for file in files),
        "topics_with_message_count": [_topic(topic) for topic in topics],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [file.name for file in files],
        "files": [_file(file) for file in files],
        "custom_data": None,
        "ros_distro": ROS_DISTRO,
    }


def _topic(topic: TopicMetadata) -> dict[str, Any]:
    return {
        "topic_metadata": {
            "name": topic.name,
            "type": topic.type,
            "serialization_format": topic.encoding,
            "offered_qos_profiles": topic.qos,
            "type_description_hash": topic.type_hash,
        },
        "message_count": topic.messages,
    }


def _file(file: FileMetadata) -> dict[str, Any]:
    return {
        "path": file.name,
        "starting_time": {"nanoseconds_since_epoch": file.first_ns},
        "duration": {"nanoseconds": file.last_ns - file.first_ns},
        "message_count": file.messages,
    }


def write(directory: Path, content: dict[str, Any]) -> None:
    """Write the file whole or not at all.

    Raises:
        NotWritten: it cannot be written.
    """
    write_text(directory / METADATA_FILE, dump({"rosbag2_bagfile_information": content}))


class _PlainDumper(yaml.SafeDumper):
    """Writes no anchors and aliases, which yaml-cpp's older readers do not support."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def dump(data: Any) -> str:
    """Return YAML as rosbag2 writes it."""
    return yaml.dump(data, Dumper=_PlainDumper, sort_keys=False, default_flow_style=False, allow_unicode=True)
