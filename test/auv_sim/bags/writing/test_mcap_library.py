"""What the `mcap` library would lose: why files are written and damaged ones read by modules of our own."""

from __future__ import annotations

import contextlib
import io
import random
import resource
import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest
from mcap.opcode import Opcode
from mcap.reader import NonSeekingReader
from mcap.writer import Writer

from auv_sim.bags.reading.storage.mcap_scan import scan
from auv_sim.bags.writing.journal import Journal
from auv_sim.bags.writing.mcap_file import McapFile

TOPICS, CHUNKS, EACH = 17, 30, 10
#: Messages of a chunk, and of all of them.
PER_CHUNK, TOTAL = TOPICS * EACH, TOPICS * EACH * CHUNKS
#: Random, so that a compressed chunk has more bytes than a stream's buffer.
DATA = [random.Random(k).randbytes(100) for k in range(PER_CHUNK)]

#: Writes the messages of one chunk and flushes.
WriteChunk = Callable[[int], object]


class Stream:
    """A journal as the library's stream: the most that the library can be given."""

    def __init__(self, path: Path) -> None:
        self._journal = Journal(path)

    def write(self, data: bytes) -> None:
        self._journal.write(data)

    def tell(self) -> int:
        return self._journal.position

    def flush(self) -> None:
        self._journal.commit()


def own(path: Path) -> WriteChunk:
    file = McapFile(path, "zstd", 1 << 20)
    numbers = [file.channel(f"/t{k}", file.schema(f"a/msg/T{k}", "ros2msg", b""), {}) for k in range(TOPICS)]

    def chunk(begin: int) -> object:
        for k, data in enumerate(DATA):
            at = begin + k // TOPICS
            file.add(numbers[k % TOPICS], at, at, at, data)
        return file.flush()

    return chunk


def library(stream: object) -> WriteChunk:
    writer = Writer(stream)  # type: ignore[arg-type]
    writer.start("ros2", "mcap")
    schemas = [writer.register_schema(f"a/msg/T{k}", "ros2msg", b"") for k in range(TOPICS)]
    numbers = [writer.register_channel(f"/t{k}", "cdr", schema) for k, schema in enumerate(schemas)]

    def chunk(begin: int) -> object:
        for k, data in enumerate(DATA):
            at = begin + k // TOPICS
            writer.add_message(numbers[k % TOPICS], at, data, at, at)
        return writer.flush()

    return chunk


def write(chunk: WriteChunk, chunks: int = CHUNKS) -> None:
    """A recording that is killed: everything flushed, nothing finished."""
    for k in range(chunks):
        chunk(k * EACH)


def by_scan(path: Path) -> tuple[int, int]:
    """How many messages are readable, and how many of them belong to a known topic."""
    numbers: list[int] = []
    result = scan(path, lambda channel, *_: numbers.append(channel))
    return len(numbers), sum(number in result.channels for number in numbers)


def by_library(path: Path) -> int:
    """How many messages the library reads before it gives up."""
    count = 0
    with contextlib.suppress(Exception), path.open("rb") as stream:
        for _ in NonSeekingReader(stream, validate_crcs=True).iter_messages(log_time_order=False):
            count += 1
    return count


def chunk_starts(data: bytes) -> list[int]:
    starts, at = [], 8
    while at + 9 <= len(data):
        opcode, length = struct.unpack_from("<BQ", data, at)
        if opcode == Opcode.CHUNK:
            starts.append(at)
        at += 9 + length
    return starts


def test_a_kill_costs_neither_what_was_flushed(tmp_path: Path) -> None:
    """No reason for a writer of our own."""
    write(own(tmp_path / "own"))
    write(library(Stream(tmp_path / "library")))
    for path in tmp_path.iterdir():
        assert by_scan(path) == (TOTAL, TOTAL)
        assert by_library(path) == TOTAL


def test_the_first_chunk_takes_the_names_of_all_topics_with_it(tmp_path: Path) -> None:
    """The library writes schemas and channels into the chunk that is being filled and into the index."""
    write(own(tmp_path / "own"))
    write(library(Stream(tmp_path / "library")))
    for path in tmp_path.iterdir():
        data = bytearray(path.read_bytes())
        data[chunk_starts(data)[0] + 80] ^= 0xFF
        path.write_bytes(data)
    assert by_scan(tmp_path / "own") == (TOTAL - PER_CHUNK, TOTAL - PER_CHUNK)
    assert by_scan(tmp_path / "library") == (TOTAL - PER_CHUNK, 0)


def test_a_full_disk_tears_the_library_s_chunks(tmp_path: Path) -> None:
    """A journal as its stream would prevent that, as it does here."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    with (tmp_path / "library").open("wb") as stream:
        chunks = {tmp_path / "own": own(tmp_path / "own"), tmp_path / "library": library(stream)}
        for path, chunk in chunks.items():
            for k in range(CHUNKS):
                if k == CHUNKS // 3:
                    resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 300, before[1]))
                try:
                    with contextlib.suppress(OSError):
                        chunk(k * EACH)
                finally:
                    if k == CHUNKS // 2:
                        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert by_scan(tmp_path / "own") == (TOTAL, TOTAL)
    assert by_library(tmp_path / "own") == TOTAL
    assert by_scan(tmp_path / "library")[0] < TOTAL - PER_CHUNK
    assert by_library(tmp_path / "library") < TOTAL // 2


def test_the_library_s_memory_grows_with_every_chunk(tmp_path: Path) -> None:
    """A recorder makes 7,200 chunks an hour: 10 MB in the library, 0.5 MB here."""
    grown = {}
    for name, chunk in (("own", own(tmp_path / "own")), ("library", library(io.BytesIO()))):
        write(chunk, 10)
        tracemalloc.start()
        write(chunk, 60)
        grown[name] = tracemalloc.get_traced_memory()[0] / 60
        tracemalloc.stop()
    assert grown["own"] < 300 < 1000 < grown["library"]


def zeros(data: bytearray, starts: list[int]) -> None:
    data[starts[3] + 500 : starts[4] + 500] = bytes(starts[4] - starts[3])


def length(data: bytearray, starts: list[int]) -> None:
    struct.pack_into("<Q", data, starts[3] + 1, 2**62)


def checksum(data: bytearray, starts: list[int]) -> None:
    data[starts[3] + 9 + 24] ^= 0xFF


def beginning(data: bytearray, starts: list[int]) -> None:
    data[0] ^= 0xFF


@pytest.mark.parametrize("damage", [zeros, length, checksum, beginning])
def test_the_library_s_reader_ends_at_the_first_damage(
    tmp_path: Path, damage: Callable[[bytearray, list[int]], None]
) -> None:
    write(own(tmp_path / "own"))
    data = bytearray((tmp_path / "own").read_bytes())
    damage(data, chunk_starts(data))
    (tmp_path / "own").write_bytes(data)
    readable, named = by_scan(tmp_path / "own")
    assert readable == named >= TOTAL - 2 * PER_CHUNK
    assert by_library(tmp_path / "own") <= 3 * PER_CHUNK
