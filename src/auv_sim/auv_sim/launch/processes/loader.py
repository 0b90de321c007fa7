"""Imports the libraries of all nodes of a mission, forks one process for each node, and ends.

Five interpreters that import the same libraries take most of a mission's start-up. The forked processes share
what is loaded here; each of them only imports rclpy. That is not loaded here: its tracing library starts
threads, and a process with threads must not fork. If there is a thread nevertheless, a node's process starts
an interpreter of its own.

The launcher (`adopted.Loader`) starts this module and exchanges lines of JSON with it:

- standard input: the order (`Order`), then the byte that opens the gate of each node
  (`auv_msgs_py.node.start_gate.OPEN`);
- standard output: node name -> process id, then a byte from each node that waits at its gate.

When this process ends, the nodes become children of the launcher, which is their subreaper.
"""

from __future__ import annotations

import contextlib
import ctypes
import gc
import importlib
import inspect
import json
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from auv_msgs_py.node.start_gate import GATE
from auv_sim.launch.processes.kin import end_with_parent

#: Modules without rclpy that nodes import, in the order of their weight.
LOADED = (
    "auv_path_following.missions.mission_file",
    "auv_path_following.parameters",
    "auv_path_following.control.reference_watch",
    "auv_sim.sim_parameters",
    "auv_sim.vehicle.simulated",
    "auv_sim.bags.writing.bag_writer",
    "auv_msgs_py.contract.conversions",
    "auv_msgs_py.contract.wire",
    "diagnostic_msgs.msg",
    "rosgraph_msgs.msg",
    "sensor_msgs.msg",
    "std_msgs.msg",
    "rcl_interfaces.msg",
    "rcl_interfaces.srv",
    "std_srvs.srv",
    "type_description_interfaces.srv",
    "rosidl_generator_py",
)


class Order(NamedTuple):
    """The launcher's order.

    Attributes:
        environment: variables for all nodes.
        nodes: (name, module, arguments, log file) of each.
    """

    environment: dict[str, str]
    nodes: list[tuple[str, str, list[str], str]]


def load() -> None:
    """Import the nodes' common libraries, and fill the caches that their first steps would fill."""
    for module in LOADED:
        importlib.import_module(module)
    definitions = importlib.import_module("auv_sim.bags.definitions")
    definitions.typestore()
    inspect.getmodule(sys._getframe())  # rclpy's loggers use it for the caller: 60 ms the first time
    gc.collect()
    gc.freeze()


def main() -> int:
    """Load, read the order and fork. Return in each node's process, with the node's exit code."""
    launcher = os.getppid()
    _end_with(launcher)
    load()
    line = _read_line()
    if not line:  # the launcher has given up
        return 0
    order = Order(*json.loads(line))
    loader, ids = os.getpid(), {}
    has_threads = len(list(Path("/proc/self/task").iterdir())) > 1
    for name, module, arguments, log in order.nodes:
        pid = os.fork()
        if pid == 0:
            os.setsid()  # Ctrl-C reaches only the launcher
            while os.getppid() == loader:
                time.sleep(0.001)
            _end_with(launcher)
            report = _write_to(log)
            os.environ.update(order.environment, **{GATE: str(report)})
            return _run(module, arguments, has_threads)
        ids[name] = pid
    os.write(sys.stdout.fileno(), json.dumps(ids).encode() + b"\n")
    os._exit(0)  # at once: the nodes wait for it


def _read_line() -> bytes:
    """Read standard input up to the end of a line and no further: what follows is for the nodes."""
    line = b""
    while not line.endswith(b"\n") and (byte := os.read(sys.stdin.fileno(), 1)):
        line += byte
    return line


def _end_with(parent: int) -> None:
    """End this process with its parent, or at once if that has ended."""
    end_with_parent()
    if os.getppid() != parent:
        raise SystemExit(1)


def _write_to(log: str) -> int:
    """Redirect standard output and error to a file; return a descriptor of the former standard output."""
    before = os.dup(sys.stdout.fileno())
    os.set_inheritable(before, True)
    with Path(log).open("wb") as stream:
        os.dup2(stream.fileno(), sys.stdout.fileno())
        os.dup2(stream.fileno(), sys.stderr.fileno())
    return before


def _run(module: str, arguments: Sequence[str], anew: bool) -> int:
    """Run `python -m module arguments`, in a new interpreter if `anew`; return the exit code."""
    command = [sys.executable, "-m", module, *arguments]
    if anew:
        os.execv(command[0], command)  # noqa: S606 - our own interpreter, our own modules
    sys.argv = [module, *arguments]
    _show(command)
    code: int = importlib.import_module(module).main(arguments)
    return code


def _show(command: Sequence[str]) -> None:
    """Show this command in `ps` and /proc/self/cmdline, as far as it fits in the loader's."""
    with contextlib.suppress(OSError, ValueError):
        numbers = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
        begin, end = int(numbers[45]), int(numbers[46])  # arg_start, arg_end: fields 48 and 49 of proc(5)
        text = "\0".join(command).encode()[: end - begin - 1]
        ctypes.memmove(begin, text.ljust(end - begin, b"\0"), end - begin)


if __name__ == "__main__":
    raise SystemExit(main())
