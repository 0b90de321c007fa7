from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.bags.writing.bag_writer import PENDING_LIMIT, BagWriter
from auv_sim.bags.writing.journal import Journal


class Disk:
    """`os.write` with so many bytes of room."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, room: int) -> None:
        self.room = room
        self._write = os.write
        monkeypatch.setattr(os, "write", self.write)

    def write(self, fd: int, data: bytes) -> int:
        if self.room == 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        taken = self._write(fd, data[: self.room])
        self.room -= taken
        return taken


def test_what_does_not_fit_is_kept_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    journal = Journal(tmp_path / "file")
    journal.write(b"first")
    assert journal.commit()
    disk = Disk(monkeypatch, 3)
    journal.write(b"second")
    assert not journal.commit()
    assert journal.error is not None
    assert journal.error.errno == errno.ENOSPC
    assert (tmp_path / "file").read_bytes() == b"first"
    disk.room = 1000
    journal.write(b"third")
    assert journal.position == 16
    assert journal.commit()
    assert (tmp_path / "file").read_bytes() == b"firstsecondthird"
    assert journal.error is None
    journal.close()


def test_a_recording_survives_a_full_disk_and_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    writer = BagWriter(tmp_path / "bag")
    channel = writer.add_topic("/number", "std_msgs/msg/Float64", [])
    disk = Disk(monkeypatch, 20_000)
    for k in range(1000):
        writer.write(channel, k, k, bytes(12), k + 1)
        if k % 10 == 9:
            writer.flush()
    assert "No space left on device" in writer.trouble
    there = read_bag(tmp_path / "bag")
    assert 100 < there.count < 1000
    assert there.notes == [
        "no metadata.yaml (the recording was not closed)",
        "bag_0.mcap: the end is missing (not closed)",
    ]
    disk.room = 10**9
    assert writer.flush()
    assert writer.trouble == ""
    assert writer.close()
    whole = read_bag(tmp_path / "bag")
    assert (whole.count, whole.notes, writer.given_up) == (1000, [], 0)


def test_memory_is_bounded_while_the_disk_is_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    writer = BagWriter(tmp_path / "bag")
    channel = writer.add_topic("/number", "std_msgs/msg/Float64", [])
    Disk(monkeypatch, 0)
    big = bytes(1_000_000)
    for k in range(40):
        writer.write(channel, k, k, big)
        writer.flush()
    assert writer.pending < PENDING_LIMIT + 3_000_000
    assert writer.given_up == 40 - channel.count > 10
    assert not writer.close()
