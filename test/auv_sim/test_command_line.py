"""How every command ends, whatever happens in it; and what its options take."""

from __future__ import annotations

import argparse
import importlib
import os
import pty
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError, MessageRefused, SuiteError
from auv_sim import command_line
from auv_sim.cli import plan

ROOT = Path(__file__).resolve().parents[2]
#: Script -> the module whose `main` it starts.
COMMANDS = {
    script.name: found[1]
    for script in sorted((ROOT / "scripts").glob("*.py"))
    if (
        found := re.search(
            r"^from (auv_sim\S*) import main", script.read_text(encoding="utf-8"), re.MULTILINE
        )
    )
}
ENDINGS = {
    "bad input": (ConfigurationError("--it", "one", "the other"), 2, "--it: found one, expected the other"),
    "a bad message": (MessageRefused("odom", "NaN", "a number"), 2, "odom: found NaN, expected a number"),
    "a failure": (SuiteError("it broke"), 1, "failed: it broke"),
    "Ctrl-C": (KeyboardInterrupt(), 130, "interrupted"),
}


def test_every_command_is_looked_at() -> None:
    assert len(COMMANDS) >= 10


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("script", COMMANDS)
def test_every_command_ends_with_one_line_and_its_code(
    script: str, ending: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    error, code, said = ENDINGS[ending]

    def fails(*_: object, **__: object) -> None:
        raise error

    main = importlib.import_module(COMMANDS[script]).main
    monkeypatch.setattr(argparse.ArgumentParser, "parse_args", fails)
    monkeypatch.setattr(sys, "argv", [script])
    assert main() == code
    err = capsys.readouterr().err
    assert said in err
    assert err.strip().count("\n") == 0


def test_a_mistake_of_ours_is_not_hidden() -> None:
    @command_line.command("it")
    def main() -> int:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        main()


def at_the_question(terminal: int) -> subprocess.Popen[bytes]:
    """check_vehicle, started and waiting for an answer."""
    process = subprocess.Popen(
        [sys.executable, str(ROOT / "scripts" / "check_vehicle.py"), "--wiggle"],
        stdin=terminal, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )  # fmt: skip
    assert process.stdout is not None
    said = b""
    while b"Type yes" not in said:
        more = os.read(process.stdout.fileno(), 1000)
        assert more, "it ended before it asked"
        said += more
    return process


@pytest.mark.parametrize(
    ("answer", "code", "said"),
    [
        (
            lambda process, _: process.send_signal(signal.SIGINT),
            130,
            "interrupted: zero commands were sent\n",
        ),
        (lambda _, terminal: os.write(terminal, b"\x04"), 2, "--wiggle: found no answer, expected yes\n"),
        (
            lambda _, terminal: os.write(terminal, b"no\n"),
            2,
            "--wiggle: found another answer, expected yes\n",
        ),
    ],
    ids=["Ctrl-C", "Ctrl-D", "no"],
)
def test_a_question_that_is_not_answered(
    answer: Callable[[subprocess.Popen[bytes], int], object], code: int, said: str
) -> None:
    ours, theirs = pty.openpty()
    process = at_the_question(theirs)
    try:
        # A signal between the words and the wait for an answer waits itself: people press it again.
        for _ in range(20):
            answer(process, ours)
            try:
                _, err = process.communicate(timeout=15.0)
                break
            except subprocess.TimeoutExpired:
                continue
    finally:
        process.kill()
        process.wait()
        os.close(ours)
        os.close(theirs)
    assert process.returncode == code
    assert err.decode().lstrip("\n") == said


def test_ctrl_c_while_a_script_is_still_loading_says_so_in_a_line(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text("import time\nprint('loading', flush=True)\ntime.sleep(600)\n")
    script = tmp_path / "script.py"
    script.write_text("import _bootstrap\n_bootstrap.ensure_environment()\nimport slow\n")
    places = os.pathsep.join((str(ROOT / "scripts"), str(tmp_path)))
    process = subprocess.Popen(
        [sys.executable, str(script)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        env={**os.environ, "PYTHONPATH": places},
    )  # fmt: skip
    assert process.stdout is not None
    assert process.stdout.readline() == "loading\n"
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=180)
    assert process.returncode == -signal.SIGINT  # which a shell calls 130
    assert err == "interrupted\n"


@pytest.mark.parametrize("place", ["nowhere/x.json", "folder", "file/x.json"])
def test_a_file_that_cannot_be_written_is_found_before_the_work(
    place: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder").mkdir()
    Path("file").touch()
    with pytest.raises(argparse.ArgumentTypeError, match=f"found '{place}'.*, expected a file that can be"):
        command_line.target(place)
    assert command_line.target("folder/x.json") == Path("folder/x.json")
    assert command_line.target("file") == Path("file")


@pytest.mark.parametrize(
    ("script", "arguments"),
    [
        ("benchmark.py", ["--json"]),
        ("fault_matrix.py", ["--json"]),
        ("bag.py", ["rerun", "a_bag", "--csv"]),
        ("bag.py", ["rerun", "a_bag", "--png"]),
        ("bag.py", ["compare", "a_bag", "a_bag", "--png"]),
        ("bag.py", ["export", "a_bag", "--out"]),
    ],
)
def test_every_command_looks_at_its_target_first(
    script: str, arguments: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    begin = time.monotonic()
    with pytest.raises(SystemExit) as caught:
        importlib.import_module(COMMANDS[script]).main([*arguments, str(tmp_path / "nowhere" / "x.csv")])
    assert caught.value.code == 2
    err = capsys.readouterr().err
    assert "expected a file that can be written" in err and err.count("\n") == 1
    assert time.monotonic() - begin < 180.0  # nothing was measured before


def test_a_directory_is_made_or_named(tmp_path: Path) -> None:
    command_line.make_directory(tmp_path / "a" / "b")
    command_line.make_directory(tmp_path / "a" / "b")
    with pytest.raises(
        ConfigurationError, match=r"--out: found .*b .File exists., expected a directory that"
    ):
        command_line.make_directory(tmp_path / "a" / "b", new=True)
    (tmp_path / "file").touch()
    with pytest.raises(ConfigurationError, match="--images: found "):
        command_line.make_directory(tmp_path / "file" / "below", "--images")


@pytest.mark.parametrize(
    ("script", "arguments"),
    [
        ("campaign.py", ["region_of_attraction", "--out"]),
        ("sea_trials.py", ["--out"]),
        ("reproduce_paper.py", ["--out"]),
        ("soak.py", ["--out"]),
        ("fault_matrix.py", ["--out"]),
        ("mission.py", ["--out"]),
        ("gallery.py", ["--page", str(ROOT / "docs" / "missions.md"), "--images"]),
        ("benchmark.py", ["--write-docs", "--page", str(ROOT / "docs" / "performance.md"), "--images"]),
    ],
)
def test_every_command_makes_its_directory_first(
    script: str, arguments: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").touch()
    main = importlib.import_module(COMMANDS[script]).main
    assert main([*arguments, str(tmp_path / "file" / "below")]) == 2
    err = capsys.readouterr().err
    assert "expected a directory that can be made" in err and err.count("\n") == 1


def test_a_printed_command_is_the_same_after_the_shell_has_read_it() -> None:
    words = {
        "out": Path("my runs/$HOME"),
        "current": (-0.1, 0.2),
        "replay_run": 3,
        "graph": True,
        "sea": None,
    }
    line = command_line.to_type("campaign.py", "it's here", **words)
    assert shlex.split(line) == [
        "python3", "scripts/campaign.py", "it's here", "--out", "my runs/$HOME", "--current", "-0.1", "0.2",
        "--replay-run", "3", "--graph",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("running", "printed"),
    [
        (str(ROOT / "scripts" / "vehicle.py"), str(ROOT / "scripts" / "bag.py")),
        ("../scripts/vehicle.py", "../scripts/bag.py"),
        ("vehicle.py", "scripts/bag.py"),  # no script of that name here
        ("/usr/bin/ros2", "scripts/bag.py"),
    ],
)
def test_a_printed_command_starts_the_script_where_the_shell_finds_it(
    running: str, printed: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT / "docs")
    monkeypatch.setattr(sys, "argv", [running, "identify"])
    assert shlex.split(command_line.to_type("bag.py")) == ["python3", printed]


def test_only_options_that_differ_from_their_defaults_are_repeated() -> None:
    parser = plan.parser()
    options = parser.parse_args(["box", "--current", "0", "0", "--params", "robust", "--vehicle", "remus100"])
    assert command_line.not_default(parser, options) == {"mission": "box", "params": "robust"}
    options = parser.parse_args(["box", "--quiet", "--current", "0", "0.1"])
    assert command_line.not_default(parser, options) == {
        "mission": "box", "current": [0.0, 0.1], "quiet": True,
    }  # fmt: skip
