"""What ROS arguments say about parameters, and where ROS's logs go."""

from __future__ import annotations

import os

import pytest

from auv_msgs_py.node.log_directory import ensure_log_directory
from auv_msgs_py.node.ros_arguments import check_parameter_files, shared_names
from auv_msgs_py.values.errors import ConfigurationError


@pytest.fixture
def files(tmp_path):
    """Arguments that name a file of shared and one of own blocks."""
    shared, own = tmp_path / "shared.yaml", tmp_path / "own.yaml"
    for_all = "/**: {ros__parameters: {a: 1, b.c: 2, d: {e: 3}, f: 4}}\n"
    shared.write_text(for_all + "/auv/*: {ros__parameters: {g: 5}}\n")
    own.write_text("/**/pilot: {ros__parameters: {a: 1}}\n/auv/other: {ros__parameters: {b.c: 2}}\n")
    return ["node", "--ros-args", "--params-file", str(shared), "--params-file", str(own)]


def test_names_of_shared_blocks_alone(files):
    assert shared_names(files, "pilot") == {"b.c", "d.e", "f", "g"}
    assert shared_names(files, "other") == {"a", "d.e", "f", "g"}
    assert shared_names([*files, "-p", "f:=1", "--param", "pilot:g:=2"], "pilot") == {"b.c", "d.e"}
    assert shared_names(["node"], "pilot") == set()


@pytest.mark.parametrize("text", [None, "a: [", "a: !!int x"])
def test_a_file_that_ros_could_not_read_is_one_line(tmp_path, text):
    file = tmp_path / "p.yaml"
    if text is not None:
        file.write_text(text)
    with pytest.raises(ConfigurationError, match=r"p\.yaml: "):
        check_parameter_files(["--ros-args", "--params-file", str(file)])


@pytest.mark.parametrize("home", [None, "", "nowhere"])
def test_ros_logs_have_a_place_without_a_home(tmp_path, monkeypatch, home):
    for name in ("ROS_LOG_DIR", "ROS_HOME", "HOME"):
        monkeypatch.delenv(name, raising=False)
    if home is not None:
        monkeypatch.setenv("HOME", home and str(tmp_path / home))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    ensure_log_directory()
    place = os.environ.pop("ROS_LOG_DIR")
    assert place.startswith(str(tmp_path))


@pytest.mark.parametrize("name", ["ROS_LOG_DIR", "ROS_HOME", "HOME"])
def test_a_place_that_is_there_stays(tmp_path, monkeypatch, name):
    for other in ("ROS_LOG_DIR", "ROS_HOME", "HOME"):
        monkeypatch.delenv(other, raising=False)
    monkeypatch.setenv(name, str(tmp_path))
    ensure_log_directory()
    assert os.environ.get("ROS_LOG_DIR") == (str(tmp_path) if name == "ROS_LOG_DIR" else None)
