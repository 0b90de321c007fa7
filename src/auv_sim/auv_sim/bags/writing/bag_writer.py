"""Writes a rosbag2 directory with MCAP storage, in the layout of ROS 2 Jazzy's recorder. ROS-free."""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any

from mcap import records
from rosbags.interfaces import Qos
from rosbags.rosbag2.metadata import dump_qos_v9

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags import metadata
from auv_sim.bags.definitions import Definition, typestore
from auv_sim.bags.metadata import METADATA_FILE, FileMetadata
from auv_sim.bags.texts import TEXTS
from auv_sim.bags.writing.channel import Channel
from auv_sim.bags.writing.mcap_file import Compression, McapFile
from auv_sim.bags.writing.topic_table import TopicTable

__all__ = ["METADATA_FILE", "BagWriter", "Channel", "typestore"]

#: Most bytes that wait in memory for a full disk; further messages are counted and given up.
PENDING_LIMIT = 16 * 1024 * 1024


class BagWriter:
    """One recording: `add_topic`, then `write` for each message, then `close`.

    Messages stay in memory until `flush` passes them to the operating system; a killed process loses only
    later ones.

    Args:
        directory: the new rosbag2 directory; it must not exist.
        compression: of the chunks, "none" or "zstd".
        chunk_size: bytes of messages that make a chunk.
        max_size: bytes after which a new file is begun; 0 for never.
        max_duration_ns: recorded time after which a new file is begun; 0 for never.
        texts: the flown configuration by file name, kept in every storage file.
        name: prefix of the storage files' names; the directory's name by default.
        definitions: types that need not be looked up.
        profile: of every file.

    Raises:
        ConfigurationError: the directory exists or cannot be made, or the compression is unknown.
    """

    def __init__(
        self,
        directory: Path,
        compression: Compression = "none",
        chunk_size: int = 1024 * 1024,
        max_size: int = 0,
        max_duration_ns: int = 0,
        texts: Mapping[str, str] | None = None,
        name: str | None = None,
        definitions: Mapping[str, Definition] | None = None,
        profile: str = "ros2",
    ) -> None:
        if compression not in ("none", "zstd"):
            raise ConfigurationError("compression", repr(compression), "none or zstd")
        self.directory = directory
        self._compression: Compression = compression
        self._chunk_size = chunk_size
        self._max_size, self._max_duration_ns = max_size, max_duration_ns
        self._texts = dict(texts or {})
        self._profile = profile
        self._name = name or directory.resolve().name
        self._topics = TopicTable(definitions)
        self._files: list[FileMetadata] = []
        self._closed = self._whole = False
        #: Messages given up because the disk had no room for them.
        self.given_up = 0
        try:
            directory.mkdir(parents=True)
            self._file = self._open()
        except FileExistsError:
            raise ConfigurationError(str(directory), "something with this name", "a new directory") from None
        except OSError as error:
            raise ConfigurationError(str(directory), f"{error.strerror}", "a place to write to") from None

    def _open(self) -> McapFile:
        path = self.directory / f"{self._name}_{len(self._files)}.mcap"
        self._topics.begin_file()
        file = McapFile(path, self._compression, self._chunk_size, self._profile)
        if self._texts:
            file.metadata(TEXTS, self._texts)
            file.journal.commit()
        return file

    @property
    def file(self) -> Path:
        """The file that is being written."""
        return self._file.path

    @property
    def counts(self) -> dict[str, int]:
        """Messages written so far: topic name -> number."""
        return {channel.name: channel.count for channel in self._topics}

    @property
    def size(self) -> int:
        """Bytes passed on so far, all files."""
        return sum(file.size for file in self._files) + self._file.size

    @property
    def pending(self) -> int:
        """Bytes not yet passed to the operating system."""
        return self._file.journal.pending + self._file.filling

    @property
    def trouble(self) -> str:
        """Reason why nothing can be written at present; empty without one."""
        error = self._file.journal.error
        return "" if error is None else f"{self.file.name}: {error.strerror}"

    def add_topic(self, name: str, type_name: str, qos: Sequence[Qos]) -> Channel:
        """Announce a topic; topics may be added at any time.

        Args:
            name: full topic name (``/auv/odom``).
            type_name: ROS type (``nav_msgs/msg/Odometry``).
            qos: the QoS that each publisher offers.

        Raises:
            ConfigurationError: the type is unknown, or the topic was added before.
        """
        return self._topics.add(name, type_name, qos)

    def find(self, name: str) -> Channel | None:
        """Return a topic that was added before, by its full name; None without one."""
        return self._topics.find(name)

    def copy_topic(
        self, channel: records.Channel, schema: records.Schema | None, qos: Sequence[Qos]
    ) -> Channel:
        """Announce a topic of another file with its description there."""
        return self._topics.copy(channel, schema, qos)

    def copy(self, record: records.Metadata | records.Attachment) -> None:
        """Copy a metadata record or an attachment of another file."""
        if isinstance(record, records.Metadata):
            self._file.metadata(record.name, record.metadata)
        else:
            self._file.attachment(record)

    def set_qos(self, channel: Channel, qos: Sequence[Qos]) -> None:
        """Set the QoS that the publishers offer; ignored after the topic's first message."""
        if not channel.count:
            channel.qos = list(dump_qos_v9(list(qos)))

    def write(
        self, channel: Channel, log_time_ns: int, publish_time_ns: int, cdr: bytes, sequence: int = 0
    ) -> None:
        """Record one message.

        Args:
            channel: from `add_topic`.
            log_time_ns: time of receipt, ns.
            publish_time_ns: time of sending, ns.
            cdr: the serialised message with its four bytes of CDR header.
            sequence: number from its publisher.
        """
        if self._closed or self._file.journal.pending > PENDING_LIMIT:
            self.given_up += 1
            return
        if channel.latched:
            channel.keep(sequence, publish_time_ns, cdr)
        number = channel.number or self._topics.announce(channel, self._file)
        self._file.add(number, sequence, log_time_ns, publish_time_ns, cdr)
        channel.count += 1

    def flush(self) -> bool:
        """Pass everything to the operating system; return False while the disk is full (see `trouble`)."""
        if not self._file.flush():
            return False
        file = self._file
        full = self._max_size and file.size >= self._max_size
        long = self._max_duration_ns and file.last_ns - file.first_ns >= self._max_duration_ns
        if file.messages and (full or long):
            self._finish_file()
            self._file = self._open()
            self._repeat(file.last_ns)
        return True

    def _repeat(self, log_time_ns: int) -> None:
        """Begin a further file with the latched messages, so that it is complete without the others."""
        for channel in self._topics:
            for sequence, publish_time_ns, cdr in channel.kept:
                number = channel.number or self._topics.announce(channel, self._file)
                self._file.add(number, sequence, log_time_ns, publish_time_ns, cdr)
                channel.repeated += 1

    def _finish_file(self) -> bool:
        file = self._file
        for channel in self._topics:
            if not channel.number and not self._files:
                self._topics.announce(channel, self._file)
        if not file.journal.commit() or not file.flush():
            file.journal.close()
            return False
        self._files.append(
            FileMetadata(file.path.name, file.first_ns, file.last_ns, file.messages, file.size)
        )
        # rosbag2 keeps a copy in the storage file, so that the file is complete without metadata.yaml.
        file.metadata("rosbag2", {"serialized_metadata": metadata.dump(self._information()).rstrip("\n")})
        return file.finish()

    def close(self) -> bool:
        """Write the index and metadata.yaml; calling it again has no effect.

        Returns:
            Whether the recording is whole. A disk without room leaves it unfinished, but readable.
        """
        if not self._closed:
            self._closed = True
            if self._finish_file():
                with contextlib.suppress(OSError):
                    metadata.write(self.directory, self._information())
                    self._whole = True
        return self._whole

    @property
    def closed(self) -> bool:
        """Whether `close` was called; later messages are given up and counted."""
        return self._closed

    def _information(self) -> dict[str, Any]:
        return metadata.information(self._topics.metadata(), self._files)

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
