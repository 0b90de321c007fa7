"""The suite's nodes as processes that can be killed and started again."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_path_following import config_files
from auv_sim.launch.composed import NODES
from auv_sim.launch.options import DEFAULT_PARAMS
from auv_sim.nodes.fault_relay import RELAYED, raw

NAMESPACE = "/auv"
#: exec keeps what prctl set: the node ends with this process, however it ends. A hook between fork and exec
#: is not safe in a process with DDS threads.
_ENDS_WITH_PARENT = (
    "import ctypes, os, sys; ctypes.CDLL(None).prctl(1, 9); os.execv(sys.argv[1], sys.argv[1:])"
)


class GraphProcesses:
    """The suite's nodes, one process each.

    Args:
        directory: of their logs.
        mission: mission file.
        parameters: node name -> parameter -> value, as text.
        relayed: whether their outputs go through the relay.
    """

    def __init__(
        self,
        directory: Path,
        mission: Path,
        parameters: dict[str, dict[str, str]],
        relayed: bool = True,
    ) -> None:
        self._relayed = relayed
        self.directory = directory
        self._mission, self._parameters = mission, parameters
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self.killed: set[int] = set()
        directory.mkdir(parents=True, exist_ok=True)

    def start(self, name: str) -> None:
        """Start a node, with its outputs remapped to the relay."""
        values = {"use_sim_time": "true", **self._parameters.get(name, {})}
        if name == topics.GUIDANCE:
            values["mission"] = str(self._mission)
        # The gains that are flown by default: Table 4's do not come back to the path from everywhere.
        params = config_files.find("params", DEFAULT_PARAMS)
        words = ["-r", f"__ns:={NAMESPACE}", "--params-file", str(params)]
        for topic in RELAYED.values():
            if self._relayed and topic.publisher == name:
                words += ["-r", f"{topic.name}:={raw(topic.name)}"]
        for key, value in values.items():
            words += ["-p", f"{key}:={value}"]
        module = NODES[name].split(":")[0]
        command = [sys.executable, "-m", module, "--ros-args", *words]
        with (self.directory / f"{name}.log").open("ab") as log:
            self._processes[name] = subprocess.Popen(  # noqa: S603 - our own interpreter, our own modules
                [sys.executable, "-S", "-c", _ENDS_WITH_PARENT, *command],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip

    def kill(self, name: str) -> None:
        """Kill a node with SIGKILL."""
        process = self._processes.pop(name)
        self.killed.add(process.pid)
        process.send_signal(signal.SIGKILL)
        process.wait()

    @property
    def ids(self) -> dict[str, int]:
        """Name of each running node -> process id."""
        return {name: process.pid for name, process in self._processes.items()}

    def crashed(self) -> list[str]:
        """Return the nodes that ended and were not killed."""
        return [name for name, process in self._processes.items() if process.poll() is not None]

    def stop(self) -> None:
        """Stop all nodes, the recorder last."""
        for name in sorted(self._processes, key=lambda name: name == topics.RECORDER):
            process = self._processes.pop(name)
            process.send_signal(signal.SIGINT)
            try:
                process.wait(15.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
