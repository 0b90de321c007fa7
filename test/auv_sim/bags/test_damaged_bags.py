"""Truncated, overwritten, emptied recordings and none at all: one clear line each, and what is readable."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from pathlib import Path

import pytest
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader

from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.cli import bag as bag_command

FLOAT, STRING = "std_msgs/msg/Float64", "std_msgs/msg/String"
TOTAL = 600


def number(value: float) -> bytes:
    return bytes(typestore().serialize_cdr(typestore().types[FLOAT](value), FLOAT))


def make(directory: Path, compression: str = "none", close: bool = True) -> Path:
    """30 s of 20 Hz in chunks of half a second; returns the storage file."""
    writer = BagWriter(directory, compression)  # type: ignore[arg-type]
    rudder = writer.add_topic("/auv/rudder_cmd", FLOAT, [])
    for k in range(TOTAL):
        writer.write(rudder, 10**9 + k * 50_000_000, 10**9 + k * 50_000_000, number(float(k)), k + 1)
        if k % 10 == 9:
            writer.flush()
    if close:
        writer.close()
    return writer.file


def overwrite(file: Path, at: float, with_bytes: bytes) -> None:
    data = bytearray(file.read_bytes())
    start = int(at * len(data)) if at < 1.0 else int(at)
    data[start : start + len(with_bytes)] = with_bytes
    file.write_bytes(data)


def chunk_starts(file: Path) -> list[int]:
    with file.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    assert summary is not None
    return [chunk.chunk_start_offset for chunk in summary.chunk_indexes]


def cut(share: float) -> Callable[[Path], None]:
    def damage(directory: Path) -> None:
        file = make(directory)
        file.write_bytes(file.read_bytes()[: int(share * file.stat().st_size)])

    return damage


def cut_packed(directory: Path) -> None:
    file = make(directory, "zstd")
    file.write_bytes(file.read_bytes()[: file.stat().st_size // 2])


def end_cut(directory: Path) -> None:
    file = make(directory)
    file.write_bytes(file.read_bytes()[:-3])


def flipped(position: int) -> Callable[[Path], None]:
    """One byte of the tenth chunk is wrong: of its type, its length, its times, its content."""

    def damage(directory: Path) -> None:
        file = make(directory)
        at = chunk_starts(file)[9] + position
        overwrite(file, at, bytes([file.read_bytes()[at] ^ 0xFF]))

    return damage


def flipped_packed(directory: Path) -> None:
    file = make(directory, "zstd")
    at = chunk_starts(file)[9] + 100
    overwrite(file, at, bytes([file.read_bytes()[at] ^ 0xFF]))


def zeroed_block(directory: Path) -> None:
    overwrite(make(directory), 0.4, bytes(4096))


def magic_gone(directory: Path) -> None:
    overwrite(make(directory), 0.0, b"XXXXXXXX")


def index_damaged(directory: Path) -> None:
    file = make(directory)
    overwrite(file, file.stat().st_size - 300, b"\xff" * 100)


def never_closed(directory: Path) -> None:
    make(directory, close=False)


def metadata_missing(directory: Path) -> None:
    make(directory)
    (directory / "metadata.yaml").unlink()


def metadata_garbage(directory: Path) -> None:
    make(directory)
    (directory / "metadata.yaml").write_text("rosbag2: [\n\x00")


def part_missing(directory: Path) -> None:
    with BagWriter(directory, max_duration_ns=10 * 10**9) as writer:
        rudder = writer.add_topic("/auv/rudder_cmd", FLOAT, [])
        for k in range(TOTAL):
            writer.write(rudder, 10**9 + k * 50_000_000, 0, number(float(k)), k + 1)
            writer.flush()
    (directory / "bag_1.mcap").unlink()


def wrong_schema(directory: Path) -> None:
    """The topic claims to be text; its bytes are numbers."""
    with BagWriter(directory) as writer:
        state = writer.add_topic("/auv/mission_state", STRING, [])
        for k in range(TOTAL):
            writer.write(state, 10**9 + k * 50_000_000, 0, number(1e300), k + 1)


def length_absurd(directory: Path) -> None:
    file = make(directory)
    overwrite(file, chunk_starts(file)[9] + 1, struct.pack("<Q", 2**62))


READABLE = {
    "cut at nine tenths": (cut(0.9), "the end is missing", 500),
    "cut in the middle": (cut(0.5), "the end is missing", 250),
    "cut at a tenth": (cut(0.1), "the end is missing", 20),
    "cut in the middle, packed": (cut_packed, "the end is missing", 200),
    "last bytes missing": (end_cut, "the end is missing", TOTAL),
    "a chunk's type flipped": (flipped(0), "damaged from byte", TOTAL - 20),
    "a chunk's length flipped": (flipped(1), "damaged from byte", TOTAL - 20),
    "a chunk's length absurd": (length_absurd, "damaged from byte", TOTAL - 20),
    "a chunk's checksum flipped": (flipped(9 + 24), "its checksum is wrong", TOTAL - 10),
    "a message flipped": (flipped(9 + 40 + 40), "its checksum is wrong", TOTAL - 10),
    "a packed chunk flipped": (flipped_packed, "left out", TOTAL - 10),
    "4 kB of zeros": (zeroed_block, "damaged from byte", TOTAL - 200),
    "first bytes gone": (magic_gone, "the first bytes are damaged", TOTAL),
    "index damaged": (index_damaged, "", TOTAL),
    "never closed": (never_closed, "the recording was not closed", TOTAL),
    "no metadata": (metadata_missing, "no metadata.yaml", TOTAL),
    "metadata garbage": (metadata_garbage, "metadata.yaml is damaged", TOTAL),
    "a file missing": (part_missing, "bag_1.mcap is missing", 300),
    "wrong schema": (wrong_schema, "", TOTAL),
}


def empty_file(directory: Path) -> None:
    directory.mkdir()
    (directory / "bag_0.mcap").touch()


def a_text(directory: Path) -> None:
    directory.mkdir()
    (directory / "bag_0.mcap").write_text("To whom it may concern\n" * 100)


def empty_directory(directory: Path) -> None:
    directory.mkdir()


def nothing(directory: Path) -> None:
    pass


def not_sqlite(directory: Path) -> None:
    directory.mkdir()
    (directory / "bag_0.db3").write_bytes(b"SQLite format 3\0" + bytes(1000))


def metadata_only(directory: Path) -> None:
    make(directory).unlink()


UNREADABLE = {
    "empty file": (empty_file, "found an empty file"),
    "a text": (a_text, "expected an MCAP file"),
    "empty directory": (empty_directory, "found no metadata.yaml"),
    "nothing": (nothing, "found nothing"),
    "not SQLite": (not_sqlite, "a recording that cannot be read"),
    "metadata only": (metadata_only, "found no storage files"),
}


@pytest.mark.parametrize("case", READABLE)
def test_what_is_readable_is_shown_and_repaired(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], case: str
) -> None:
    prepare, says, at_least = READABLE[case]
    bag = tmp_path / "bag"
    prepare(bag)
    assert bag_command.main(["inspect", str(bag), "--json"]) == 0
    shown = json.loads(capsys.readouterr().out)
    assert shown["messages"] >= at_least
    assert shown["messages"] <= TOTAL
    assert any(says in note for note in shown["notes"]), shown["notes"]
    assert all("\n" not in note for note in shown["notes"])
    assert bag_command.main(["inspect", str(bag)]) == 0
    assert "Traceback" not in capsys.readouterr().out

    before = {
        (topic.name, at): data
        for topic in read_bag(bag).topics.values()
        for at, data in zip(topic.log_ns, topic.messages, strict=True)
    }
    assert bag_command.main(["repair", str(bag)]) == 0
    with AnyReader([bag]) as reader:
        after = {(c.topic, at): bytes(data) for c, at, data in reader.messages()}
    assert after == before
    plain = [
        message.data
        for file in sorted(bag.glob("*.mcap"))
        for _, _, message in make_reader(file.open("rb"), validate_crcs=True).iter_messages()
    ]
    assert sorted(plain) == sorted(before.values())
    assert read_bag(bag).notes == []


@pytest.mark.parametrize("case", UNREADABLE)
@pytest.mark.parametrize("verb", ["inspect", "repair"])
def test_what_is_no_recording_gets_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], case: str, verb: str
) -> None:
    prepare, says = UNREADABLE[case]
    prepare(tmp_path / "bag")
    assert bag_command.main([verb, str(tmp_path / "bag")]) == 2
    told = capsys.readouterr().err
    assert says in told
    assert told.count("\n") == 1


@pytest.mark.parametrize("before", [0, 3, 8, 100])
def test_a_lost_head_takes_no_chunk_with_it(tmp_path: Path, before: int) -> None:
    """The first chunk that is whole may begin anywhere, even where the magic bytes were."""
    file = make(tmp_path / "bag")
    first = chunk_starts(file)[0]
    rest = tmp_path / "rest.mcap"
    rest.write_bytes(file.read_bytes()[first - before :])
    assert read_bag(rest).count == TOTAL
