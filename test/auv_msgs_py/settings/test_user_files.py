"""Files of other people: regular ones, not too large, and nothing waits for a pipe."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from auv_msgs_py.settings import user_files
from auv_msgs_py.values.errors import ConfigurationError


def _refusal(path, most=100):
    with pytest.raises(ConfigurationError) as caught:
        user_files.read_text(path, "a mission", most)
    message = str(caught.value)
    assert message.isprintable()
    assert message.endswith("expected a mission") or "at most" in message
    return message


def test_text_is_read_without_its_byte_order_mark(tmp_path):
    file = tmp_path / "f.txt"
    file.write_bytes(b"\xef\xbb\xbfa: \xc3\xa9\n")
    assert user_files.read_text(file, "a mission", 9) == "a: é\n"


def test_a_link_is_followed_and_its_target_is_not_named(tmp_path):
    (tmp_path / "secret").write_bytes(b"\xff")
    (tmp_path / "link").symlink_to(tmp_path / "secret")
    assert user_files.read_bytes(tmp_path / "link", "a mission") == b"\xff"
    assert "secret" not in _refusal(tmp_path / "link")
    (tmp_path / "round").symlink_to(tmp_path / "round")
    assert "Too many levels of symbolic links" in _refusal(tmp_path / "round")


def test_a_pipe_is_refused_at_once(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    assert "found a named pipe" in _refusal(tmp_path / "pipe")


def test_a_socket_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with socket.socket(socket.AF_UNIX) as listening:
        listening.bind("s")
        assert "cannot be read" in _refusal(tmp_path / "s")


def test_endless_devices_and_folders_are_refused(tmp_path):
    assert "found a device" in _refusal(Path("/dev/zero"))
    assert "found a directory" in _refusal(tmp_path)


def test_size_is_limited_also_where_the_system_gives_none(tmp_path):
    file = tmp_path / "f"
    file.write_bytes(b"x" * 101)
    assert "found 101 bytes, expected a file of at most 100 bytes" in _refusal(file)
    assert Path("/proc/self/maps").stat().st_size == 0
    assert "at most" in _refusal(Path("/proc/self/maps"))
    with user_files.opened(file, "a bag") as stream:  # without a limit
        assert len(stream.read()) == 101


@pytest.mark.parametrize("name", ["n" * 5000, "a\0b", "none"])
def test_names_that_no_file_has(tmp_path, name):
    assert len(_refusal(tmp_path / name)) < 1000
    assert not user_files.exists(tmp_path / name)


def test_text_in_another_encoding_and_pointers_are_recognised(tmp_path):
    file = tmp_path / "f"
    file.write_bytes("é".encode("latin-1"))
    assert "byte 0 is not UTF-8" in _refusal(file)
    file.write_bytes(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
    with pytest.raises(ConfigurationError, match=r"found a Git LFS pointer.*git lfs pull"):
        user_files.read_text(file, "a mission")


def test_a_home_that_is_not_there(monkeypatch):
    monkeypatch.delenv("HOME", raising=False)
    monkeypatch.setattr("os.path.expanduser", lambda path: path)  # as for a user without an entry
    assert user_files.from_home("~/m.yaml") == Path("~/m.yaml")
