"""Launch arguments: the options of `scripts/mission.py`, under their own names. Standard library only.

`ros2` may run on an interpreter that lacks this suite's libraries. So a launch file only turns its arguments
into the command line of the executable `mission_supervisor`, which reads and checks everything else.
"""

from __future__ import annotations

import argparse
import shlex
from collections.abc import Mapping
from typing import NamedTuple

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.cli.mission import parser_of_one

#: What `mission_supervisor` prints before the name of the nodes' launch file once they may enter the graph.
READY = "nodes to launch: "
#: Options that apply to a real or an emulated vehicle.
_OF_VEHICLE = (
    "mission", "vehicle", "controller_model", "params", "switching", "vehicle_driver", "vehicle_address",
    "use_sim_time", "display", "out", "namespace", "domain", "force", "start_at",
)  # fmt: skip
#: What vehicle.launch.py does when a node has ended: values of its argument `on_exit`.
REPORT, SHUTDOWN = "report", "shutdown"
#: Name of the argument that flies a fleet.
FLEET = "fleet"


class Argument(NamedTuple):
    """One launch argument.

    Attributes:
        name: of the argument; the option has dashes in place of underscores.
        help: the option's.
        is_flag: whether it is true or false rather than a value.
        is_list: whether it has several values, separated by spaces.
    """

    name: str
    help: str
    is_flag: bool
    is_list: bool

    @property
    def default(self) -> str:
        """The argument's default; empty stands for the option's own."""
        return "false" if self.is_flag else ""

    def option(self, value: str) -> list[str]:
        """Return the words of the command line; none for the default.

        Raises:
            ConfigurationError: a flag is neither true nor false.
        """
        word = f"--{self.name.replace('_', '-')}"
        if self.is_flag:
            return [word] if is_true(self.name, value) else []
        if not value.strip():
            return []
        # A value that begins with a dash (a negative number) is not taken for an option.
        return [word, *shlex.split(value)] if self.is_list else [f"{word}={value}"]


def is_true(name: str, value: str) -> bool:
    """Return a flag's value.

    Raises:
        ConfigurationError: it is neither true nor false.
    """
    if value.lower() not in ("true", "false"):
        raise ConfigurationError(f"{name}:={value}", f"'{value}'", "true or false")
    return value.lower() == "true"


def of_mission() -> tuple[Argument, ...]:
    """Return the arguments of one mission: every option of `scripts/mission.py`."""
    shown = [action for action in parser_of_one().actions if action.help != argparse.SUPPRESS]
    # The mission is an option and a word; the word has its help.
    texts = {action.dest: action.help or "" for action in shown}
    return tuple(
        Argument(action.dest, texts[action.dest], action.nargs == 0, isinstance(action.nargs, int))
        for action in shown
        if action.option_strings and action.dest != "help"
    )


def of_mission_or_fleet() -> tuple[Argument, ...]:
    """Return the arguments of mission.launch.py: those of a mission, and the fleet's file."""
    text = "several vehicles from a fleet's file, or the name of a shipped one, in place of a mission"
    return (*of_mission(), Argument(FLEET, text, False, False))


def of_vehicle() -> tuple[Argument, ...]:
    """Return the arguments of vehicle.launch.py: the options that concern the nodes and a driver."""
    return tuple(argument for argument in of_mission() if argument.name in _OF_VEHICLE)


def command_line(arguments: tuple[Argument, ...], values: Mapping[str, str]) -> list[str]:
    """Return the options for values of launch arguments.

    Raises:
        ConfigurationError: a flag is neither true nor false.
    """
    return [word for argument in arguments for word in argument.option(values[argument.name])]
