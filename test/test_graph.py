"""The graph as a whole against `closed_loop`, against itself, and against time."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from auv_msgs_py.contract import topics
from auv_sim.bags.reading.load import load, load_messages
from auv_sim.cli.mission import main
from auv_sim.flight import closed_loop
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.launch.processes.domains import free_domain

CommandLine = Callable[..., list[str]]

_NAMES = {f"/auv/{topic.name}" for topic in topics.PER_STEP}


def messages(bag: Path) -> dict[str, list[bytes]]:
    """The raw messages of every topic that has one per step, in the order in which they were recorded."""
    found: dict[str, list[bytes]] = {name: [] for name in _NAMES}
    with AnyReader([bag]) as reader:
        chosen = [connection for connection in reader.connections if connection.topic in _NAMES]
        for connection, _, data in reader.messages(connections=chosen):
            found[connection.topic].append(bytes(data))
    return found


@pytest.fixture(scope="module")
def paper_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The paper's whole mission in a current, over separate processes; a second launcher changes nothing."""
    run = tmp_path_factory.mktemp("paper") / "run"
    with free_domain() as domain:
        fly_beside_another(run, domain)
    return run


def fly_beside_another(run: Path, domain: int) -> None:
    """Fly the paper's mission while a second launcher is refused."""
    asked = ["--quiet", "--domain", str(domain), "--out"]
    second: list[subprocess.CompletedProcess[str]] = []

    def intrude() -> None:
        """Start a second launcher, of another namespace, when the first one's nodes are there."""
        while not (run / "bag").exists():
            time.sleep(0.05)
        command = [sys.executable, "-m", "auv_sim.cli.mission", "--namespace", "/auv2", *asked, f"{run}2"]
        second.append(subprocess.run(command, capture_output=True, text=True, timeout=180, check=False))

    intruder = threading.Thread(target=intrude, daemon=True)
    intruder.start()
    assert main(["--params", "paper", "--current", "0.1", "0.2", *asked, str(run)]) == 0
    intruder.join(180.0)
    assert [(one.returncode, "/clock" in one.stderr) for one in second] == [(2, True)]


def test_the_papers_mission_over_the_graph_equals_closed_loop(paper_run: Path, tmp_path: Path) -> None:
    options = Options(params="paper", current=(0.1, 0.2))
    reference = closed_loop.fly(mission_plan.make(options, tmp_path).scenario())
    flown = load(paper_run / "bag")
    assert flown.steps == reference.steps
    for column in ("x", "y", "psi", "rudder", "rudder_cmd", "s", "xe", "ye", "Vx_est", "Vy_est"):
        difference = np.abs(getattr(flown, column) - getattr(reference, column))
        if column == "psi":
            difference = np.minimum(difference, 2.0 * np.pi - difference)
        assert difference.max() < 1e-9, column


def test_nothing_was_lost_and_nothing_came_twice(paper_run: Path) -> None:
    steps = json.loads((paper_run / "summary.json").read_text())["steps"]
    counts = {name: len(data) for name, data in messages(paper_run / "bag").items()}
    assert counts == dict.fromkeys(_NAMES, steps)


def test_the_papers_mission_meets_its_bounds(paper_run: Path) -> None:
    summary = json.loads((paper_run / "summary.json").read_text())
    assert summary["completed"] is True
    assert [part["rms_distance"] <= 0.05 for part in summary["subpaths"][2:]] == [True] * 5
    assert summary["corners"][0]["largest_distance"] <= 1.0
    assert summary["current_estimate_error"] <= 0.005


def test_two_runs_are_bit_identical_in_one_process_or_five(
    short_mission: Path, tmp_path: Path, domain: int
) -> None:
    asked = ["--mission", str(short_mission), "--current", "-0.1", "0.1", "--quiet", "--domain", str(domain)]
    assert main([*asked, "--out", str(tmp_path / "five")]) == 0
    assert main([*asked, "--out", str(tmp_path / "one"), "--composed"]) == 0
    five, one = messages(tmp_path / "five" / "bag"), messages(tmp_path / "one" / "bag")
    assert Counter({name: len(data) for name, data in five.items()}) == Counter(
        {name: len(data) for name, data in one.items()}
    )
    assert five == one


def usual_distance(run: Path) -> float:
    """The median distance from the path, m: pauses of the machine, in which nothing steers, hardly show."""
    flown = load(run / "bag")
    return float(np.nanmedian(np.hypot(flown.xe, flown.ye)))


#: Says in the middle of a mission, once each, that it is over.
FORGER = """
import rclpy
from std_msgs.msg import Float64, String
from auv_msgs_py.contract import qos, topics
rclpy.init()
node = rclpy.create_node("forger", namespace="/auv")
state = node.create_publisher(String, "mission_state", qos.offered(topics.MISSION_STATE))
words = ["complete", "idle"]
def forge(message):
    if words and message.data > 2 - len(words) + 0.5 and state.get_subscription_count() >= 4:
        state.publish(String(data=words.pop(0)))
node.create_subscription(Float64, "path_parameter", forge, 10)
print("ready", flush=True)
rclpy.spin(node)
"""


def test_free_running_follows_the_mission_too_and_one_forged_state_ends_nothing(
    short_mission: Path, tmp_path: Path, domain: int, spawn: Callable[..., subprocess.Popen[str]]
) -> None:
    """Against the wall clock: how near the track is at its worst depends on the machine."""
    forger = spawn([sys.executable, "-c", FORGER])
    assert forger.stdout is not None and forger.stdout.readline() == "ready\n"
    asked = ["--mission", str(short_mission), "--quiet", "--domain", str(domain)]
    before = signal.getsignal(signal.SIGINT)
    assert main([*asked, "--out", str(tmp_path / "free"), "--speed", "4", "--flown", "0.5"]) == 0
    assert signal.getsignal(signal.SIGINT) is before  # Ctrl-C is the caller's again
    summary = json.loads((tmp_path / "free" / "summary.json").read_text())
    assert (summary["completed"], summary["timing"]) == (True, "free running")
    assert usual_distance(tmp_path / "free") < 1.0
    said = [message.data for _, message in load_messages(tmp_path / "free" / "bag", "mission_state")]
    assert {"complete", "idle"} <= set(said[said.index("running") : len(said) - said[::-1].index("running")])


def test_a_vehicle_of_another_project_is_driven_through_the_same_mission(
    short_mission: Path, tmp_path: Path, domain: int, command_line: CommandLine, spawn: Callable[..., object]
) -> None:
    """--no-sim: a simulator started by hand stands in for the vehicle, at rest, with its own clock."""
    overrides = {"speed": "4.0", "hold_until_running": "false", "initial.surge": "0.0"}
    parameters = [word for name, value in overrides.items() for word in ("-p", f"{name}:={value}")]
    spawn(command_line("auv_sim.nodes.plant_node", "--ros-args", "-r", "__ns:=/auv", *parameters))
    asked = ["--mission", str(short_mission), "--no-sim", "--use-sim-time", "--quiet", "--flown", "0.5"]
    assert main([*asked, "--domain", str(domain), "--out", str(tmp_path / "run")]) == 0
    summary = json.loads((tmp_path / "run" / "summary.json").read_text())
    assert (summary["completed"], summary["timing"]) == (True, "free running")
    assert usual_distance(tmp_path / "run") < 1.0
