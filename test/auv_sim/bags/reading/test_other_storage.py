"""SQLite and packed recordings, whole and damaged: every message that is there, a line for what is not."""

from __future__ import annotations

import shutil
import sqlite3
from pathlib import Path
from typing import Any

import pytest
import zstandard
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.bags.definitions import typestore
from auv_sim.bags.reading.bag_files import NO_METADATA
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.reading.storage import packed
from auv_sim.bags.reading.storage.sqlite_pages import rows_of
from auv_sim.cli import bag as bag_command

FLOAT, STRING = "std_msgs/msg/Float64", "std_msgs/msg/String"
NUMBERS = 2000


def message(type_name: str, value: Any) -> bytes:
    return bytes(typestore().serialize_cdr(typestore().types[type_name](value), type_name))


def record(directory: Path, mode: CompressionMode | None = None) -> Path:
    """Numbers, and a text longer than a page beside each fiftieth; returns the storage file."""
    writer = Writer(directory, version=9, storage_plugin=StoragePlugin.SQLITE3)
    if mode is not None:
        writer.set_compression(mode, CompressionFormat.ZSTD)
    with writer:
        numbers = writer.add_connection("/a", FLOAT, typestore=typestore())
        texts = writer.add_connection("/b", STRING, typestore=typestore())
        for k in range(NUMBERS):
            writer.write(numbers, 10**9 + k, message(FLOAT, float(k)))
            if k % 50 == 0:
                writer.write(texts, 10**9 + k, message(STRING, f"{k:05d}" * 2000))
    return next(directory.glob("*.db3*"))


TOTAL = NUMBERS + NUMBERS // 50


def contents(bag: Bag) -> set[tuple[str, int, bytes | None]]:
    return {
        (topic.name, at, data)
        for topic in bag.topics.values()
        for at, data in zip(topic.log_ns, topic.messages, strict=True)
    }


def everything() -> set[tuple[str, int, bytes | None]]:
    texts = {("/b", 10**9 + k, message(STRING, f"{k:05d}" * 2000)) for k in range(0, NUMBERS, 50)}
    return texts | {("/a", 10**9 + k, message(FLOAT, float(k))) for k in range(NUMBERS)}


@pytest.mark.parametrize("mode", [None, CompressionMode.FILE, CompressionMode.MESSAGE])
def test_a_whole_recording_is_read_whole(tmp_path: Path, mode: CompressionMode | None) -> None:
    record(tmp_path / "bag", mode)
    bag = read_bag(tmp_path / "bag")
    assert bag.notes == []
    assert contents(bag) == everything()
    assert [(topic.name, topic.type) for topic in bag.topics.values()] == [("/a", FLOAT), ("/b", STRING)]


def test_the_database_counts_where_metadata_offers_another_qos(tmp_path: Path) -> None:
    """A reader that looks for topics by name and QoS finds no message here and reports a whole recording."""
    record(tmp_path / "bag")
    file = tmp_path / "bag" / "metadata.yaml"
    text = file.read_text()
    changed = text.replace("offered_qos_profiles: []", "offered_qos_profiles:\n      - depth: 7")
    assert changed != text
    file.write_text(changed)
    bag = read_bag(tmp_path / "bag")
    assert bag.count == TOTAL
    assert bag.notes == []


def test_a_directory_without_metadata_is_read_and_completed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = record(tmp_path / "bag")
    (tmp_path / "bag" / "metadata.yaml").unlink()
    before = file.read_bytes()
    bag = read_bag(tmp_path / "bag")
    assert bag.notes == [NO_METADATA]
    assert bag.count == TOTAL
    assert bag_command.main(["repair", str(tmp_path / "bag")]) == 0
    assert f"whole, {TOTAL} messages" in capsys.readouterr().out
    assert file.read_bytes() == before
    assert read_bag(tmp_path / "bag").notes == []
    with AnyReader([tmp_path / "bag"]) as reader:
        assert sum(1 for _ in reader.messages()) == TOTAL


def killed(directory: Path) -> Path:
    """A recording whose last hundred messages stand in the -wal only, as a kill leaves it."""
    file = record(directory / "whole")
    connection = sqlite3.connect(file)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA wal_autocheckpoint = 0")
    insert = "INSERT INTO messages (topic_id, timestamp, data) VALUES (1, ?, ?)"
    connection.executemany(insert, [(2 * 10**9 + k, message(FLOAT, -float(k))) for k in range(100)])
    connection.commit()
    shutil.copytree(directory / "whole", directory / "bag")
    connection.close()
    (directory / "bag" / "whole.db3-shm").unlink()
    return directory / "bag" / "whole.db3"


def test_what_is_in_the_wal_is_read_and_the_files_stay(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = killed(tmp_path)
    before = {path.name: path.read_bytes() for path in file.parent.iterdir()}
    assert set(before) == {"whole.db3", "whole.db3-wal", "metadata.yaml"}
    bag = read_bag(file.parent)
    assert bag.count == TOTAL + 100
    assert bag.notes == ["whole.db3: whole.db3-wal lies beside it (the recording was not closed): read too"]
    assert {path.name: path.read_bytes() for path in file.parent.iterdir()} == before
    assert bag_command.main(["repair", str(file.parent)]) == 0
    out = capsys.readouterr().out
    assert "whole already" not in out
    assert f"whole, {TOTAL + 100} messages" in out
    kept = file.with_name("whole.db3.damaged")
    assert kept.read_bytes() == before["whole.db3"]
    assert kept.with_name("whole.db3.damaged-wal").read_bytes() == before["whole.db3-wal"]
    assert read_bag(file.parent).count == TOTAL + 100
    assert read_bag(file.parent).notes == []


@pytest.mark.parametrize("share", [0.99, 0.5, 0.1])
def test_of_a_file_cut_off_every_whole_row_is_read(tmp_path: Path, share: float) -> None:
    """Rows lie in the file in their order: that share of them is there, save the last page's."""
    file = record(tmp_path / "bag")
    data = file.read_bytes()
    file.write_bytes(data[: int(share * len(data))])
    bag = read_bag(tmp_path / "bag")
    assert share * TOTAL - 120 < bag.count < share * TOTAL + 10
    assert contents(bag) <= everything()
    assert any("malformed" in note for note in bag.notes)


def test_one_page_of_zeros_takes_its_own_rows_only(tmp_path: Path) -> None:
    file = record(tmp_path / "bag")
    data = bytearray(file.read_bytes())
    middle = len(data) // 2 // 4096 * 4096
    data[middle : middle + 4096] = bytes(4096)
    file.write_bytes(data)
    bag = read_bag(tmp_path / "bag")
    assert TOTAL - 200 < bag.count < TOTAL
    assert contents(bag) <= everything()


def test_an_inner_page_of_zeros_takes_no_rows(tmp_path: Path) -> None:
    """The page that leads to all others is gone; the rows lie in theirs."""
    file = record(tmp_path / "bag")
    with sqlite3.connect(file) as connection:
        (root,) = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = 'messages'").fetchone()
    connection.close()
    data = bytearray(file.read_bytes())
    data[(root - 1) * 4096 : root * 4096] = bytes(4096)
    file.write_bytes(data)
    bag = read_bag(tmp_path / "bag")
    assert contents(bag) == everything()
    assert bag.notes == [
        f"bag.db3: database disk image is malformed; 0 messages are readable, {TOTAL} more page by page"
    ]


@pytest.mark.parametrize("page_size", [512, 4096, 65536])
def test_pages_of_every_size_are_understood(tmp_path: Path, page_size: int) -> None:
    file = tmp_path / "a.db3"
    connection = sqlite3.connect(file)
    connection.execute(f"PRAGMA page_size = {page_size}")
    connection.execute(
        "CREATE TABLE messages (id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
    )
    rows = [(k, k % 300, 2**k % 2**61, bytes(k * 37)) for k in range(1, 400)]
    connection.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)", rows)
    connection.commit()
    connection.close()
    assert sorted(rows_of(file)) == rows


HOSTILE = {
    "a view that never ends": (
        "DROP TABLE messages; CREATE VIEW messages AS "
        "WITH RECURSIVE a(id) AS (SELECT 1 UNION ALL SELECT id FROM a) "
        "SELECT id, 1 AS topic_id, 1 AS timestamp, x'00' AS data FROM a",
        "no table messages",
    ),
    "no topics": ("DROP TABLE topics", "no table topics"),
}


def test_a_column_whose_name_is_no_text_gets_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = record(tmp_path / "bag")
    data = file.read_bytes()
    assert data.count(b"serialization_format TEXT") == 1
    file.write_bytes(data.replace(b"serialization_format TEXT", b"serializ\xff\xfeion_format TEXT"))
    assert bag_command.main(["inspect", str(file.parent)]) == 2
    err = capsys.readouterr().err
    assert "a recording that cannot be read" in err and err.count("\n") == 1


@pytest.mark.parametrize("case", HOSTILE)
def test_a_database_of_another_kind_gets_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], case: str
) -> None:
    script, says = HOSTILE[case]
    file = record(tmp_path / "bag")
    connection = sqlite3.connect(file)
    connection.executescript(script)
    connection.close()
    assert bag_command.main(["inspect", str(file.parent)]) == 2
    err = capsys.readouterr().err
    assert says in err and err.count("\n") == 1


def test_rows_of_other_values_are_counted(tmp_path: Path) -> None:
    file = record(tmp_path / "bag")
    with sqlite3.connect(file) as connection:
        connection.execute("UPDATE messages SET timestamp = 'noon' WHERE id = 5")
        connection.execute("UPDATE messages SET timestamp = -1 WHERE id = 6")
        connection.execute("UPDATE messages SET data = 7 WHERE id = 7")
        connection.execute("UPDATE messages SET topic_id = 99 WHERE id = 8")
    connection.close()
    bag = read_bag(tmp_path / "bag")
    assert bag.count == TOTAL - 4
    assert "bag.db3: 4 rows are no messages: left out" in bag.notes


def test_a_packed_file_that_grows_without_measure_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(packed, "SMALL", 100_000)
    file = tmp_path / "bag_0.mcap.zstd"
    file.write_bytes(zstandard.ZstdCompressor().compress(bytes(50_000_000)))
    with pytest.raises(ConfigurationError, match=r"more than .* bytes in"):
        read_bag(file)
