"""The launch descriptions of mission.launch.py and vehicle.launch.py.

launch and launch_ros are imported where they are used: this module can be imported without them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from auv_sim.launch.ros_launch import launch_arguments as arguments
from auv_sim.launch.ros_launch.launch_arguments import READY, Argument

#: Time for the supervisor to judge and draw what was flown after Ctrl-C, s.
_PATIENCE = "60"


class SupervisorFailed(RuntimeError):
    """The supervisor ended with an error, which it has printed; `ros2 launch` then ends with code 1."""


def mission() -> Any:
    """Return the LaunchDescription that flies one mission, or a fleet's, and ends with it."""
    ends = Argument("shutdown", "end everything launched when the mission ends (default true)", True, False)

    def words_of(values: dict[str, str]) -> tuple[list[str], bool]:
        ends_all = arguments.is_true(ends.name, values[ends.name])
        return arguments.command_line(arguments.of_mission_or_fleet(), values), ends_all

    return _description((*arguments.of_mission_or_fleet(), ends), {ends.name: "true"}, words_of)


def vehicle() -> Any:
    """Return the LaunchDescription of a vehicle's nodes, which leaves the mission to the operator."""
    record = Argument("record", "record a bag (default true)", True, False)
    text = "when a node has ended: report it and go on (default), or shutdown: end all with code 1"
    on_exit = Argument("on_exit", text, False, False)

    def words_of(values: dict[str, str]) -> tuple[list[str], bool]:
        recorder = [] if arguments.is_true(record.name, values[record.name]) else ["--no-recorder"]
        options = arguments.command_line(arguments.of_vehicle(), values)
        ends = on_exit.option(values[on_exit.name])
        return ["--nodes-only", *recorder, *ends, *options], values[on_exit.name] == arguments.SHUTDOWN

    defaults = {record.name: "true", on_exit.name: arguments.REPORT}
    return _description((*arguments.of_vehicle(), record, on_exit), defaults, words_of)


def _description(
    table: Sequence[Argument],
    defaults: dict[str, str],
    words_of: Callable[[dict[str, str]], tuple[list[str], bool]],
) -> Any:
    """Return the description that runs the supervisor with the words that follow from the arguments."""
    from launch.actions import DeclareLaunchArgument, OpaqueFunction
    from launch.substitutions import LaunchConfiguration

    from launch import LaunchDescription

    declared = [
        DeclareLaunchArgument(
            argument.name,
            default_value=defaults.get(argument.name, argument.default),
            description=argument.help,
        )
        for argument in table
    ]

    def begin(context: Any) -> list[Any]:
        values = {each.name: str(LaunchConfiguration(each.name).perform(context)) for each in table}
        return _supervised(*words_of(values))

    return LaunchDescription([*declared, OpaqueFunction(function=begin)])


def _supervised(words: list[str], ends_all: bool) -> list[Any]:
    """Return the actions that run the supervisor, start its nodes when it asks, and end as it ends.

    Args:
        words: its command line.
        ends_all: whether its end ends everything; if not, its nodes go on without it.
    """
    from launch.actions import ExecuteProcess, RegisterEventHandler
    from launch.event_handlers import OnProcessExit, OnProcessIO
    from launch_ros.substitutions import ExecutableInPackage

    supervisor = ExecuteProcess(
        cmd=[ExecutableInPackage(package="auv_sim", executable="mission_supervisor"), *words],
        output="screen",
        output_format="{line}",
        sigterm_timeout=_PATIENCE,
    )
    started: list[str] = []
    return [
        RegisterEventHandler(OnProcessIO(target_action=supervisor, on_stdout=_when_ready(started))),
        RegisterEventHandler(OnProcessExit(target_action=supervisor, on_exit=_when_over(started, ends_all))),
        supervisor,
    ]


def _when_ready(started: list[str]) -> Callable[[Any], list[Any]]:
    """Return the handler of the supervisor's output: it includes the nodes' launch file, once."""
    from launch.actions import IncludeLaunchDescription
    from launch.launch_description_sources import AnyLaunchDescriptionSource

    text = ""

    def handler(event: Any) -> list[Any]:
        nonlocal text
        if started:
            return []
        *lines, text = (text + event.text.decode(errors="replace")).split("\n")
        for line in lines:
            if line.startswith(READY):
                started.append(line.removeprefix(READY).rstrip("\r"))
                return [IncludeLaunchDescription(AnyLaunchDescriptionSource(started[0]))]
        return []

    return handler


def _when_over(started: list[str], ends_all: bool) -> Callable[[Any, Any], list[Any]]:
    """Return the handler of the supervisor's exit."""
    from launch.actions import Shutdown

    def handler(event: Any, context: Any) -> list[Any]:
        if context.is_shutdown or (started and not ends_all):
            return []
        if event.returncode != 0:
            raise SupervisorFailed(f"mission_supervisor ended with code {event.returncode}: see above")
        return [Shutdown(reason="the mission is over")]

    return handler
