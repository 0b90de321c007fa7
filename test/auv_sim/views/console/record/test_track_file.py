"""A track on disk: read again by the console that is started anew, and never in the way."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import numpy as np
import pytest

from auv_sim.views.console.record import track_file
from auv_sim.views.console.record.history import Rows
from auv_sim.views.console.record.track_columns import NAMES
from auv_sim.views.console.record.track_file import TrackFile, remove_stale

ROWS: Rows = np.arange(3 * len(NAMES), dtype=np.float32).reshape(3, -1)


def test_what_was_written_is_read(tmp_path: Path) -> None:
    file = TrackFile(tmp_path, "7 /auv abc")
    assert file.read() is None
    file.begin(12.5, ROWS[:1])
    file.append(ROWS[1:].tobytes())
    found = TrackFile(tmp_path, "7 /auv abc").read()
    assert found is not None
    assert found[0] == 12.5
    assert np.array_equal(found[1], ROWS)
    assert TrackFile(tmp_path, "7 /auv abd").read() is None, "another publisher has another track"
    (path,) = tmp_path.iterdir()
    assert stat.S_IMODE(path.stat().st_mode) == 0o600


@pytest.mark.parametrize("spoil", [b"", b"{}\n", b"no json", b'{"t0": NaN, "columns": 3}\n', b"\xff\xfe\n\n"])
def test_a_spoiled_file_is_no_track(spoil: bytes, tmp_path: Path) -> None:
    file = TrackFile(tmp_path, "one")
    file.begin(1.0, ROWS)
    (path,) = tmp_path.iterdir()
    path.write_bytes(spoil)
    assert file.read() is None


def test_a_row_that_was_cut_off_is_left_out(tmp_path: Path) -> None:
    file = TrackFile(tmp_path, "one")
    file.begin(1.0, ROWS)
    (path,) = tmp_path.iterdir()
    path.write_bytes(path.read_bytes()[:-3])
    found = file.read()
    assert found is not None
    assert np.array_equal(found[1], ROWS[:2])


def test_a_disk_that_fails_costs_the_track_alone(tmp_path: Path) -> None:
    file = TrackFile(tmp_path / "gone", "one")
    file.begin(1.0, ROWS)
    file.append(ROWS.tobytes())
    assert file.read() is None
    nowhere = TrackFile(None, "one")
    nowhere.begin(1.0, ROWS)
    nowhere.append(ROWS.tobytes())
    assert nowhere.read() is None


def test_old_tracks_and_too_many_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(track_file, "MOST_FILES", 2)
    now = 1e9
    for name, age in (("old", track_file.STALE + 1.0), ("third", 30.0), ("second", 20.0), ("first", 10.0)):
        file = tmp_path / f"{name}.track"
        file.touch()
        os.utime(file, (now - age, now - age))
    (tmp_path / "other.json").touch()
    remove_stale(tmp_path, now)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["first.track", "other.json", "second.track"]
