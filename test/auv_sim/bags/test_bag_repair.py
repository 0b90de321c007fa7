"""Repair loses nothing: channels of every kind, metadata and attachments come over, or the old file stays."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap.records import Schema
from mcap.stream_reader import StreamReader
from mcap.writer import IndexType, Writer

from auv_sim.bags import bag_repair as module
from auv_sim.bags.definitions import definition, typestore
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.bags.writing.journal import Journal
from auv_sim.cli import bag as bag_command

FLOAT = "std_msgs/msg/Float64"
#: Topic: the schema's name, its encoding and its data, the messages' encoding. The bytes are no text.
CHANNELS = {
    "/msg": (FLOAT, "ros2msg", definition(FLOAT).text.encode(), "cdr"),
    "/idl": ("a_msgs/msg/Level", "ros2idl", b"module a_msgs { struct Level { double data; }; };", "cdr"),
    "/proto": ("a.Level", "protobuf", b"\x0a\x07\xff\xfe\x80", "protobuf"),
    "/json": ("Level", "jsonschema", b'{"type": "object"}', "json"),
}
NOTES = {"who": "a diver", "where": "dive 7"}


def foreign(file: Path) -> int:
    """A recording of somebody else's, with everything that MCAP has; returns its number of messages."""
    with file.open("wb") as stream:
        writer = Writer(stream, chunk_size=200)
        writer.start(profile="theirs", library="theirs")
        writer.add_metadata("notes", NOTES)
        writer.add_metadata("notes", {"the": "second"})
        writer.add_attachment(5, 6, "chart.bin", "application/octet-stream", b"\x00\xff" * 50)
        numbers = {}
        for topic, (name, encoding, data, messages) in CHANNELS.items():
            schema = writer.register_schema(name, encoding, data)
            numbers[topic] = writer.register_channel(topic, messages, schema, {"from": topic})
        numbers["/bare"] = writer.register_channel("/bare", "json", 0)
        for k in range(20):
            for topic, number in numbers.items():
                writer.add_message(number, 10**9 + k, f"{topic} {k}".encode(), 10**9 + k, k)
        writer.finish()
    return 20 * len(numbers)


def never_closed(file: Path) -> None:
    """As a kill leaves it: all records up to the end of the data, no index."""
    data = file.read_bytes()
    with file.open("rb") as stream:
        reader = StreamReader(stream, emit_chunks=True)
        next(record for record in reader.records if type(record).__name__ == "DataEnd")
        end = stream.tell() - 13  # the record that ends the data itself
    file.write_bytes(data[:end])


def content(file: Path) -> tuple[object, ...]:
    """Everything in a file, read by the `mcap` library."""
    with file.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        messages = sorted(
            (c.topic, m.log_time, m.publish_time, m.sequence, m.data, c.message_encoding, _plain(s))
            for s, c, m in reader.iter_messages()
        )
        summary = reader.get_summary()
        assert summary is not None
        described = {channel.topic: dict(channel.metadata) for channel in summary.channels.values()}
        texts = [(r.name, dict(r.metadata)) for r in reader.iter_metadata() if r.name != "rosbag2"]
        attached = [
            (a.name, a.media_type, a.log_time, a.create_time, a.data) for a in reader.iter_attachments()
        ]
        return reader.get_header().profile, messages, described, texts, attached


def _plain(schema: Schema | None) -> tuple[str, str, bytes]:
    return (schema.name, schema.encoding, schema.data) if schema else ("", "", b"")


@pytest.mark.parametrize("place", ["in its place", "a bare file", "--out"])
def test_what_is_not_ours_comes_over_as_it_was(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], place: str
) -> None:
    bag = tmp_path / "bag"
    bag.mkdir()
    file = bag / "bag_0.mcap"
    total = foreign(file)
    before = content(file)
    never_closed(file)
    damaged = file.read_bytes()
    asked = {"in its place": [bag], "a bare file": [file], "--out": [bag, "--out", tmp_path / "new"]}[place]
    assert bag_command.main(["repair", *map(str, asked)]) == 0
    assert f"whole, {total} messages" in capsys.readouterr().out
    made = {"in its place": bag, "a bare file": bag / "bag_0", "--out": tmp_path / "new"}[place]
    (whole,) = made.glob("*.mcap")
    assert content(whole) == before
    assert read_bag(made).notes == []
    if place == "in its place":
        assert [
            path.name for path in bag.glob("*.damaged*")
        ] == []  # nothing in it that is not in the new one
    else:
        assert file.read_bytes() == damaged


def test_a_tail_that_belongs_to_nothing_stays_beside(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A wrong length in a file without chunks: what comes behind it was not read by us, but is there."""
    bag = tmp_path / "bag"
    bag.mkdir()
    file = bag / "bag_0.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream, use_chunking=False, index_types=IndexType.NONE)
        writer.start()
        schema = writer.register_schema(FLOAT, "ros2msg", definition(FLOAT).text.encode())
        number = writer.register_channel("/a", "cdr", schema)
        for k in range(20):
            writer.add_message(number, k, f"number {k:02d}".encode(), k)
        writer.finish()
    data = bytearray(file.read_bytes())
    at = data.index(b"number 09") - 22 - 9
    data[at + 1 : at + 9] = b"\xff" * 8
    file.write_bytes(data)
    assert bag_command.main(["repair", str(bag)]) == 0
    out = capsys.readouterr().out
    assert "whole, 9 messages" in out
    assert "bag_0.mcap.damaged: kept" in out
    assert (bag / "bag_0.mcap.damaged").read_bytes() == bytes(data)


def test_two_types_on_one_topic_are_not_mixed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    bag = tmp_path / "bag"
    bag.mkdir()
    file = bag / "bag_0.mcap"
    with file.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        for encoding in ("json", "cdr"):
            schema = writer.register_schema(f"of {encoding}", "", b"")
            number = writer.register_channel("/a", encoding, schema)
            for k in range(3):
                writer.add_message(number, k, encoding.encode(), k)
        writer.finish()
    assert bag_command.main(["repair", str(bag)]) == 0
    out = capsys.readouterr().out
    assert "3 messages of a second type 'of cdr' on /a left out" in out
    assert "whole, 3 messages" in out
    assert {m for topic in read_bag(bag).topics.values() for m in topic.messages} == {b"json"}
    assert (bag / "bag_0.mcap.damaged").exists()


def unfinished(directory: Path) -> Path:
    writer = BagWriter(directory)
    topic = writer.add_topic("/a", FLOAT, [])
    data = typestore().serialize_cdr(typestore().types[FLOAT](1.0), FLOAT)
    for k in range(100):
        writer.write(topic, k, k, bytes(data), k)
    writer.flush()
    return writer.file


def test_a_disk_without_room_leaves_the_old_one_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Full for one write only: what was given up meanwhile must not be taken for written."""
    file = unfinished(tmp_path / "bag")
    before = file.read_bytes()
    whole, failures = Journal.commit, iter([False, False, True])

    def commit(journal: Journal) -> bool:
        if next(failures, False):
            journal.error = OSError(28, os.strerror(28))
            return False
        return whole(journal)

    monkeypatch.setattr(Journal, "commit", commit)
    monkeypatch.setattr(module, "HELD", 1)
    assert bag_command.main(["repair", str(tmp_path / "bag")]) == 2
    err = capsys.readouterr().err
    assert "No space left on device" in err and err.count("\n") == 1
    assert {path.name: path.read_bytes() for path in (tmp_path / "bag").iterdir()} == {file.name: before}
    assert [path.name for path in tmp_path.iterdir()] == ["bag"]


def test_what_did_not_come_over_is_told_and_nothing_is_deleted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = unfinished(tmp_path / "bag")
    before = file.read_bytes()
    write = BagWriter.write

    def forgetful(writer: BagWriter, *arguments: object) -> None:
        if arguments[1] != 7:
            write(writer, *arguments)  # type: ignore[arg-type]

    monkeypatch.setattr(BagWriter, "write", forgetful)
    assert bag_command.main(["repair", str(tmp_path / "bag")]) == 0
    out = capsys.readouterr().out
    assert "was damaged: 1 of 100 messages on /a could not be kept" in out
    assert "whole, 99 messages" in out
    assert file.with_name("bag_0.mcap.damaged").read_bytes() == before


def test_an_older_damaged_file_is_not_written_over(tmp_path: Path) -> None:
    file = unfinished(tmp_path / "bag")
    file.write_bytes(file.read_bytes() + b"\x05junk")
    older = file.with_name("bag_0.mcap.damaged")
    older.write_text("of an earlier repair")
    assert bag_command.main(["repair", str(tmp_path / "bag")]) == 0
    assert older.read_text() == "of an earlier repair"
    assert file.with_name("bag_0.mcap.damaged-2").read_bytes().endswith(b"\x05junk")
