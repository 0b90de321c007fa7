"""Which files belong to a recording: never one outside of its directory, whatever metadata.yaml names."""

from __future__ import annotations

from pathlib import Path

import pytest

from auv_sim.bags.content.recorded_mission import configuration
from auv_sim.bags.definitions import typestore
from auv_sim.bags.metadata import METADATA_FILE
from auv_sim.bags.reading.bag_files import files_of
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.reading.recording import Bag
from auv_sim.bags.writing.bag_writer import BagWriter
from auv_sim.cli import bag as bag_command

FLOAT = "std_msgs/msg/Float64"


def record(directory: Path, messages: int = 10, close: bool = True) -> Path:
    """Ten numbers; returns the storage file."""
    writer = BagWriter(directory)
    topic = writer.add_topic("/a", FLOAT, [])
    data = bytes(typestore().serialize_cdr(typestore().types[FLOAT](1.0), FLOAT))
    for k in range(messages):
        writer.write(topic, k, k, data, k + 1)
    writer.flush()
    if close:
        writer.close()
    return writer.file


def name_also(bag: Path, name: str) -> None:
    """Put a further name before the ones in metadata.yaml."""
    file = bag / METADATA_FILE
    text = file.read_text()
    assert "relative_file_paths:\n" in text
    file.write_text(text.replace("relative_file_paths:\n", f"relative_file_paths:\n  - {name}\n"))


def below(directory: Path) -> dict[str, bytes]:
    """Every file below a directory."""
    return {str(p.relative_to(directory)): p.read_bytes() for p in directory.rglob("*") if p.is_file()}


@pytest.mark.parametrize("kind", ["above", "absolute", "in and out", "through a link"])
@pytest.mark.parametrize("damaged", [False, True])
def test_repair_touches_no_file_outside(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], kind: str, damaged: bool
) -> None:
    precious = tmp_path / "precious"
    record(precious, 7, close=not damaged)
    bag = tmp_path / "bag"
    file = record(bag)
    if damaged:
        file.write_bytes(file.read_bytes()[:-3])
    (bag / "sub").mkdir()
    (bag / "link").symlink_to(precious)
    names = {
        "above": "../precious/precious_0.mcap",
        "absolute": str(precious / "precious_0.mcap"),
        "in and out": "sub/../../precious/precious_0.mcap",
        "through a link": "link/precious_0.mcap",
    }
    name_also(bag, names[kind])
    before = below(precious)
    assert bag_command.main(["repair", str(bag)]) == 0
    out = capsys.readouterr().out
    assert f"names {names[kind]}, which is not in the recording: left out" in out
    assert "whole, 10 messages" in out
    assert below(precious) == before
    assert read_bag(bag).count == 10
    assert read_bag(bag).notes == []


def test_a_linked_storage_file_is_read_and_its_target_stays(tmp_path: Path) -> None:
    """Recordings on another disk are linked: repair replaces the link, not what it leads to."""
    target = record(tmp_path / "disk", close=False)
    bag = tmp_path / "bag"
    bag.mkdir()
    (bag / "bag_0.mcap").symlink_to(target)
    before = below(tmp_path / "disk")
    assert bag_command.main(["repair", str(bag)]) == 0
    assert below(tmp_path / "disk") == before
    assert read_bag(bag).count == 10
    assert not (bag / "bag_0.mcap").is_symlink()


@pytest.mark.parametrize("other", ["bag.repairing", "bag.damaged"])
def test_repair_leaves_neighbours_alone(tmp_path: Path, other: str) -> None:
    bag = tmp_path / "bag"
    record(bag, close=False)
    (tmp_path / other).mkdir()
    (tmp_path / other / "notes.txt").write_text("precious")
    assert bag_command.main(["repair", str(bag)]) == 0
    assert below(tmp_path / other) == {"notes.txt": b"precious"}


def test_repair_writes_over_nothing_that_is_not_the_recordings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A dangling link has the name of the file to come."""
    file = record(tmp_path / "bag", close=False)
    other = file.rename(file.with_name("other.mcap"))
    file.symlink_to("nowhere")
    assert bag_command.main(["repair", str(tmp_path / "bag")]) == 2
    err = capsys.readouterr().err
    assert "bag_0.mcap: found something with this name" in err and err.count("\n") == 1
    assert file.is_symlink()
    assert other.exists()
    assert sorted(path.name for path in (tmp_path / "bag").iterdir()) == ["bag_0.mcap", "other.mcap"]


@pytest.mark.parametrize(
    ("name", "kept"),
    [
        ("bag_0.mcap", True),
        ("./bag_0.mcap", True),
        ("sub/../bag_0.mcap", True),
        ("..", False),
        ("", False),
        ("../bag/../bag_0.mcap", False),
        ("a\0b.mcap", False),
        ("x" * 5000 + ".mcap", False),
        ("/etc/passwd", False),
        ("\x1b[2Jevil/../../x.mcap", False),
    ],
)
def test_a_name_counts_once_and_only_inside(tmp_path: Path, name: str, kept: bool) -> None:
    file = tmp_path / "bag" / "bag_0.mcap"
    file.parent.mkdir()
    file.touch()
    notes: list[str] = []
    information = {"relative_file_paths": ["bag_0.mcap", name], "version": 9}
    assert files_of(file.parent, information, notes) == [file]
    assert len(notes) == (0 if kept else 1)
    assert all(note.isprintable() and len(note) < 300 for note in notes)


def test_older_names_begin_with_the_directory(tmp_path: Path) -> None:
    """Up to version 3, rosbag2 wrote `bag/bag_0.db3`; renaming the directory does not change the name."""
    file = tmp_path / "renamed" / "bag_0.db3"
    file.parent.mkdir()
    file.touch()
    notes: list[str] = []
    assert files_of(file.parent, {"relative_file_paths": ["bag/bag_0.db3"], "version": 3}, notes) == [file]
    assert notes == []


def test_only_regular_files_are_read(tmp_path: Path) -> None:
    (tmp_path / "bag_0.mcap").mkdir()
    notes: list[str] = []
    assert files_of(tmp_path, {}, notes) == []


def test_texts_in_a_recording_are_unpacked_inside_only(tmp_path: Path) -> None:
    texts = {
        "mission.yaml": "good",
        "../out.yaml": "bad",
        str(tmp_path / "abs.yaml"): "bad",
        "mission.yaml/below": "bad",
        "": "bad",
        "a\0b": "bad",
        "x" * 300: "bad",
    }
    with configuration(Bag(tmp_path / "bag", texts=texts)) as directory:
        assert below(directory) == {"mission.yaml": b"good"}
        assert not (directory.parent / "out.yaml").exists()
    assert list(tmp_path.iterdir()) == []
