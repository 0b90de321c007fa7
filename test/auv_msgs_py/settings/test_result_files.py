"""Results: whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from auv_msgs_py.settings import result_files
from auv_msgs_py.settings.result_files import NotWritten, replacing, write_text


def test_what_fails_otherwise_leaves_nothing_either(tmp_path):
    with pytest.raises(RuntimeError), replacing(tmp_path / "a") as draft:
        draft.write_text("half")
        raise RuntimeError
    assert list(tmp_path.iterdir()) == []


def test_a_draft_looks_like_no_result(tmp_path):
    with replacing(tmp_path / "0-1.parquet") as draft:
        draft.write_text("half")
        assert list(tmp_path.glob("*.parquet")) == []
    assert (tmp_path / "0-1.parquet").read_text() == "half"


def test_a_link_stays_a_link_and_a_device_a_device(tmp_path):
    (tmp_path / "real").write_text("old")
    (tmp_path / "link").symlink_to("real")
    write_text(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "new"
    write_text(Path(os.devnull), "new")
    assert not Path(os.devnull).is_file()
    with pytest.raises(NotWritten, match="No space left on device"):
        write_text(Path("/dev/full"), "x" * 100_000)


def test_a_copy(tmp_path):
    (tmp_path / "a").write_bytes(b"\xff")
    result_files.copy(tmp_path / "a", tmp_path / "b")
    assert (tmp_path / "b").read_bytes() == b"\xff"
    with pytest.raises(NotWritten, match="no/b cannot be written"):
        result_files.copy(tmp_path / "a", tmp_path / "no" / "b")
