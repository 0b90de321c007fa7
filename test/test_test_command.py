"""scripts/test.py: few failed tests run again without the others, and what fails again fails the suite."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

SCRIPTS = Path(__file__).resolve().parents[1] / "scripts"
ONCE = """
from pathlib import Path

def test_a_busy_machine():
    seen = Path(__file__).with_suffix(".seen")
    if not seen.exists():
        seen.touch()
        raise AssertionError("at first")

def test_others():
    pass
"""
BROKEN = "def test_broken():\n    assert False\n"


@pytest.fixture
def command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The command, which tests an empty folder and nothing else."""
    monkeypatch.syspath_prepend(str(SCRIPTS))
    specification = importlib.util.spec_from_file_location("test_command", SCRIPTS / "test.py")
    assert specification and specification.loader
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    monkeypatch.setattr(module, "REPOSITORY", type(module.REPOSITORY)(tmp_path))
    suite = ("pytest", "-q", "--rootdir", str(tmp_path), *module.CHECKS["tests"][1:])
    monkeypatch.setattr(module, "CHECKS", {"lint": ("platform",), "tests": suite})
    return module


def test_what_failed_once_runs_again_alone_and_is_named(
    command: ModuleType, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "test_once.py").write_text(ONCE, encoding="utf-8")
    assert command.run([], 7) == 0
    said = capfd.readouterr().out
    assert "1 failed, 1 passed" in said
    *_, verdict, named = said.splitlines()
    assert verdict.startswith("== lint ok, tests ok (")
    assert named == "== failed among the others, run again without them: test_once.py::test_a_busy_machine"


def test_what_fails_again_fails_the_suite(command: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "test_once.py").write_text(ONCE + BROKEN, encoding="utf-8")
    assert command.run([], 7) == 1


def test_more_failures_are_not_repeated(
    command: ModuleType, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    for k in range(command.FEW + 1):
        (tmp_path / f"test_once_{k}.py").write_text(ONCE, encoding="utf-8")
    assert command.run([], 7) == 1
    assert "run again" not in capfd.readouterr().out


def test_what_was_asked_for_is_not_repeated(command: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "test_once.py").write_text(ONCE, encoding="utf-8")
    asked = ["-q", "--rootdir", str(tmp_path), "test_once.py"]
    assert (command.run(asked, 7), command.run(asked, 7)) == (1, 0)


def test_what_failed_in_an_earlier_run_is_forgotten(command: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "test_broken.py").write_text(BROKEN, encoding="utf-8")
    assert command.run([], 7) == 1
    (tmp_path / "test_broken.py").unlink()
    (tmp_path / "test_once.py").write_text(ONCE, encoding="utf-8")
    assert command.run([], 7) == 0
