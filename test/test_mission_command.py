"""The launcher as a process: what it prints, what it leaves, how it ends when something goes wrong."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from auv_path_following.missions import mission_file
from auv_sim.bags.reading.growing_bag import has_message
from auv_sim.cli.mission import main
from auv_sim.launch import launcher, mission_plan
from auv_sim.launch.options import Options
from auv_sim.launch.processes import domains

CommandLine = Callable[..., list[str]]
Spawn = Callable[[list[str]], "subprocess.Popen[str]"]
Look = Callable[[int], dict[str, int]]

NODES = {"plant_node", "current_observer_node", "guidance_node", "heading_autopilot_node", "recorder_node"}


def wait_for(condition: Callable[[], object], what: str) -> None:
    """Poll; a hang fails the test instead of blocking it."""
    deadline = time.monotonic() + 180.0
    while not condition():
        assert time.monotonic() < deadline, f"waited for {what}"
        time.sleep(0.02)


def alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def under_way(run: Path) -> bool:
    """The recorder has written the answer to a step."""
    return has_message(run / "bag", "/auv/thrust_cmd")


def test_a_mission_is_flown_recorded_and_drawn(
    command_line: CommandLine, spawn: Spawn, node_processes: Look, short_mission: Path, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    launcher = spawn(command_line("auv_sim.cli.mission", "--mission", short_mission, "--out", run))
    wait_for(lambda: set(node_processes(launcher.pid)) >= NODES, "one process for each node")
    out, err = launcher.communicate(timeout=180)
    assert (launcher.returncode, err) == (0, "")
    assert "short: complete" in out
    assert "Look further:" in out
    assert {path.name for path in run.iterdir()} == {"bag", "config", "log", "overview.png", "summary.json"}
    summary = json.loads((run / "summary.json").read_text())
    assert summary["outcome"] == "complete"
    assert summary["completed"] is True
    assert (summary["flown_share"], summary["missed"], summary["skipped"]) == (1.0, [], [])
    assert [part["number"] for part in summary["subpaths"]] == [1, 2, 3]
    assert summary["largest_distance"] < 0.5


def test_what_was_flown_can_be_flown_again_from_its_own_configuration(
    short_mission: Path, tmp_path: Path, domain: int
) -> None:
    first, second = tmp_path / "first", tmp_path / "second"
    asked = ["--mission", str(short_mission), "--current", "0.1", "-0.05", "--switching", "all", "--quiet"]
    assert main([*asked, "--out", str(first), "--domain", str(domain)]) == 0
    config = first / "config"
    again = ["--mission", "mission.yaml", "--vehicle", "vehicle.yaml", "--params", "params.yaml"]
    paths = [str(config / word) if word.endswith(".yaml") else word for word in again]
    assert main([*paths, "--composed", "--quiet", "--out", str(second), "--domain", str(domain)]) == 0
    figures = [json.loads((run / "summary.json").read_text()) for run in (first, second)]
    for key in ("steps", "rms_distance", "largest_distance", "rudder_travel"):
        assert figures[0][key] == figures[1][key]


@pytest.mark.parametrize("victim", ["guidance_node", "recorder_node"])
def test_a_node_that_dies_ends_the_mission_with_its_name_and_leaves_nothing_running(
    victim: str, command_line: CommandLine, spawn: Spawn, node_processes: Look, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    launcher = spawn(command_line("auv_sim.cli.mission", "--out", run, "--speed", "5"))
    wait_for(lambda: under_way(run), "a mission under way")
    nodes = node_processes(launcher.pid)
    os.kill(nodes[victim], signal.SIGKILL)
    _, err = launcher.communicate(timeout=180)
    assert launcher.returncode == 1
    name = "ailos_guidance" if victim == "guidance_node" else "recorder"
    assert f"mission failed: {name} was killed by signal 9; its last lines" in err
    assert "Traceback" not in err
    assert not [pid for pid in nodes.values() if alive(pid)]


@pytest.mark.parametrize(
    ("frozen", "named"),
    [
        # What guidance and the autopilot wait for leads to it; test_lockstep.py has all the other cases.
        ("current_observer_node", "current_observer did not send"),
        ("recorder_node", "recorder did not send"),
    ],
)
def test_in_lockstep_a_node_that_hangs_is_named(
    frozen: str, named: str, command_line: CommandLine, spawn: Spawn, node_processes: Look, tmp_path: Path
) -> None:
    params = tmp_path / "params.yaml"
    params.write_text("/**/remus_plant: {ros__parameters: {answer_timeout: 3.0}}\n")
    for k in range(3):  # another node, paused by the machine at the same time, is named with as much right
        run = tmp_path / f"run{k}"
        launcher = spawn(command_line("auv_sim.cli.mission", "--out", run, "--params", params))
        wait_for(lambda at=run: under_way(at), "a mission under way")
        nodes = node_processes(launcher.pid)
        os.kill(nodes[frozen], signal.SIGSTOP)
        wait_for(lambda pid=nodes["plant_node"]: not alive(pid), "the simulator to give up")
        os.kill(nodes[frozen], signal.SIGCONT)
        _, err = launcher.communicate(timeout=180)
        assert launcher.returncode == 1
        assert "mission failed: remus_plant ended with code 1" in err
        assert not [pid for pid in nodes.values() if alive(pid)]
        if named in err:
            break
    assert named in err


def test_ctrl_c_ends_cleanly_with_what_was_flown(
    command_line: CommandLine, spawn: Spawn, node_processes: Look, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    launcher = spawn(command_line("auv_sim.cli.mission", "--out", run))
    wait_for(lambda: under_way(run), "a mission under way")
    nodes = node_processes(launcher.pid)
    launcher.send_signal(signal.SIGINT)
    _, err = launcher.communicate(timeout=180)
    assert launcher.returncode == 130
    assert err == "mission interrupted: stopped by a signal\n"
    assert json.loads((run / "summary.json").read_text())["outcome"] == "interrupted"
    assert (run / "bag" / "metadata.yaml").exists()
    assert not [pid for pid in nodes.values() if alive(pid)]


def test_a_launcher_that_is_killed_takes_its_nodes_along(
    command_line: CommandLine, spawn: Spawn, node_processes: Look, tmp_path: Path
) -> None:
    run = tmp_path / "run"
    launcher = spawn(command_line("auv_sim.cli.mission", "--out", run))
    wait_for(lambda: under_way(run), "a mission under way")
    nodes = node_processes(launcher.pid)
    launcher.kill()
    wait_for(lambda: not [pid for pid in nodes.values() if alive(pid)], "the nodes to leave")


BAD = {
    "no such mission": (["--mission", "nowhere"], "nowhere: found no such mission file"),
    "no such vehicle": (["--vehicle", "nowhere"], "nowhere: found no such vehicle file"),
    "no such parameters": (["--params", "nowhere"], "nowhere: found no such parameter file"),
    "a current that is not a number": (["--current", "nan", "0"], "argument --current: found nan"),
    "half a current": (["--current", "1"], "argument --current: expected 2 arguments"),
    "time backwards": (["--speed", "-1"], "argument --speed: found -1, expected a number greater than 0"),
    "an unknown switching": (["--switching", "never"], "argument --switching: invalid choice: 'never'"),
    "an unknown option": (["--bogus"], "unrecognized arguments: --bogus"),
    "a bad namespace": (["--namespace", "9x"], "argument --namespace: found '9x'"),
    "a bad domain": (["--domain", "999"], "argument --domain: found '999'"),
    "the simulator's speed without it": (
        ["--no-sim", "--speed", "2"],
        "--speed: found together with --no-sim",
    ),
    "a clock without a reader": (["--use-sim-time"], "--use-sim-time: found without --no-sim"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_one_line_and_exit_code_2_with_nothing_written(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments, expected = BAD[case]
    try:
        code = main(arguments)
    except SystemExit as stop:
        code = int(stop.code or 0)
    captured = capsys.readouterr()
    assert code == 2
    assert expected in captured.err
    assert captured.err.count("\n") == 1
    assert captured.out == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("named", ["home", "-1", "233", "1.5"])
def test_a_ros_domain_that_is_none_is_found_before_anything_is_made(
    named: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("ROS_DOMAIN_ID", named)
    assert main(["--no-sim"]) == 2
    err = capsys.readouterr().err
    assert err == f"ROS_DOMAIN_ID: found '{named}', expected a ROS domain from 0 to 232\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("named", "number"), [(None, 0), ("", 0), ("7", 7)])
def test_a_vehicles_ros_domain_is_the_shells(
    named: str | None, number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    if named is not None:
        monkeypatch.setenv("ROS_DOMAIN_ID", named)
    with launcher.domain_of(mission_plan.make(Options(no_sim=True), tmp_path)) as found:
        assert found == number
    simulated = mission_plan.make(Options(), tmp_path)
    with launcher.domain_of(simulated, nodes_are_launched=True) as found:
        assert found == number
    monkeypatch.setattr(domains, "free_domain", lambda: contextlib.nullcontext(99))
    with launcher.domain_of(simulated) as found:
        assert found == 99


def test_a_plan_is_flown_and_leaves_a_mission_file_that_flies_the_same(
    tmp_path: Path, domain: int, capsys: pytest.CaptureFixture[str]
) -> None:
    places = [(59.9, 10.6), (59.9002, 10.6)]
    items = [{"command": 16, "frame": 3, "params": [0, 0, 0, 0, *place, 5]} for place in places]
    (tmp_path / "pier.plan").write_text(json.dumps({"fileType": "Plan", "mission": {"items": items}}))
    run = tmp_path / "run"
    asked = [
        "--mission",
        str(tmp_path / "pier.plan"),
        "--out",
        str(run),
        "--domain",
        str(domain),
        "--composed",
    ]
    assert main(asked) == 0
    said = capsys.readouterr().out
    assert "notice pier.plan is not a mission file; assumed: straight legs" in said
    assert "notice pier.plan: altitudes (5 m) not taken" in said
    flown = mission_file.load(str(run / "config" / "mission.yaml"))
    assert flown.path.length == pytest.approx(22.3, abs=0.1)
    assert flown.speed == 1.5


def test_a_name_is_no_markup(
    short_mission: Path, tmp_path: Path, domain: int, capsys: pytest.CaptureFixture[str]
) -> None:
    named = tmp_path / "named.yaml"
    named.write_text(short_mission.read_text().replace("name: short", "name: leg [/m] at 2 [m/s]"))
    out = tmp_path / "run [m]"
    assert main(["--mission", str(named), "--out", str(out), "--domain", str(domain), "--composed"]) == 0
    said = capsys.readouterr().out
    assert said.count("leg [/m] at 2 [m/s]: ") == 2
    assert str(out / "overview.png") in said


def test_a_directory_that_exists_is_never_written_to(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "precious").write_text("do not lose")
    assert main(["--out", str(tmp_path)]) == 2
    assert "which exists, expected a new directory" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["precious"]


def test_a_mission_that_asks_for_more_thrust_than_the_vehicle_has_is_refused(
    short_mission: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = tmp_path / "wrong.yaml"
    wrong.write_text(short_mission.read_text().replace("thrust: 6.48", "thrust: 7"))
    assert main(["--mission", str(wrong), "--out", str(tmp_path / "run")]) == 2
    assert "thrust: found 7 N, expected at most 6.48 N" in capsys.readouterr().err
