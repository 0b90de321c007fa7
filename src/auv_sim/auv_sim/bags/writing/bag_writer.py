"""Writes a rosbag2 directory with MCAP storage, laid out as ROS 2 Jazzy's own recorder does. Needs no ROS."""

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
from auv_sim.bags.definitions import Definition, definition, typestore
from auv_sim.bags.metadata import METADATA_FILE, FileMetadata, TopicMetadata
from auv_sim.bags.writing.channel import Channel
from auv_sim.bags.writing.mcap_file import Compression, McapFile

__all__ = ["METADATA_FILE", "BagWriter", "Channel", "typestore"]

#: Name of the MCAP metadata record that holds the texts kept in a file.
TEXTS = "auv_sim.texts"
#: Larger files are no configuration, bytes.
TEXT_LIMIT = 4_000_000
#: What may wait in memory for a disk that is full, bytes; further messages are counted and given up.
PENDING_LIMIT = 16 * 1024 * 1024


def texts_below(directory: Path) -> dict[str, str]:
    """Every text file below a directory, by its path within; what is no text, or large, is left out."""
    texts = {}
    for file in sorted(directory.rglob("*")):
        if file.is_file() and file.stat().st_size < TEXT_LIMIT:
            with contextlib.suppress(UnicodeDecodeError):
                texts[file.relative_to(directory).as_posix()] = file.read_text(encoding="utf-8")
    return texts


class BagWriter:
    """One recording: `add_topic`, then `write` as often as wanted, then `close`.

    Messages gather in memory until `flush` is called. After `flush` the operating system has them, so a
    process that is killed loses only what came later.

    Args:
        directory: the rosbag2 directory to make; it must not exist.
        compression: of the chunks, "none" or "zstd".
        chunk_size: bytes of messages that make a chunk.
        max_size: bytes after which a new file is begun; 0 for never.
        max_duration_ns: recorded time after which a new file is begun; 0 for never.
        texts: kept in every file, by name (the configuration that was flown).
        name: what the storage files' names begin with; the directory's name by default.
        definitions: types that need not be looked up.
        profile: what every file says of itself.

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
        self._definitions = definitions if definitions is not None else {}
        self._channels: dict[str, Channel] = {}
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
        self._schemas: dict[tuple[str, str, bytes], int] = {}
        for channel in self._channels.values():
            channel.number = 0
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
        return {channel.name: channel.count for channel in self._channels.values()}

    @property
    def size(self) -> int:
        """Bytes handed over so far, all files."""
        return sum(file.size for file in self._files) + self._file.size

    @property
    def pending(self) -> int:
        """Bytes that the operating system has not got yet."""
        return self._file.journal.pending + self._file.filling

    @property
    def trouble(self) -> str:
        """Why nothing can be written at the moment; empty when all is well."""
        error = self._file.journal.error
        return "" if error is None else f"{self.file.name}: {error.strerror}"

    def add_topic(self, name: str, type_name: str, qos: Sequence[Qos]) -> Channel:
        """Announce a topic; topics may be added at any time.

        Args:
            name: full topic name (``/auv/odom``).
            type_name: ROS type (``nav_msgs/msg/Odometry``).
            qos: the QoS that each publisher offers.

        Raises:
            ConfigurationError: nobody knows the type, or the topic was added before.
        """
        if name in self._channels:
            raise ConfigurationError(name, "a topic that is recorded already", "a new topic")
        try:
            self._definition(type_name)
        except ConfigurationError as error:
            raise ConfigurationError(name, f"the type {type_name}", error.expected) from None
        channel = self._channels[name] = Channel(name, type_name, list(dump_qos_v9(list(qos))))
        return channel

    def copy_topic(
        self, channel: records.Channel, schema: records.Schema | None, qos: Sequence[Qos]
    ) -> Channel:
        """Announce a topic of another file, in whatever notation, with all that is said of it there."""
        type_name = schema.name if schema else ""
        made = Channel(channel.topic, type_name, list(dump_qos_v9(list(qos))), (channel, schema))
        self._channels[channel.topic] = made
        return made

    def copy(self, record: records.Metadata | records.Attachment) -> None:
        """Take over what another file has besides messages."""
        if isinstance(record, records.Metadata):
            self._file.metadata(record.name, record.metadata)
        else:
            self._file.attachment(record)

    def _definition(self, type_name: str) -> Definition:
        """What is given counts for a type that is not ROS 2 Jazzy's, or is another one there."""
        given = self._definitions.get(type_name)
        if given is None:
            return definition(type_name)
        try:
            standard = definition(type_name)
        except ConfigurationError:
            return given
        return standard if not given.text or given.text.split() == standard.text.split() else given

    def set_qos(self, channel: Channel, qos: Sequence[Qos]) -> None:
        """Say what the publishers really offer; counts until the topic's first message."""
        if not channel.count:
            channel.qos = list(dump_qos_v9(list(qos)))

    def _announce(self, channel: Channel) -> int:
        if channel.original is not None:
            known, schema = channel.original
            number = self._schema(schema.name, schema.encoding, schema.data) if schema else 0
            described, encoding = known.metadata, known.message_encoding
        else:
            text, type_hash = self._definition(channel.type)
            number = self._schema(channel.type, "ros2msg", text.encode())
            qos = metadata.dump(channel.qos).rstrip("\n")
            described, encoding = {"offered_qos_profiles": qos, "topic_type_hash": type_hash}, "cdr"
        channel.number = self._file.channel(channel.name, number, described, encoding)
        return channel.number

    def _schema(self, *described: Any) -> int:
        if described not in self._schemas:
            self._schemas[described] = self._file.schema(*described)
        return self._schemas[described]

    def _facts(self, channel: Channel) -> TopicMetadata:
        if channel.original is None:
            type_hash, encoding = self._definition(channel.type).type_hash, "cdr"
        else:
            known, _ = channel.original
            type_hash, encoding = known.metadata.get("topic_type_hash", ""), known.message_encoding
        messages = channel.count + channel.repeated
        return TopicMetadata(channel.name, channel.type, messages, channel.qos, type_hash, encoding)

    def write(
        self, channel: Channel, log_time_ns: int, publish_time_ns: int, cdr: bytes, sequence: int = 0
    ) -> None:
        """Record one message.

        Args:
            channel: what `add_topic` returned.
            log_time_ns: when it was received, ns.
            publish_time_ns: when it was sent, ns.
            cdr: the serialised message with its four bytes of CDR header; never looked into.
            sequence: the publisher's number of it.
        """
        if self._closed or self._file.journal.pending > PENDING_LIMIT:
            self.given_up += 1
            return
        if channel.latched:
            channel.keep(sequence, publish_time_ns, cdr)
        self._file.add(channel.number or self._announce(channel), sequence, log_time_ns, publish_time_ns, cdr)
        channel.count += 1

    def flush(self) -> bool:
        """Hand over everything to the operating system; False while the disk has no room (see `trouble`)."""
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
        """Begin a further file with the latched messages, so that it can be understood without the others."""
        for channel in self._channels.values():
            for sequence, publish_time_ns, cdr in channel.kept:
                number = channel.number or self._announce(channel)
                self._file.add(number, sequence, log_time_ns, publish_time_ns, cdr)
                channel.repeated += 1

    def _finish_file(self) -> bool:
        file = self._file
        for channel in self._channels.values():
            if not channel.number and not self._files:
                self._announce(channel)
        if not file.journal.commit() or not file.flush():
            file.journal.close()
            return False
        self._files.append(
            FileMetadata(file.path.name, file.first_ns, file.last_ns, file.messages, file.size)
        )
        # rosbag2 keeps a copy inside the storage file, so that the file alone tells everything.
        file.metadata("rosbag2", {"serialized_metadata": metadata.dump(self._information()).rstrip("\n")})
        return file.finish()

    def close(self) -> bool:
        """Write the index and metadata.yaml; harmless when called again.

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
        """Whether `close` was called: what is written after that is given up and counted."""
        return self._closed

    def _information(self) -> dict[str, Any]:
        return metadata.information([self._facts(c) for c in self._channels.values()], self._files)

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
