"""One MCAP file in which a damaged chunk costs its own messages only. Writing it takes little memory.

`mcap.Writer` writes schemas and channels into the first chunk: where that is damaged in a file without an
index, no message has a topic. It also keeps 1.4 kB for every chunk until the end, 10 MB for each hour. Here
schemas and channels stand between the chunks, and what the index needs is kept compressed. The records are
the library's. test_mcap_library.py shows both losses, and that a kill costs the library no more than this.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import Literal

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    DataEnd,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
)

from auv_sim.bags.writing.journal import Journal
from auv_sim.bags.writing.mcap_summary import ChunkIndexes, Group, summary

Compression = Literal["none", "zstd"]

MAGIC = b"\x89MCAP0\r\n"
_LIBRARY = "auv_sim"
#: opcode, length, channel, sequence, log time, publish time; the data follow.
MESSAGE_HEAD = struct.Struct("<BQHIQQ")
_MESSAGE_FIXED = MESSAGE_HEAD.size - 9
#: opcode, length, channel, bytes of the entries that follow.
_INDEX_HEAD = struct.Struct("<BQHI")


class McapFile:
    """Write one file: call `schema`, `channel`, `add` and `flush` as often as needed, then `finish`.

    Args:
        path: the file to make; it must not exist.
        compression: of the chunks.
        chunk_size: a chunk ends when its messages exceed this, bytes.
        profile: the profile in the file's header.

    Raises:
        OSError: it cannot be made.
    """

    def __init__(self, path: Path, compression: Compression, chunk_size: int, profile: str = "ros2") -> None:
        self.path = path
        self.journal = Journal(path)
        self._zstd = zstandard.ZstdCompressor(level=1) if compression == "zstd" else None
        self._chunk_size = chunk_size
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._chunks = ChunkIndexes()
        self._metadata: list[MetadataIndex] = []
        self._attachments: list[AttachmentIndex] = []
        self._counts: dict[int, int] = {}
        self.first_ns = self.last_ns = self.messages = 0
        self._new_chunk()
        self.journal.write(MAGIC)
        self._put(Header(profile=profile, library=_LIBRARY))
        self.journal.commit()

    @property
    def size(self) -> int:
        """Bytes of the file, without the chunk that is being filled."""
        return self.journal.position

    @property
    def filling(self) -> int:
        """Bytes in the chunk that is being filled."""
        return self._offset

    def schema(self, name: str, encoding: str, data: bytes) -> int:
        """Write a message definition; return its number."""
        self._schemas.append(Schema(id=len(self._schemas) + 1, data=data, encoding=encoding, name=name))
        self._put(self._schemas[-1])
        return len(self._schemas)

    def channel(self, topic: str, schema: int, metadata: dict[str, str], encoding: str = "cdr") -> int:
        """Write a topic's channel; return its number. Schema 0 stands for none."""
        number = len(self._channels) + 1
        self._channels.append(
            Channel(id=number, topic=topic, message_encoding=encoding, metadata=metadata, schema_id=schema)
        )
        self._put(self._channels[-1])
        return number

    def add(self, channel: int, sequence: int, log_ns: int, publish_ns: int, data: bytes) -> None:
        """Append one message to the chunk that is being filled."""
        size = len(data)
        self._parts += (
            MESSAGE_HEAD.pack(5, _MESSAGE_FIXED + size, channel, sequence, log_ns, publish_ns),
            data,
        )
        index = self._index.get(channel)
        if index is None:
            index = self._index[channel] = []
        index += (log_ns, self._offset)
        self._offset += MESSAGE_HEAD.size + size
        if self._offset > self._chunk_size:
            self._end_chunk()

    def flush(self) -> bool:
        """End the chunk and hand everything to the operating system; return False where it does not fit."""
        self._end_chunk()
        return self.journal.commit()

    def metadata(self, name: str, content: dict[str, str]) -> None:
        """Write texts by name into the file, outside of all topics."""
        start = self.journal.position
        self._put(Metadata(name=name, metadata=content))
        self._metadata.append(MetadataIndex(offset=start, length=self.journal.position - start, name=name))

    def attachment(self, record: Attachment) -> None:
        """Copy an attachment."""
        start = self.journal.position
        self._put(record)
        length = self.journal.position - start
        facts = {name: getattr(record, name) for name in ("log_time", "create_time", "name", "media_type")}
        self._attachments.append(
            AttachmentIndex(offset=start, length=length, data_size=len(record.data), **facts)
        )

    def finish(self) -> bool:
        """Write the index and close; return False where the file had to be left without its index."""
        self._end_chunk()
        self._put(DataEnd(data_section_crc=0))
        self._summary()
        whole = self.journal.commit()
        self.journal.close()
        return whole

    def _summary(self) -> None:
        statistics = Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self._channels),
            channel_message_counts=self._counts,
            chunk_count=self._chunks.count,
            message_count=self.messages,
            message_end_time=self.last_ns,
            message_start_time=self.first_ns,
            metadata_count=len(self._metadata),
            schema_count=len(self._schemas),
        )
        groups: list[Group] = [
            (Opcode.SCHEMA, self._schemas),
            (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [statistics]),
            (Opcode.CHUNK_INDEX, [self._chunks] if self._chunks.count else []),
            (Opcode.ATTACHMENT_INDEX, self._attachments),
            (Opcode.METADATA_INDEX, self._metadata),
        ]
        self.journal.write(summary(self.journal.position, groups))
        self.journal.write(MAGIC)

    def _put(self, record: McapRecord) -> None:
        builder = RecordBuilder()
        record.write(builder)
        self.journal.write(builder.end())  # type: ignore[no-untyped-call]

    def _new_chunk(self) -> None:
        self._parts: list[bytes] = []
        self._index: dict[int, list[int]] = {}  # channel -> log time, offset, log time, offset ...
        self._offset = 0

    def _end_chunk(self) -> None:
        if not self._parts:
            return
        raw = b"".join(self._parts)
        first = min(min(entries[::2]) for entries in self._index.values())
        last = max(max(entries[::2]) for entries in self._index.values())
        self.first_ns = min(self.first_ns, first) if self.messages else first
        self.last_ns = max(self.last_ns, last)
        self.messages += len(self._parts) // 2
        chunk = Chunk(
            compression="zstd" if self._zstd else "",
            data=self._zstd.compress(raw) if self._zstd else raw,
            message_start_time=first,
            message_end_time=last,
            uncompressed_crc=zlib.crc32(raw),
            uncompressed_size=len(raw),
        )
        start = self.journal.position
        self._put(chunk)
        index_start = self.journal.position
        offsets = {}
        for channel, entries in self._index.items():
            offsets[channel] = self.journal.position
            size = 8 * len(entries)
            self.journal.write(_INDEX_HEAD.pack(Opcode.MESSAGE_INDEX, 6 + size, channel, size))
            self.journal.write(struct.pack(f"<{len(entries)}Q", *entries))
            self._counts[channel] = self._counts.get(channel, 0) + len(entries) // 2
        self._chunks.append(
            ChunkIndex(
                chunk_length=index_start - start,
                chunk_start_offset=start,
                compression=chunk.compression,
                compressed_size=len(chunk.data),
                message_end_time=last,
                message_index_length=self.journal.position - index_start,
                message_index_offsets=offsets,
                message_start_time=first,
                uncompressed_size=len(raw),
            )
        )
        self._new_chunk()
