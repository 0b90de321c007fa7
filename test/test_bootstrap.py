"""The set-up: what it refuses, what it takes for a sourced ROS, what it hands on, and when it starts anew."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"


@pytest.fixture
def bootstrap() -> ModuleType:
    specification = importlib.util.spec_from_file_location("bootstrap_under_test", SCRIPTS / "_bootstrap.py")
    assert specification and specification.loader
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


@pytest.fixture
def jazzy(tmp_path: Path) -> dict[str, str]:
    """The variables of a shell with a Jazzy for this Python."""
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / ("_rclpy_pybind11" + importlib.machinery.EXTENSION_SUFFIXES[0])).touch()
    (tmp_path / "librcl.so").touch()
    return {
        "ROS_DISTRO": "jazzy",
        "AMENT_PREFIX_PATH": str(tmp_path),
        "PYTHONPATH": str(tmp_path),
        "LD_LIBRARY_PATH": f"{tmp_path}{os.pathsep}/opt/else/lib",
        "RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp",
        "ROS_DOMAIN_ID": "7",
    }


@pytest.mark.parametrize("version", [(3, 11), (3, 12), (3, 13)])
def test_the_three_pythons_are_taken(bootstrap: Any, version: tuple[int, int]) -> None:
    bootstrap.check_python(version)


@pytest.mark.parametrize("version", [(3, 8), (3, 10), (3, 14)])
def test_other_pythons_are_refused_in_a_line(bootstrap: Any, version: tuple[int, int]) -> None:
    with pytest.raises(bootstrap.SetUpError, match=r"3\.11 to 3\.13 .*this is 3\.\d+: [^\n]+$"):
        bootstrap.check_python(version)


def test_other_machines_are_refused_in_a_line(bootstrap: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("platform.machine", lambda: "aarch64")
    with pytest.raises(
        bootstrap.SetUpError, match="x86_64 and this is Linux on aarch64: install ROS 2 Jazzy"
    ):
        bootstrap.check_machine(sourced=False)
    bootstrap.check_machine(sourced=True)


def test_an_old_or_other_c_library_is_refused(bootstrap: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    for reported in ("glibc 2.27", None):
        monkeypatch.setattr("os.confstr", lambda _, value=reported: value)
        with pytest.raises(bootstrap.SetUpError, match=r"glibc 2\.28"):
            bootstrap.check_machine(sourced=False)


def test_a_missing_venv_names_the_package(bootstrap: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None if name == "ensurepip" else find(name))
    with pytest.raises(bootstrap.SetUpError, match=r"sudo apt install python3[.\d]*-venv$"):
        bootstrap.check_machine(sourced=False)


def test_a_full_disk_is_seen_beforehand(bootstrap: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bootstrap, "DISK_NEEDED", 10**18)
    with pytest.raises(bootstrap.SetUpError, match="GB are needed"):
        bootstrap.check_machine(sourced=False)


def test_a_sourced_jazzy_is_recognised(bootstrap: Any, jazzy: dict[str, str]) -> None:
    assert bootstrap.is_jazzy_sourced(jazzy)
    assert bootstrap.environment_path(True) != bootstrap.environment_path(False)
    assert "ros" not in bootstrap.requirement_files(True)
    for name in ("ROS_DISTRO", "AMENT_PREFIX_PATH", "PYTHONPATH"):
        assert not bootstrap.is_jazzy_sourced({key: value for key, value in jazzy.items() if key != name})
    assert not bootstrap.is_jazzy_sourced(jazzy | {"ROS_DISTRO": "humble"})


def test_a_jazzy_for_another_python_is_refused(bootstrap: Any, jazzy: dict[str, str]) -> None:
    (native,) = Path(jazzy["PYTHONPATH"], "rclpy").iterdir()
    native.rename(native.with_name("_rclpy_pybind11.cpython-38-x86_64-linux-gnu.so"))
    with pytest.raises(bootstrap.SetUpError, match="built for cpython-38"):
        bootstrap.is_jazzy_sourced(jazzy)


def test_the_two_kinds_of_ros_do_not_mix(bootstrap: Any, jazzy: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "venv" / "lib").mkdir(parents=True)
    (tmp_path / "venv" / "pyvenv.cfg").touch()
    jazzy["LD_LIBRARY_PATH"] += f"{os.pathsep}{tmp_path / 'venv' / 'lib'}"
    jazzy["_ROS_WHEELS_BOOTSTRAP_COMPLETE"] = "1"
    wheels = bootstrap.clean(jazzy, False)
    assert wheels == {"LD_LIBRARY_PATH": "/opt/else/lib", "ROS_DOMAIN_ID": "7"}
    sourced = bootstrap.clean(jazzy, True)
    assert sourced["LD_LIBRARY_PATH"] == f"{tmp_path}{os.pathsep}/opt/else/lib"
    assert sourced.keys() == jazzy.keys() - {"_ROS_WHEELS_BOOTSTRAP_COMPLETE"}


@pytest.mark.parametrize(
    ("line", "advice", "harmless"),
    [
        ("ERROR: [Errno 28] No space left on device", "the disk is full", False),
        ("Failed to establish a new connection: [Errno -3]", "cannot be reached", True),
        ("ERROR: something else", "", False),
    ],
)
def test_advice(bootstrap: Any, line: str, advice: str, harmless: bool) -> None:
    words, unchanged = bootstrap.advice_on(["Collecting numpy", line])
    assert advice in words and "\n" not in words and bool(words) == bool(advice)
    assert unchanged is harmless


class Steps:
    """Stands in for venv and pip: notes what was to be run and makes the interpreter's file."""

    def __init__(self, environment: Path) -> None:
        self.python = environment / "bin" / "python"
        self.ran: list[list[str]] = []
        self.failure: list[str] = []

    def __call__(self, label: str, command: list[str], sourced: bool, lock: Any) -> tuple[int, list[str]]:
        self.ran.append([str(part) for part in command])
        if "venv" in command:
            self.python.parent.mkdir(parents=True, exist_ok=True)
            self.python.touch()
        return (1, self.failure) if self.failure else (0, [])

    def made_anew(self) -> bool:
        return any("--clear" in command for command in self.ran)


@pytest.fixture
def steps(bootstrap: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Steps:
    monkeypatch.setattr(bootstrap, "ENVIRONMENTS", str(tmp_path))
    steps = Steps(tmp_path / "env")
    monkeypatch.setattr(bootstrap, "_run", steps)
    return steps


def make(bootstrap: Any, tmp_path: Path, *extra: str) -> bool:
    environment, expected = str(tmp_path / "env"), bootstrap.fingerprint(False, extra)
    bootstrap._make_once(environment, False, extra, expected)
    return bool(bootstrap.is_complete(environment, expected))


def test_it_is_made_once_and_extended(bootstrap: Any, steps: Steps, tmp_path: Path) -> None:
    assert make(bootstrap, tmp_path) and steps.made_anew()
    steps.ran.clear()
    assert make(bootstrap, tmp_path) and steps.ran == []
    assert make(bootstrap, tmp_path, "dev") and len(steps.ran) == 1 and not steps.made_anew()
    steps.ran.clear()
    assert make(bootstrap, tmp_path, "dev") and make(bootstrap, tmp_path) and steps.ran == []


def test_an_interrupted_one_is_made_anew(bootstrap: Any, steps: Steps, tmp_path: Path) -> None:
    steps.failure = ["ERROR: [Errno 28] No space left on device"]
    with pytest.raises(bootstrap.SetUpError, match="disk is full"):
        make(bootstrap, tmp_path)
    steps.failure = []
    steps.ran.clear()
    assert make(bootstrap, tmp_path) and steps.made_anew()


def test_without_a_network_what_was_there_stays_usable(bootstrap: Any, steps: Steps, tmp_path: Path) -> None:
    assert make(bootstrap, tmp_path)
    steps.failure = ["Failed to establish a new connection"]
    with pytest.raises(bootstrap.SetUpError, match="cannot be reached"):
        make(bootstrap, tmp_path, "dev")
    steps.ran.clear()
    assert make(bootstrap, tmp_path) and steps.ran == []


def test_a_moved_repository_gets_a_new_one(
    bootstrap: Any, steps: Steps, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert make(bootstrap, tmp_path)
    before = bootstrap.fingerprint(False, ())
    stamp = tmp_path / "env" / bootstrap._STAMP
    stamp.write_text(stamp.read_text().replace(before[0], "at /elsewhere"))
    steps.ran.clear()
    assert make(bootstrap, tmp_path) and steps.made_anew()


def test_the_fingerprint_follows_python_and_files(bootstrap: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    before = bootstrap.fingerprint(False, ("dev",))
    assert before == bootstrap.fingerprint(False, ("dev",))
    assert before[1] != bootstrap.fingerprint(True, ("dev",))[1]
    monkeypatch.setattr(sys, "version_info", (3, 99, 0))
    assert before[1] != bootstrap.fingerprint(False, ("dev",))[1]
