"""The launch file of a mission's nodes: the launcher's arguments and variables, in launch's own syntax."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path
from xml.etree import ElementTree

import pytest

from auv_msgs_py.node.start_gate import pass_gate
from auv_sim.launch import launcher, mission_plan
from auv_sim.launch.fleet import fleet_launcher, fleet_plan
from auv_sim.launch.options import Options
from auv_sim.launch.processes.process_group import Children
from auv_sim.launch.ros_launch.nodes_file import FILE, NodesFile, launch_file


def unescaped(text: str) -> str:
    """What launch's parser makes of a text without a substitution."""
    assert not re.search(r"(?<!\\)(\\\\)*\$", text)
    return re.sub(r"\\(.)", r"\1", text)


class Order:
    """A loader that keeps what it is given."""

    def fork(self, environment, nodes):  # type: ignore[no-untyped-def]
        self.nodes = nodes
        return {}


def started(directory: Path, starter: object, **options: object) -> None:
    plan = mission_plan.make(Options(mission="figure_of_eight", **options), directory)  # type: ignore[arg-type]
    children = Children(directory / "log", {"ROS_DOMAIN_ID": "7"})
    (directory / "config").mkdir(exist_ok=True)
    launcher.start_nodes(plan, children, starter, directory / "config" / "params.yaml")  # type: ignore[arg-type]


@pytest.mark.parametrize("composed", [False, True])
def test_the_nodes_get_what_the_launcher_gives_them(tmp_path: Path, composed: bool) -> None:
    directory = tmp_path / "an odd $(name) \\ '"
    directory.mkdir()
    order = Order()
    started(directory, order, composed=composed, namespace="/boat")
    started(directory, NodesFile(directory), composed=composed, namespace="/boat")
    elements = list(ElementTree.parse(directory / FILE).getroot())
    assert len(elements) == len(order.nodes) == (1 if composed else 5)
    for element, (name, module, arguments, _) in zip(elements, order.nodes, strict=True):
        variables = {each.get("name"): unescaped(each.get("value", "")) for each in element.findall("env")}
        assert variables == {"ROS_DOMAIN_ID": "7", "AUV_START_GATE": "passed"}
        if composed:
            assert shlex.split(unescaped(element.get("cmd", "")))[1:] == ["-m", module, *arguments]
            assert "__ns:=/boat" in json.loads(arguments[0])["recorder"]
        else:
            assert (element.get("pkg"), element.get("exec")) == (module.split(".")[0], name)
            assert ["--ros-args", *shlex.split(unescaped(element.get("ros_args", "")))] == arguments


def test_launch_itself_reads_the_file(tmp_path: Path) -> None:
    pytest.importorskip("launch_xml", reason="launch is not installed: the file is compared, not launched")
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    from launch import LaunchContext

    file = tmp_path / "nodes.launch.xml"
    file.write_text(launch_file({}, [("composed", "module", ["{\"a\": ['$(x)']}"], "log")]))
    (action,) = AnyLaunchDescriptionSource(str(file)).get_launch_description(LaunchContext()).entities
    words = [part[0].text for part in action.process_description.cmd]
    assert words[1:] == ["-m", "module", "{\"a\": ['$(x)']}"]


def test_a_node_whose_launcher_has_looked_passes_the_gate(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AUV_START_GATE", "passed")
    assert pass_gate(lambda: False)


@pytest.mark.parametrize("composed", [False, True])
@pytest.mark.parametrize("bags", ["each", "one"])
def test_a_fleet_s_processes_are_told_apart(tmp_path: Path, composed: bool, bags: str) -> None:
    """Each has its executable, and the parameter file of its vehicle by which it is found."""
    file = tmp_path / "pair.yaml"
    vehicles = "".join(f"  - {{namespace: /auv{k}, mission: loiter}}\n" for k in (1, 2))
    file.write_text(f"version: 1\nname: pair\nbags: {bags}\nvehicles:\n{vehicles}", encoding="utf-8")
    plan = fleet_plan.make(str(file), Options(composed=composed), tmp_path / "run")
    commands = fleet_launcher.commands_of(plan)
    nodes = [(name, module, words, "log") for name, (module, words) in commands.items()]
    found = NodesFile(tmp_path / "run").fork({}, nodes)
    places = {name: (process._executable, process._mark) for name, process in found.items()}
    assert len(set(places.values())) == len(places) == len(nodes)
    text = (tmp_path / "run" / FILE).read_text(encoding="utf-8")
    assert text.count('exec="fleet_clock"') == 1
    assert text.count('exec="recorder"') == (0 if composed or bags == "one" else 2)
    assert text.count('exec="heading_autopilot"') == (0 if composed else 2)
    assert text.count("fleet_recorder") == (bags == "one")
