"""A mission under the supervisor, with this test in the place of `ros2 launch`."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import pytest

from auv_sim.launch.outcome import MissionFailed
from auv_sim.launch.processes.process_group import Children
from auv_sim.launch.ros_launch.launch_arguments import READY
from auv_sim.launch.ros_launch.supervisor import _report_ended


def launched(file: Path, spawn: Callable[..., subprocess.Popen[str]]) -> subprocess.Popen[str]:
    """Start the one process of a composed mission, as launch would."""
    (element,) = ElementTree.parse(file).getroot()
    variables = [f"{each.get('name')}={each.get('value')}" for each in element.findall("env")]
    return spawn(["env", *variables, *shlex.split(element.get("cmd", ""))])


def test_it_flies_a_mission_whose_nodes_another_process_starts(
    spawn: Callable[..., subprocess.Popen[str]],
    command_line: Callable[..., list[str]],
    short_mission: Path,
    tmp_path: Path,
    domain: int,
) -> None:
    run = tmp_path / "run"
    module = "auv_sim.launch.ros_launch.supervisor"
    supervisor = spawn(command_line(module, short_mission, "--composed", "--out", run))
    assert supervisor.stdout is not None
    said = ""
    while READY not in said:
        line = supervisor.stdout.readline()
        assert line, said
        said += line
    assert f"ROS domain {domain}, namespace /auv" in said  # that of the environment, not one of its own
    nodes = launched(Path(said.rpartition(READY)[2].strip()), spawn)
    table, errors = supervisor.communicate(timeout=180)
    assert supervisor.returncode == 0, errors
    assert "short: complete" in table
    assert nodes.wait(180.0) == 0  # stopped by the supervisor, after the recorder has closed the bag
    assert json.loads((run / "summary.json").read_text())["outcome"] == "complete"
    assert (run / "bag" / "metadata.yaml").is_file() and (run / "overview.png").is_file()
    assert re.search(r"messages of \d+ topics, 0 dropped", nodes.communicate()[0])


def test_it_refuses_as_the_command_does(
    spawn: Callable[..., subprocess.Popen[str]], command_line: Callable[..., list[str]], tmp_path: Path
) -> None:
    module = "auv_sim.launch.ros_launch.supervisor"
    supervisor = spawn(command_line(module, "no_such", "--nodes-only", "--out", tmp_path / "run"))
    output, errors = supervisor.communicate(timeout=180)
    assert (supervisor.returncode, output, errors.count("\n")) == (2, "", 1)
    assert errors.startswith("no_such: found no such mission file")
    assert not (tmp_path / "run").exists()


def test_it_refuses_for_a_fleet_what_its_file_holds(
    spawn: Callable[..., subprocess.Popen[str]], command_line: Callable[..., list[str]], tmp_path: Path
) -> None:
    module = "auv_sim.launch.ros_launch.supervisor"
    supervisor = spawn(command_line(module, "--fleet", "two", "--depth", "3", "--out", tmp_path / "run"))
    output, errors = supervisor.communicate(timeout=180)
    assert (supervisor.returncode, output) == (2, "")
    assert errors.startswith("--depth: found together with --fleet, expected it in the fleet's file")
    assert not (tmp_path / "run").exists()


def test_a_node_that_has_ended_is_reported_once_or_ends_all(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    children = Children(tmp_path, {})
    children.start("recorder", "no_such_module", [])
    (child,) = children
    child.process.wait(180.0)
    reported: set[str] = set()
    for _ in range(3):
        _report_ended(children, reported, ends=False)
    said = capsys.readouterr().err
    assert said.count("recorder ended with code 1; its last lines") == 1
    assert "No module named no_such_module" in said
    assert said.endswith("the other nodes go on\n")
    with pytest.raises(MissionFailed, match="recorder ended with code 1"):
        _report_ended(children, set(), ends=True)
