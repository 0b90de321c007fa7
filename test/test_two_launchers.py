"""A second launcher beside a mission: it is refused, and the first mission ends as if it had been alone.

One combination is flown by default, and one more beside the paper's mission in `test_graph.py`. All of them,
some minutes on a quiet machine:

    AUV_ALL_COMBINATIONS=1 python3 scripts/test.py -q test/test_two_launchers.py
"""

from __future__ import annotations

import itertools
import json
import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from test_graph import messages

#: How a launcher may fly -> its arguments.
KINDS = {
    "lockstep": [],
    "free running": ["--speed", "3"],
    "no-sim": ["--no-sim", "--use-sim-time"],
}
TABLE = list(itertools.product(KINDS, KINDS, ("/auv", "/auv2")))
#: A launcher without a simulator needs no clock of its own: in another namespace it conflicts with no other.
BESIDE = {row for row in TABLE if row[1:] == ("no-sim", "/auv2")}
DEFAULT = [("no-sim", "free running", "/auv")]


def launch(
    command_line: Callable[..., list[str]], mission: Path, domain: int, out: Path, kind: str, namespace: str
) -> list[str]:
    """The command line of one launcher."""
    fixed = ["--quiet", "--mission", mission, "--domain", domain, "--namespace", namespace, "--out", out]
    fixed += ["--flown", "0.5"]  # free running on a busy machine a mission this short misses metres
    return command_line("auv_sim.cli.mission", *fixed, *KINDS[kind])


def until(condition: Callable[[], object], patience: float = 180.0) -> None:
    deadline = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < deadline, "what was waited for did not happen"
        time.sleep(0.05)


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[[Path], dict[str, list[bytes]]]]:
    """The messages of a lockstep mission that is alone, flown when it is first needed."""
    found: dict[Path, dict[str, list[bytes]]] = {}

    def fly(mission: Path) -> dict[str, list[bytes]]:
        if mission not in found:
            from auv_sim.cli.mission import main

            out = tmp_path_factory.mktemp("alone") / "run"
            asked = ["--quiet", "--flown", "0", "--mission", str(mission), "--out", str(out)]
            assert main(asked) == 0
            found[mission] = messages(out / "bag")
        return found[mission]

    yield fly


@pytest.mark.parametrize(
    ("first", "second", "namespace"), TABLE if os.environ.get("AUV_ALL_COMBINATIONS") else DEFAULT
)
def test_the_first_mission_ends_as_if_alone(
    first: str,
    second: str,
    namespace: str,
    short_mission: Path,
    tmp_path: Path,
    domain: int,
    command_line: Callable[..., list[str]],
    spawn: Callable[..., subprocess.Popen[str]],
    request: pytest.FixtureRequest,
) -> None:
    vehicle = None
    if first == "no-sim":  # the vehicle: a simulator that was started by hand
        overrides = ("speed:=5.0", "initial.surge:=0.0")
        parameters = [word for value in overrides for word in ("-p", value)]
        vehicle = spawn(
            command_line("auv_sim.nodes.plant_node", "--ros-args", "-r", "__ns:=/auv", *parameters)
        )
    # In lockstep long enough for a second launcher to come up beside it.
    mission = Path("paper_composite") if first == "lockstep" else short_mission
    flying = spawn(launch(command_line, mission, domain, tmp_path / "one", first, "/auv"))
    until(lambda: (tmp_path / "one" / "bag").exists() or flying.poll() is not None)
    if vehicle is not None:  # its time stands still: the mission is still under way when the other looks
        vehicle.send_signal(signal.SIGSTOP)
    other = spawn(launch(command_line, short_mission, domain, tmp_path / "two", second, namespace))
    if (first, second, namespace) in BESIDE:
        assert flying.wait(180) == 0
        assert other.poll() is None
        other.send_signal(signal.SIGINT)
        assert other.wait(180) == 130
    else:
        _, err = other.communicate(timeout=180)
        assert (other.returncode, len(err.splitlines())) == (2, 1), err
        assert "mission_launcher: found" in err and "nothing that runs was touched" in err
        assert not (tmp_path / "two").exists()
        if vehicle is not None:
            vehicle.send_signal(signal.SIGCONT)
        _, err = flying.communicate(timeout=180)
        assert flying.returncode == 0, err
    summary = json.loads((tmp_path / "one" / "summary.json").read_text())
    assert (summary["outcome"], summary["completed"]) == ("complete", True)
    if first == "lockstep":
        assert messages(tmp_path / "one" / "bag") == request.getfixturevalue("alone")(mission)


def test_of_two_launchers_at_the_same_moment_one_flies(
    short_mission: Path,
    tmp_path: Path,
    domain: int,
    command_line: Callable[..., list[str]],
    spawn: Callable[..., subprocess.Popen[str]],
) -> None:
    both = [
        spawn(launch(command_line, short_mission, domain, tmp_path / name, "lockstep", f"/{name}"))
        for name in ("one", "two")
    ]
    assert sorted(process.wait(180) for process in both) == [0, 2]
    (flown,) = [name for name in ("one", "two") if (tmp_path / name).exists()]
    assert json.loads((tmp_path / flown / "summary.json").read_text())["completed"] is True
