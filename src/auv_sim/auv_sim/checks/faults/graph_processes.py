"""What the graph flies, and the suite's nodes as processes that can be killed and started again."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from auv_msgs_py.contract import topics
from auv_path_following import config_files
from auv_path_following.missions import mission_file
from auv_sim.checks.faults.fault_row import Flight
from auv_sim.launch.composed import NODES
from auv_sim.launch.options import DEFAULT_PARAMS
from auv_sim.nodes.fault_relay import RELAYED, raw
from auv_sim.sim_parameters import FaultRelayParameters

NAMESPACE = "/auv"
#: exec keeps what prctl set: the node ends with this process, however it ends. A hook between fork and exec
#: is not safe in a process with DDS threads.
_ENDS_WITH_PARENT = (
    "import ctypes, os, sys; ctypes.CDLL(None).prctl(1, 9); os.execv(sys.argv[1], sys.argv[1:])"
)


MISSION = """\
version: 1
name: fault matrix
description: figures of eight, so that a rudder or a heading that stays as it is leaves the path soon
frame: ned
thrust: 6.48
limits: {path_distance: 25, path_speed: 0.3, path_speed_window: 30}
repeat: 200
figure_of_eight: {centre: [0, 0], radius: 20, separation: 60}
"""
#: Depths of the figure of eight in quarters of its length: stern planes that stay as they are leave it.
_DEPTHS = (6.0, 12.0, 6.0, 12.0, 6.0)
_ABOVE_BOTTOM = """\
altitude: {above_bottom: 6, min: 3}
"""
_BOTTOM = """\
name: bottom
bottom: {depth: 16}
sensors:
  altimeter: {noise: {white: 0.05}}
"""


class FlightKind(NamedTuple):
    """What is spoiled.

    Attributes:
        vehicle: its file.
        relayed: topics of the vehicle that go through the relay.
        further: further topics of the relay.
    """

    vehicle: str
    relayed: tuple[str, ...] = ("odom", "velocity_through_water")
    further: tuple[str, ...] = ()

    @property
    def relay(self) -> str:
        """The topics of the relay, as its parameter has them."""
        usual: str = FaultRelayParameters().topics
        return " ".join((usual, *self.further))


_DIVES = ("desired_pitch", "desired_pitch_rate", "sternplane_cmd")
KINDS: dict[Flight, FlightKind] = {
    "plane": FlightKind("remus100"),
    "dive": FlightKind("remus100_6dof", further=_DIVES),
    "bottom": FlightKind(
        "remus100_6dof", ("odom", "velocity_through_water", "altitude"), (*_DIVES, "altitude")
    ),
}


class StartPose(NamedTuple):
    """Pose of the path's start: north, east, depth (m), psi (rad)."""

    x: float
    y: float
    psi: float
    depth: float = 0.0


def write_mission(directory: Path, flight: Flight = "plane") -> tuple[Path, StartPose]:
    """Write the mission that is spoiled, and the sea.

    Args:
        directory: made if it is not there.
        flight: its kind.

    Returns:
        The file, and the pose of its path's start.
    """
    directory.mkdir(parents=True, exist_ok=True)
    mission, text = directory / "mission.yaml", MISSION
    mission.write_text(text, encoding="utf-8")
    planar = mission_file.load(str(mission))
    x, y, psi = planar.path.start_pose
    if flight == "plane":
        return mission, StartPose(x, y, psi)
    lap = planar.path.length / 200
    knots = [[0.25 * k * lap, depth] for k, depth in enumerate(_DEPTHS)]
    text += f"depth_profile: {{knots: {knots}}}\n" if flight == "dive" else _ABOVE_BOTTOM
    mission.write_text(text, encoding="utf-8")
    (directory / "sea.yaml").write_text(_BOTTOM, encoding="utf-8")
    return mission, StartPose(x, y, psi, _DEPTHS[0])


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
