"""The chunks of an MCAP file, found without its index and unpacked with no trust in what they declare."""

from __future__ import annotations

import mmap
import struct
from io import BytesIO
from typing import Any

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.opcode import Opcode
from mcap.records import Chunk
from mcap.stream_reader import CRCValidationError, get_chunk_data_stream

#: Of every record: its kind, and the length of what follows.
RECORD = struct.Struct("<BQ")
_PROLOGUE = struct.Struct("<QQQII")  # of a chunk: first, last, uncompressed size, its CRC, length of "zstd"
_COMPRESSIONS = (b"", b"lz4", b"zstd")


def is_chunk(data: mmap.mmap, start: int) -> bool:
    """Return whether the bytes from `start` on can begin a chunk."""
    at = start + RECORD.size
    if at + _PROLOGUE.size > len(data) or data[start] != Opcode.CHUNK:
        return False
    first, last, _, _, name_length = _PROLOGUE.unpack_from(data, at)
    at += _PROLOGUE.size
    return first <= last and name_length <= 4 and data[at : at + name_length] in _COMPRESSIONS


def next_chunk(data: mmap.mmap, position: int) -> int | None:
    """Return where the next bytes begin that can be a whole chunk; None where none do."""
    size = len(data)
    while (position := data.find(b"\x06", position)) != -1:
        if is_chunk(data, position):
            (length,) = struct.unpack_from("<Q", data, position + 1)
            if position + RECORD.size + length <= size:
                return position
        position += 1
    return None


def size_of(chunk: Chunk) -> int:
    """Return the most bytes that unpacking a chunk may take."""
    return max(chunk.uncompressed_size, len(chunk.data), _frame_size(chunk))


def unpack(chunk: Chunk) -> tuple[bytes, str]:
    """Return the records of a chunk, and what is wrong with it; empty: nothing."""
    try:
        stream, size = get_chunk_data_stream(chunk, validate_crc=True)
        return stream.read(size), ""
    except CRCValidationError:
        return b"", "its checksum is wrong"
    except Exception as error:
        # On damaged data a decompressor raises errors of several types.
        return b"", " ".join(str(error).split()) or type(error).__name__


def beginning_of(data: mmap.mmap, start: int, most: int) -> bytes:
    """Return what a chunk that was cut off still has, at most `most` bytes unpacked; of lz4 nothing."""
    *_, name_length = _PROLOGUE.unpack_from(data, start + RECORD.size)
    at = start + RECORD.size + _PROLOGUE.size
    name, rest = data[at : at + name_length], data[at + name_length + 8 :]
    if name == b"zstd":
        with zstandard.ZstdDecompressor().stream_reader(rest) as packed:
            return packed.read(most)
    return b"" if name == b"lz4" else rest


def read_record(kind: Any, body: bytes) -> Any:
    """Return a record, or None where the bytes are not one of this kind."""
    try:
        stream = ReadDataStream(BytesIO(body))
        return kind.read(stream)
    except Exception:
        return None


def span_of(chunk: Chunk) -> str:
    """Return the time that the messages of a chunk span, as text."""
    length = (chunk.message_end_time - chunk.message_start_time) * 1e-9
    return f"{length:.2f} s of messages"


def _frame_size(chunk: Chunk) -> int:
    """Return the size that compressed data declare, bytes: the decompressor allocates it at once."""
    try:
        return zstandard.frame_content_size(chunk.data) if chunk.compression == "zstd" else 0
    except zstandard.ZstdError:
        return 0  # unpacking will report what is wrong
