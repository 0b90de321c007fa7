"""The nodes of one mission as a launch file, `config/nodes.launch.xml` of the run directory.

`mission_supervisor` writes it from its plan and `ros2 launch` starts what it names, so that `ros2 launch`
needs no library of this suite.
"""

from __future__ import annotations

import shlex
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree import ElementTree

from auv_msgs_py.node.start_gate import GATE, PASSED
from auv_msgs_py.settings.result_files import write_text
from auv_sim.command_line import say
from auv_sim.launch.composed import NODES
from auv_sim.launch.processes.launched import Launched
from auv_sim.launch.ros_launch.launch_arguments import READY

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
        parameters = str(self._file.with_name("params.yaml"))
        executables = {name: name if name in NODES else module for name, module, _, _ in nodes}
        return {name: Launched(executable, parameters) for name, executable in executables.items()}

    def at_gate(self) -> bool:
        """Return True: the nodes load after the look at the graph."""
        return True

    def open_gate(self) -> None:
        """Have `ros2 launch` start the nodes."""
        say(f"{READY}{self._file}")


def launch_file(environment: Mapping[str, str], nodes: Sequence[tuple[str, str, Sequence[str], str]]) -> str:
    """Return the launch file for nodes, with the arguments and variables that the launcher gives them.

    The nodes do not look at the graph themselves, because the supervisor has, and holds a claim.

    Args:
        environment: variables for all of them.
        nodes: (name, module, arguments, log file) of each.
    """
    root = ElementTree.Element("launch")
    for name, module, arguments, _ in nodes:
        if name in NODES:
            package = NODES[name].split(".")[0]
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


def _literal(text: str) -> str:
    """Return text in which launch finds no substitution."""
    return text.replace("\\", "\\\\").replace("$", "\\$")
