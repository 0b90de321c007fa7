"""Writes a rosbag2 directory with MCAP storage, laid out as ROS 2 Jazzy's own recorder does. Needs no ROS."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import Any, Literal

import yaml
from mcap.writer import CompressionType, Writer
from rosbags.interfaces import Qos
from rosbags.rosbag2.metadata import dump_qos_v9
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from auv_msgs_py.errors import ConfigurationError

METADATA_FILE = "metadata.yaml"
METADATA_VERSION = 9
ROS_DISTRO = "jazzy"

_COMPRESSION = {"none": CompressionType.NONE, "zstd": CompressionType.ZSTD}


@cache
def typestore() -> Typestore:
    """The message definitions of ROS 2 Jazzy; made once, it takes a tenth of a second."""
    return get_typestore(Stores.ROS2_JAZZY)


class Channel:
    """Handle of one recorded topic; `count` is the number of messages written to it."""

    __slots__ = ("count", "id", "name", "qos", "type", "type_hash")

    def __init__(self, number: int, name: str, type_name: str, type_hash: str, qos: list[Any]) -> None:
        self.id = number
        self.name = name
        self.type = type_name
        self.type_hash = type_hash
        self.qos = qos
        self.count = 0


class BagWriter:
    """One recording: `add_topic`, then `write` as often as wanted, then `close`.

    Messages gather in memory until a chunk is full or `flush` is called. After `flush` the operating
    system has them, so a process that is killed loses only what came later.

    Args:
        directory: the rosbag2 directory to make; it must not exist.
        compression: of the chunks, "none" or "zstd".
        chunk_size: bytes of messages that make a chunk.

    Raises:
        ConfigurationError: the directory exists or cannot be made, or the compression is unknown.
    """

    def __init__(
        self, directory: Path, compression: Literal["none", "zstd"] = "none", chunk_size: int = 1024 * 1024
    ) -> None:
        if compression not in _COMPRESSION:
            raise ConfigurationError("compression", repr(compression), "none or zstd")
        try:
            directory.mkdir(parents=True)
        except FileExistsError:
            raise ConfigurationError(str(directory), "something with this name", "a new directory") from None
        except OSError as error:
            raise ConfigurationError(str(directory), f"{error.strerror}", "a place to write to") from None
        self.directory = directory
        self.file = directory / f"{directory.resolve().name}_0.mcap"
        self._stream = self.file.open("xb")
        self._writer = Writer(self._stream, chunk_size=chunk_size, compression=_COMPRESSION[compression])
        self._writer.start(profile="ros2", library="auv_sim")
        # Bound once: the look-up would be paid for every message.
        self._add_message = self._writer.add_message
        self._channels: dict[str, Channel] = {}
        self._schemas: dict[str, tuple[int, str]] = {}
        self._first_ns = sys.maxsize
        self._last_ns = 0
        self._closed = False

    @property
    def counts(self) -> dict[str, int]:
        """Messages written so far: topic name -> number."""
        return {channel.name: channel.count for channel in self._channels.values()}

    def add_topic(self, name: str, type_name: str, qos: Sequence[Qos]) -> Channel:
        """Announce a topic; topics may be added at any time.

        Args:
            name: full topic name (``/auv/odom``).
            type_name: ROS type (``nav_msgs/msg/Odometry``).
            qos: the QoS that each publisher offers.

        Raises:
            ConfigurationError: the type is not one of ROS 2 Jazzy's, or the topic was added before.
        """
        if name in self._channels:
            raise ConfigurationError(name, "a topic that is recorded already", "a new topic")
        schema, type_hash = self._schema(name, type_name)
        offered = dump_qos_v9(list(qos))
        number = self._writer.register_channel(
            name,
            "cdr",
            schema,
            {"offered_qos_profiles": _yaml(offered).rstrip("\n"), "topic_type_hash": type_hash},
        )
        channel = Channel(number, name, type_name, type_hash, list(offered))
        self._channels[name] = channel
        return channel

    def _schema(self, topic: str, type_name: str) -> tuple[int, str]:
        if type_name not in self._schemas:
            store = typestore()
            if type_name not in store.fielddefs:
                raise ConfigurationError(topic, f"the type {type_name}", "a message type of ROS 2 Jazzy")
            text, _ = store.generate_msgdef(type_name, ros_version=2)
            number = self._writer.register_schema(type_name, "ros2msg", text.encode())
            self._schemas[type_name] = number, store.hash_rihs01(type_name)
        return self._schemas[type_name]

    def write(self, channel: Channel, log_time_ns: int, publish_time_ns: int, cdr: bytes) -> None:
        """Record one message.

        Args:
            channel: what `add_topic` returned.
            log_time_ns: when it was received, ns.
            publish_time_ns: when it was sent, ns.
            cdr: the serialised message with its four bytes of CDR header; never looked into.
        """
        self._add_message(channel.id, log_time_ns, cdr, publish_time_ns)
        channel.count += 1
        if log_time_ns > self._last_ns:
            self._last_ns = log_time_ns
        if log_time_ns < self._first_ns:
            self._first_ns = log_time_ns

    def flush(self) -> None:
        """End the current chunk and hand it to the operating system; cheap when nothing is pending."""
        self._writer.flush()  # type: ignore[no-untyped-call]

    def close(self) -> None:
        """Write the index and metadata.yaml; harmless when called again."""
        if self._closed:
            return
        self._closed = True
        information = self._information()
        # rosbag2 keeps a copy inside the storage file, so that the file alone tells everything.
        self._writer.add_metadata("rosbag2", {"serialized_metadata": _yaml(information).rstrip("\n")})
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._stream.close()
        metadata = self.directory / METADATA_FILE
        draft = metadata.with_suffix(".yaml.tmp")
        with draft.open("w", encoding="utf-8") as stream:
            stream.write(_yaml({"rosbag2_bagfile_information": information}))
            stream.flush()
            os.fsync(stream.fileno())
        draft.replace(metadata)

    def _information(self) -> dict[str, Any]:
        channels = self._channels.values()
        total = sum(channel.count for channel in channels)
        start = {"nanoseconds_since_epoch": self._first_ns if total else 0}
        duration = {"nanoseconds": self._last_ns - self._first_ns if total else 0}
        return {
            "version": METADATA_VERSION,
            "storage_identifier": "mcap",
            "duration": duration,
            "starting_time": start,
            "message_count": total,
            "topics_with_message_count": [
                {
                    "topic_metadata": {
                        "name": channel.name,
                        "type": channel.type,
                        "serialization_format": "cdr",
                        "offered_qos_profiles": channel.qos,
                        "type_description_hash": channel.type_hash,
                    },
                    "message_count": channel.count,
                }
                for channel in channels
            ],
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [self.file.name],
            "files": [
                {"path": self.file.name, "starting_time": start, "duration": duration, "message_count": total}
            ],
            "custom_data": None,
            "ros_distro": ROS_DISTRO,
        }

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class _Dumper(yaml.SafeDumper):
    """Spells every value out: yaml-cpp's older readers stumble over anchors and aliases."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _yaml(data: Any) -> str:
    return yaml.dump(data, Dumper=_Dumper, sort_keys=False, default_flow_style=False, allow_unicode=True)
