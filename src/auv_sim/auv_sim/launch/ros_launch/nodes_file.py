"""The nodes of one mission as a launch file, `config/nodes.launch.xml` of the run directory.

`mission_supervisor` writes it from its plan and `ros2 launch` starts what it names, so that `ros2 launch`
needs no library of this suite.
"""

from __future__ import annotations

import json
import shlex
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

from auv_msgs_py.contract import topics
from auv_msgs_py.node.start_gate import GATE, PASSED
from auv_msgs_py.settings.result_files import write_text
from auv_sim.command_line import say
from auv_sim.launch.composed import NODES
from auv_sim.launch.processes.launched import Launched
from auv_sim.launch.ros_launch.launch_arguments import READY

#: Module of a node -> its executable, in the package of the module.
_EXECUTABLES = {place.split(":")[0]: name for name, place in NODES.items()}
_EXECUTABLES["auv_sim.nodes.fleet.fleet_clock_node"] = topics.FLEET_CLOCK
FILE = Path("config") / "nodes.launch.xml"


class NodesFile:
    """Hands a mission's nodes over to `ros2 launch`, in place of a `Loader`.

    Args:
        directory: the run directory.
    """

    def __init__(self, directory: Path) -> None:
        self._file = directory / FILE

    def fork(
        self, environment: Mapping[str, str], nodes: Sequence[tuple[str, str, Sequence[str], str]]
    ) -> Mapping[str, Launched]:
        """Write the file; return the processes that will exist, by name.

        Args:
            environment: variables for all of them.
            nodes: (name, module, arguments, log file) of each; `ros2 launch` has logs of its own.

        Raises:
            NotWritten: the file cannot be written.
        """
        write_text(self._file, launch_file(environment, nodes))
        return {
            name: Launched(_executable_of(module, arguments) or module, _parameters_of(arguments))
            for name, module, arguments, _ in nodes
        }

    def at_gate(self) -> bool:
        """Return True: the nodes load after the look at the graph."""
        return True

    def open_gate(self) -> None:
        """Have `ros2 launch` start the nodes."""
        say(f"{READY}{self._file}")


def launch_file(environment: Mapping[str, str], nodes: Sequence[tuple[str, str, Sequence[str], str]]) -> str:
    """Return the launch file for nodes, with the arguments and variables that the launcher gives them.

    The nodes do not examine the graph, because the supervisor has done so and holds a claim.

    Args:
        environment: variables for all of them.
        nodes: (name, module, arguments, log file) of each.
    """
    root = ElementTree.Element("launch")
    for _, module, arguments, _ in nodes:
        if name := _executable_of(module, arguments):
            package = module.split(".")[0]
            ros = arguments[arguments.index("--ros-args") + 1 :]
            attributes = {"pkg": package, "exec": name, "ros_args": _literal(shlex.join(ros))}
            element = ElementTree.SubElement(root, "node", attributes, output="screen")
        else:
            command = shlex.join([sys.executable, "-m", module, *arguments])
            element = ElementTree.SubElement(root, "executable", cmd=_literal(command), output="screen")
        for variable, value in sorted({**environment, GATE: PASSED}.items()):
            ElementTree.SubElement(element, "env", name=variable, value=_literal(value))
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"


def _executable_of(module: str, arguments: Sequence[str]) -> str:
    """Return the name of a node's executable; empty for a process of several nodes."""
    return _EXECUTABLES.get(module, "") if arguments[0] == "--ros-args" else ""


def _parameters_of(arguments: Sequence[str]) -> str:
    """Return the parameter file of a process: of its first node, where it has several."""
    words: Sequence[str] = arguments
    if arguments[0] != "--ros-args":
        nodes = json.loads(arguments[0])
        words = next(iter(nodes.values() if isinstance(nodes, dict) else nodes))
    return words[words.index("--params-file") + 1]


def _literal(text: str) -> str:
    """Return text in which launch finds no substitution."""
    return text.replace("\\", "\\\\").replace("$", "\\$")
