"""Read everything that is readable in an MCAP file, from front to back, however damaged it is.

The readers of `mcap` end at the first damage (test_mcap_library.py), those of `rosbags` want the index. This
one needs neither the index nor the end, checks every chunk, skips what is damaged and reports it.
"""

from __future__ import annotations

import contextlib
import mmap
import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Footer, Header, Metadata, Schema, Statistics

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.storage.mcap_chunks import (
    RECORD,
    beginning_of,
    is_chunk,
    next_chunk,
    read_record,
    size_of,
    span_of,
    unpack,
)
from auv_sim.bags.writing.mcap_file import MAGIC, MESSAGE_HEAD

_FOOTER_SIZE = RECORD.size + 20 + len(MAGIC)
_MCAP = "an MCAP file"
#: Chunks are unpacked up to this many times the size of their file, and to that many bytes for a small file.
#: A file that holds more was made to fill the memory.
_MOST_PACKED, _LEAST_ROOM = 50, 32_000_000
#: A recording of vehicles has fewer topics.
_MOST_CHANNELS = 10_000
#: The note of a file that lacks its index and nothing else.
NOT_CLOSED = "the end is missing (not closed)"
_READERS: dict[int, Any] = {
    Opcode.HEADER: Header,
    Opcode.SCHEMA: Schema,
    Opcode.CHANNEL: Channel,
    Opcode.STATISTICS: Statistics,
    Opcode.FOOTER: Footer,
    Opcode.METADATA: Metadata,
    Opcode.ATTACHMENT: Attachment,
}

#: Called for each message: channel number, sequence, log time, publish time (ns), the serialised message.
Sink = Callable[[int, int, int, int, bytes], None]


class ScanResult(NamedTuple):
    """What a file holds besides its messages.

    Attributes:
        channels, schemas: by number.
        metadata, attachments: in the order of the file.
        profile: the profile in the file's header (``ros2``).
        notes: one line for each damage; empty for a whole file.
        closed: whether the file has its index and its end.
    """

    channels: dict[int, Channel]
    schemas: dict[int, Schema]
    metadata: list[Metadata]
    attachments: list[Attachment]
    profile: str
    notes: list[str]
    closed: bool


def scan(path: Path, sink: Sink) -> ScanResult:
    """Read a file.

    Args:
        path: the file.
        sink: called with every message that is whole, in the order of the file.

    Raises:
        ConfigurationError: it cannot be opened, is empty, has too many topics, or is no MCAP file at all.
    """
    try:
        with path.open("rb") as stream:
            if path.stat().st_size == 0:
                raise ConfigurationError(str(path), "an empty file", _MCAP)
            with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
                return _Scanner(path, data, sink).run()
    except OSError as error:
        raise ConfigurationError(str(path), f"{error.strerror}", _MCAP) from None


class _Scanner:
    def __init__(self, path: Path, data: mmap.mmap, sink: Sink) -> None:
        self._path = path
        self._data = data
        self._sink = sink
        self._channels: dict[int, Channel] = {}
        self._schemas: dict[int, Schema] = {}
        self._metadata: list[Metadata] = []
        self._attachments: list[Attachment] = []
        self._profile = "ros2"
        self._notes: list[str] = []
        self._statistics: Statistics | None = None
        self._messages = 0
        self._room = _LEAST_ROOM + _MOST_PACKED * len(data)

    def run(self) -> ScanResult:
        data, size = self._data, len(self._data)
        closed, position = False, len(MAGIC)
        if data[: len(MAGIC)] != MAGIC:
            chunk = next_chunk(data, 0)
            if chunk is None:
                raise ConfigurationError(str(self._path), "neither its beginning nor any part of it", _MCAP)
            self._notes.append("the first bytes are damaged")
            # Records before the chunk name the topics; where the head is lost there may be none.
            position = min(chunk, position)
        reached = position
        while position + RECORD.size <= size:
            opcode, length = RECORD.unpack_from(data, position)
            end = position + RECORD.size + length
            if not 1 <= opcode <= 15 or end > size or not self._take(opcode, position, end):
                following = next_chunk(data, position + 1)
                if following is None:
                    break
                self._notes.append(f"damaged from byte {position} to {following}: left out")
                position = following
                continue
            position = reached = end
            if opcode == Opcode.FOOTER:
                closed = data[end : end + len(MAGIC)] == MAGIC
                break
        if not closed:
            lost = size - reached
            left = f", and its last {lost} bytes belong to nothing whole" if lost else ""
            self._notes.append(NOT_CLOSED + left)
            if lost:
                self._salvage(reached)
        elif self._statistics is not None and self._statistics.message_count != self._messages:
            there = self._statistics.message_count
            self._notes.append(f"{self._messages} of {there} messages are readable")
        return ScanResult(
            self._channels, self._schemas, self._metadata, self._attachments, self._profile,
            self._notes, closed,
        )  # fmt: skip

    def _take(self, opcode: int, start: int, end: int) -> bool:
        """Take in one record; return False where it cannot be one, so that its length is wrong too."""
        body = start + RECORD.size
        if opcode == Opcode.CHUNK:
            return self._chunk(start, body, end)
        if opcode == Opcode.MESSAGE:
            return self._batch(self._data[start:end], start)
        if opcode in _READERS:
            record = read_record(_READERS[opcode], self._data[body:end])
            if record is None:
                return False
            if opcode == Opcode.ATTACHMENT and not self._intact(body, end):
                self._notes.append(f"attachment {record.name!r}: its checksum is wrong; left out")
            else:
                self._keep(record)
        return True

    def _intact(self, body: int, end: int) -> bool:
        """Return whether an attachment's checksum is right; 0 stands for none."""
        (expected,) = struct.unpack_from("<I", self._data, end - 4)
        return expected in (0, zlib.crc32(self._data[body : end - 4]))

    def _keep(self, record: Any) -> None:
        # The index repeats them at the end of the file; the later one is the one under a checksum.
        if isinstance(record, Schema):
            self._schemas[record.id] = record
        elif isinstance(record, Channel):
            self._channels[record.id] = record
            if len(self._channels) > _MOST_CHANNELS:
                raise ConfigurationError(
                    str(self._path), f"more than {_MOST_CHANNELS} topics", "a recording of vehicles"
                )
        elif isinstance(record, Statistics):
            self._statistics = record
        elif isinstance(record, Metadata):
            self._metadata.append(record)
        elif isinstance(record, Attachment):
            self._attachments.append(record)
        elif isinstance(record, Header):
            self._profile = record.profile

    def _chunk(self, start: int, body: int, end: int) -> bool:
        if not is_chunk(self._data, start):
            return False
        chunk = read_record(Chunk, self._data[body:end])
        if chunk is None:
            return False
        unpacked = size_of(chunk)
        self._room -= unpacked
        if self._room < 0:
            said = f"{unpacked} bytes unpacked are too many for a file of {len(self._data)}"
            self._notes.append(f"chunk at byte {start}: {said}; {span_of(chunk)} left out")
            return True
        raw, reason = unpack(chunk)
        if reason:
            self._notes.append(f"chunk at byte {start}: {reason}; {span_of(chunk)} left out")
        elif not self._batch(raw, start):
            self._notes.append(f"chunk at byte {start}: ends in the middle of a record")
        return True

    def _batch(self, raw: bytes, start: int) -> bool:
        """Take in the records of a chunk, or a single one; return False where they do not fill `raw`."""
        position, size, sink, head = 0, len(raw), self._sink, MESSAGE_HEAD
        while position + RECORD.size <= size:
            opcode, length = RECORD.unpack_from(raw, position)
            end = position + RECORD.size + length
            if end > size or not opcode:
                return False
            if opcode == Opcode.MESSAGE and length >= head.size - RECORD.size:
                _, _, channel, sequence, log_ns, publish_ns = head.unpack_from(raw, position)
                sink(channel, sequence, log_ns, publish_ns, raw[position + head.size : end])
                self._messages += 1
            elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
                kind = Schema if opcode == Opcode.SCHEMA else Channel
                self._keep(read_record(kind, raw[position + RECORD.size : end]))
            position = end
        return position == size

    def _salvage(self, position: int) -> None:
        """Take in the messages at the beginning of a chunk that was cut off."""
        if not is_chunk(self._data, position):
            return
        before = self._messages
        with contextlib.suppress(Exception):
            self._batch(beginning_of(self._data, position, max(self._room, 0)), position)
        if self._messages > before:
            self._notes.append(f"{self._messages - before} messages of the cut-off chunk are readable")
