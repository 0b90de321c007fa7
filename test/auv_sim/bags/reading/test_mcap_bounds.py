"""MCAP files that were made to fill the memory: what is too much is left out, or the file is refused."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
import zstandard

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing.mcap_file import MAGIC


def text(value: str) -> bytes:
    return struct.pack("<I", len(value)) + value.encode()


def record(opcode: int, body: bytes) -> bytes:
    return struct.pack("<BQ", opcode, len(body)) + body


def channel(number: int) -> bytes:
    body = struct.pack("<HH", number, 1) + text(f"/t{number}") + text("cdr") + struct.pack("<I", 0)
    return record(4, body)


def chunk(raw: bytes, claimed: int) -> bytes:
    packed = zstandard.ZstdCompressor().compress(raw)
    head = struct.pack("<QQQI", 1, 2, claimed, 0) + text("zstd")
    return record(6, head + struct.pack("<Q", len(packed)) + packed)


HEAD = MAGIC + record(1, text("ros2") + text(""))
SCHEMA = record(3, struct.pack("<H", 1) + text("std_msgs/msg/Empty") + text("ros2msg") + text("x"))
END = record(15, bytes(4)) + record(2, bytes(20)) + MAGIC
MESSAGE = record(5, struct.pack("<HIQQ", 1, 0, 1, 1))
LARGE = bytes(100_000_000)


@pytest.mark.parametrize("claimed", [len(LARGE), 100], ids=["honest", "liar"])
def test_a_chunk_that_unpacks_to_far_too_much_is_left_out(tmp_path: Path, claimed: int) -> None:
    small = chunk(MESSAGE * 3, len(MESSAGE) * 3)
    file = tmp_path / "bomb.mcap"
    file.write_bytes(HEAD + SCHEMA + channel(1) + chunk(LARGE, claimed) + END)
    (note,) = read_bag(file).notes
    assert f"100000000 bytes unpacked are too many for a file of {file.stat().st_size}" in note
    file.write_bytes(HEAD + SCHEMA + channel(1) + small + chunk(LARGE, claimed) + END)
    assert read_bag(file).count == 3


def test_many_chunks_share_one_bound(tmp_path: Path) -> None:
    file = tmp_path / "bomb.mcap"
    part = chunk(LARGE[:10_000_000], 10_000_000)
    file.write_bytes(HEAD + SCHEMA + channel(1) + part * 20 + END)
    assert 10 < sum("too many for a file" in note for note in read_bag(file).notes) < 20


def test_a_cut_off_chunk_is_unpacked_within_the_bound_as_well(tmp_path: Path) -> None:
    file = tmp_path / "bomb.mcap"
    file.write_bytes((HEAD + SCHEMA + channel(1) + chunk(LARGE, len(LARGE)))[:-3])
    assert "not closed" in read_bag(file).notes[0]


def test_more_topics_than_any_vehicle_has(tmp_path: Path) -> None:
    file = tmp_path / "many.mcap"
    file.write_bytes(HEAD + SCHEMA + b"".join(map(channel, range(1, 10_002))) + END)
    with pytest.raises(ConfigurationError, match="found more than 10000 topics"):
        read_bag(file)
