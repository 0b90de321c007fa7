"""The launch files, with a stand-in for launch: what they declare, start, include and end.

`ros2 launch` itself is no wheel; where it is installed, test_nodes_file.py has it read what the suite writes.
"""

from __future__ import annotations

import runpy
import sys
import types
from pathlib import Path
from typing import Any

import pytest

from auv_sim.launch.ros_launch import description
from auv_sim.launch.ros_launch import launch_arguments as arguments

FILES = Path(__file__).resolve().parents[4] / "src" / "auv_sim" / "launch"
#: Module of launch -> what the launch files take from it.
NAMES = {
    "launch": ("LaunchDescription",),
    "launch.actions": (
        "DeclareLaunchArgument", "ExecuteProcess", "IncludeLaunchDescription", "OpaqueFunction",
        "RegisterEventHandler", "Shutdown",
    ),
    "launch.event_handlers": ("OnProcessExit", "OnProcessIO"),
    "launch.launch_description_sources": ("AnyLaunchDescriptionSource",),
    "launch.substitutions": ("LaunchConfiguration",),
    "launch_ros": (),
    "launch_ros.substitutions": ("ExecutableInPackage",),
}  # fmt: skip


class Action:
    """Any object of launch: it keeps its arguments."""

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self.arguments, self.options = arguments, options

    def perform(self, context: Any) -> str:
        return str(context.configurations[self.arguments[0]])


class Context:
    is_shutdown = False

    def __init__(self, **configurations: str) -> None:
        self.configurations = configurations


@pytest.fixture(autouse=True)
def launch(monkeypatch: pytest.MonkeyPatch) -> None:
    for module, names in NAMES.items():
        stand_in = types.ModuleType(module)
        for name in names:
            setattr(stand_in, name, type(name, (Action,), {}))
        monkeypatch.setitem(sys.modules, module, stand_in)


def described(file: str, **values: str) -> tuple[dict[str, str], list[Any]]:
    """The arguments that a launch file declares, with their defaults, and its actions for some values."""
    whole = runpy.run_path(str(FILES / file))["generate_launch_description"]()
    *declared, begin = whole.arguments[0]
    defaults = {each.arguments[0]: each.options["default_value"] for each in declared}
    return defaults, begin.options["function"](Context(**(defaults | values)))


def command_of(actions: list[Any]) -> list[str]:
    where, *words = actions[-1].options["cmd"]
    assert where.options == {"package": "auv_sim", "executable": "mission_supervisor"}
    return words


def test_a_mission_takes_the_options_of_the_command() -> None:
    defaults, actions = described("mission.launch.py", mission="loiter", composed="true", current="0.1 0")
    assert defaults.pop("shutdown") == "true"
    assert defaults.pop("fleet") == ""
    assert defaults == {argument.name: argument.default for argument in arguments.of_mission()}
    assert command_of(actions) == ["--mission=loiter", "--current", "0.1", "0", "--composed"]


def test_a_vehicle_has_its_nodes_and_perhaps_a_recorder() -> None:
    defaults, actions = described("vehicle.launch.py", vehicle_driver="mavlink")
    assert (defaults.pop("record"), defaults.pop("on_exit")) == ("true", "report")
    assert set(defaults) == {argument.name for argument in arguments.of_vehicle()}
    assert command_of(actions) == ["--nodes-only", "--on-exit=report", "--vehicle-driver=mavlink"]
    _, actions = described("vehicle.launch.py", record="false")
    assert command_of(actions) == ["--nodes-only", "--no-recorder", "--on-exit=report"]


def test_a_fleet_is_flown_by_the_same_launch_file() -> None:
    _, actions = described("mission.launch.py", fleet="two", composed="true")
    assert command_of(actions) == ["--composed", "--fleet=two"]


def handlers(file: str, **values: str) -> tuple[Any, Any]:
    on_output, on_exit, supervisor = described(file, **values)[1]
    for registered in (on_output, on_exit):
        assert registered.arguments[0].options["target_action"] is supervisor
    return on_output.arguments[0].options["on_stdout"], on_exit.arguments[0].options["on_exit"]


def output(text: str) -> types.SimpleNamespace:
    return types.SimpleNamespace(text=text.encode())


def ended(code: int) -> types.SimpleNamespace:
    return types.SimpleNamespace(returncode=code)


def test_the_nodes_start_once_the_supervisor_asks() -> None:
    on_output, _ = handlers("mission.launch.py")
    assert on_output(output("figure_of_eight: 8 subpaths\nnodes to lau")) == []
    (include,) = on_output(output("nch: /a b/nodes.launch.xml\nmore"))
    assert include.arguments[0].arguments == ("/a b/nodes.launch.xml",)
    assert on_output(output("nodes to launch: /other.xml\n")) == []


def test_the_end_of_a_mission_ends_everything_and_a_failure_is_one() -> None:
    on_output, on_exit = handlers("mission.launch.py")
    on_output(output("nodes to launch: /nodes.launch.xml\n"))
    assert [type(action).__name__ for action in on_exit(ended(0), Context())] == ["Shutdown"]
    with pytest.raises(description.SupervisorFailed, match="ended with code 1"):
        on_exit(ended(1), Context())
    stopping = Context()
    stopping.is_shutdown = True  # Ctrl-C: launch ends on its own
    assert on_exit(ended(130), stopping) == []
    on_output, on_exit = handlers("mission.launch.py", shutdown="false")
    on_output(output("nodes to launch: /nodes.launch.xml\n"))
    assert on_exit(ended(1), Context()) == []


def test_a_vehicle_s_nodes_go_on_without_the_supervisor_but_do_not_start_without_it() -> None:
    on_output, on_exit = handlers("vehicle.launch.py")
    with pytest.raises(description.SupervisorFailed, match="ended with code 2"):
        on_exit(ended(2), Context())
    on_output(output("nodes to launch: /nodes.launch.xml\n"))
    assert on_exit(ended(1), Context()) == []


def test_a_vehicle_s_launch_ends_with_a_node_if_that_is_asked_for() -> None:
    on_output, on_exit = handlers("vehicle.launch.py", on_exit="shutdown")
    on_output(output("nodes to launch: /nodes.launch.xml\n"))
    with pytest.raises(description.SupervisorFailed, match="ended with code 1"):
        on_exit(ended(1), Context())
