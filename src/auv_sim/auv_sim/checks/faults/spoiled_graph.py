"""A flying graph to spoil: the suite's nodes as processes, the simulator and the relay in this one."""

from __future__ import annotations

import contextlib
import math
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Vector3Stamped
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.node.run import StopRequest
from auv_msgs_py.node.transport import decoder
from auv_msgs_py.values.errors import MessageRefused, SuiteError
from auv_path_following import config_files
from auv_sim.launch.composed import NODES
from auv_sim.launch.options import DEFAULT_PARAMS
from auv_sim.nodes.fault_relay import RELAYED, FaultRelay, raw
from auv_sim.nodes.pacing import Pacer
from auv_sim.nodes.plant_node import RemusPlantNode

NAMESPACE = "/auv"
#: Wall time for anything that has to happen at all, s.
PATIENCE = 60.0
#: exec keeps what prctl set: the node ends with this process, however it ends. (A hook that runs between fork
#: and exec would do, were there no DDS threads in this process.)
_ENDS_WITH_PARENT = (
    "import ctypes, os, sys; ctypes.CDLL(None).prctl(1, 9); os.execv(sys.argv[1], sys.argv[1:])"
)


class GraphFailed(SuiteError):
    """Something that has nothing to do with a fault did not happen."""


class AnsweredPacer(Pacer):
    """Steps at `speed` times real time while odometry is answered, and otherwise in real time.

    So the nodes are never outrun by a simulator that is faster than this machine lets them be.

    Args:
        step: ROS time of a step, s.
        speed: times real time, at least 1.
        answers: how many answers have come so far.
    """

    def __init__(self, step: float, speed: float, answers: Callable[[], int]) -> None:
        super().__init__(step / speed)
        self._step, self._answers = step, answers
        self._seen, self._last = -1, 0.0

    def due(self, now: float) -> bool:
        answers = self._answers()
        if answers == self._seen and now - self._last < self._step:
            self.restart(now)
            return False
        if not super().due(now):
            return False
        self._seen, self._last = answers, now
        return True


class Nodes:
    """The suite's nodes, one process each, which can be killed and started again.

    Args:
        directory: their logs go there, and the bag.
        mission: mission file.
        parameters: node name -> parameter -> value, as text.
        relayed: whether they speak to the relay.
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
        """Start one, with its outputs remapped to the relay."""
        told = {"use_sim_time": "true", **self._parameters.get(name, {})}
        if name == topics.GUIDANCE:
            told["mission"] = str(self._mission)
        # The gains that are flown by default: Table 4's do not come back to the path from everywhere.
        params = config_files.find("params", DEFAULT_PARAMS)
        words = ["-r", f"__ns:={NAMESPACE}", "--params-file", str(params)]
        for topic in RELAYED.values():
            if self._relayed and topic.publisher == name:
                words += ["-r", f"{topic.name}:={raw(topic.name)}"]
        for key, value in told.items():
            words += ["-p", f"{key}:={value}"]
        module = NODES[name].split(":")[0]
        command = [sys.executable, "-m", module, "--ros-args", *words]
        with (self.directory / f"{name}.log").open("ab") as log:
            self._processes[name] = subprocess.Popen(  # noqa: S603 - our own interpreter, our own modules
                [sys.executable, "-S", "-c", _ENDS_WITH_PARENT, *command],
                stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
            )  # fmt: skip

    def kill(self, name: str) -> None:
        """With -9."""
        process = self._processes.pop(name)
        self.killed.add(process.pid)
        process.send_signal(signal.SIGKILL)
        process.wait()

    @property
    def ids(self) -> dict[str, int]:
        """Name -> process id."""
        return {name: process.pid for name, process in self._processes.items()}

    def crashed(self) -> list[str]:
        """The nodes that ended and were not killed."""
        return [name for name, process in self._processes.items() if process.poll() is not None]

    def stop(self) -> None:
        """All of them, the recorder last."""
        for name in sorted(self._processes, key=lambda name: name == topics.RECORDER):
            process = self._processes.pop(name)
            process.send_signal(signal.SIGINT)
            try:
                process.wait(15.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


class SpoiledFlight:
    """The simulator, the relay and a listener in this process; time is the simulator's.

    Args:
        nodes: the processes.
        mission: mission file.
        speed: how many times real time.
        start: pose of the vehicle (north, east in m, psi in rad).
        own_plant: False: the simulator is a process too (so that it can be killed), and there is no relay.
    """

    def __init__(
        self, nodes: Nodes, speed: float, start: tuple[float, float, float], own_plant: bool = True
    ) -> None:
        self.nodes = nodes
        rclpy.init(
            args=[],
            domain_id=int(os.environ["ROS_DOMAIN_ID"]),
            signal_handler_options=SignalHandlerOptions.NO,
        )
        # In the middle of a callback Ctrl-C would be a callback's mistake.
        self._stop = StopRequest()
        self.executor = EventsExecutor()
        self.node = Node("fault_matrix", namespace=NAMESPACE, start_parameter_services=False)
        self.plant: RemusPlantNode | None = None
        self.relay: FaultRelay | None = None
        self.state, self.s, self.thrust_cmd = "", 0.0, 0.0
        #: Distance from the virtual point, m.
        self.off_path = 0.0
        #: The largest path parameter since it was last set to 0.
        self.farthest = 0.0
        self.said: dict[str, DiagnosticStatus] = {}
        self.heard: dict[str, float] = {}
        self.on_diagnostics: Callable[[str, DiagnosticStatus], None] = lambda *_: None
        made: list[Any] = [self.node]
        if own_plant:
            words = [w for name in ("odom", "velocity_through_water") for w in ("-r", f"{name}:={raw(name)}")]
            values = {
                "speed": speed, "initial.x": start[0], "initial.y": start[1], "initial.psi": start[2],
            }  # fmt: skip
            overrides = [Parameter(name, value=value) for name, value in values.items()]
            shared: dict[str, Any] = {"namespace": NAMESPACE, "use_global_arguments": False}
            self.plant = RemusPlantNode(
                parameter_overrides=overrides, cli_args=["--ros-args", *words], **shared
            )
            sim_time = [Parameter("use_sim_time", value=True)]
            self.relay = FaultRelay(parameter_overrides=sim_time, **shared)
            made += [self.plant, self.relay]
            relay = self.relay
            self.plant.pacer = AnsweredPacer(
                self.plant.parameters.step, speed, lambda: relay.passed["rudder_cmd"]
            )
        for node in made:
            self.executor.add_node(node)
        state = raw("mission_state") if own_plant else "mission_state"
        self._listen(topics.DIAGNOSTICS, topics.DIAGNOSTICS.name, DiagnosticArray, self._on_diagnostics)
        self._listen(topics.MISSION_STATE, state, String, self._on_state)
        self._listen(topics.PATH_PARAMETER, "path_parameter", Float64, self._on_s)
        self._listen(topics.THRUST_CMD, "thrust_cmd", Float64, self._on_thrust)
        self._listen(topics.PATH_ERROR, "path_error", Vector3Stamped, self._on_error)
        self._start = self.node.create_client(Trigger, topics.START_SERVICE)
        self._abort = self.node.create_client(Trigger, topics.ABORT_SERVICE)

    def _listen(self, topic: topics.Topic, name: str, kind: type[Any], callback: Any) -> None:
        decode = decoder(topic)

        def guarded(data: bytes) -> None:
            with contextlib.suppress(MessageRefused):
                callback(decode(data))

        self.node.create_subscription(kind, name, guarded, qos.requested(topic, topic.latched), raw=True)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            self.said[status.hardware_id] = status
            self.heard[status.hardware_id] = time.monotonic()
            self.on_diagnostics(status.hardware_id, status)

    def _on_state(self, message: String) -> None:
        self.state = message.data

    def _on_s(self, message: Float64) -> None:
        self.s = message.data
        self.farthest = max(self.farthest, self.s)

    def _on_error(self, message: Vector3Stamped) -> None:
        self.off_path = math.hypot(message.vector.x, message.vector.y)

    def _on_thrust(self, message: Float64) -> None:
        self.thrust_cmd = message.data

    @property
    def now(self) -> float:
        """ROS time, s."""
        assert self.plant is not None
        return self.plant.stamp * 1e-9

    def until(self, condition: Callable[[], Any], what: str, patience: float = PATIENCE) -> None:
        """Let time pass until a condition holds.

        Raises:
            GraphFailed: it does not within `patience` s of wall time.
            KeyboardInterrupt: a signal came.
        """
        deadline = time.monotonic() + patience
        while not condition():
            self.check_stop()
            if time.monotonic() > deadline:
                crashed = ", ".join(self.nodes.crashed())
                raise GraphFailed(
                    f"{what}: not within {patience:g} s" + (f" ({crashed} ended)" * bool(crashed))
                )
            self.executor.spin_once(timeout_sec=0.02)

    def check_stop(self) -> None:
        """Raise KeyboardInterrupt if a signal came."""
        if self._stop.requested:
            raise KeyboardInterrupt

    def pass_time(self, seconds: float) -> None:
        """So much ROS time."""
        end = self.now + seconds
        self.until(lambda: self.now >= end, f"{seconds:g} s of ROS time")

    def call(self, service: str) -> str:
        """`start` or `abort`; an empty answer means that it was taken."""
        client = self._start if service == topics.START_SERVICE else self._abort
        self.until(client.service_is_ready, f"the service {service}")
        future = client.call_async(Trigger.Request())
        self.until(future.done, f"an answer of {service}")
        return "" if future.result().success else str(future.result().message)

    def close(self) -> None:
        """Leave the graph."""
        self._stop.withdraw()
        for node in (self.plant, self.relay, self.node):
            if node is not None:
                node.destroy_node()
        rclpy.try_shutdown()


def says(status: DiagnosticStatus, text: str) -> bool:
    """Whether a report of something wrong has this text."""
    if status.level == DiagnosticStatus.OK:
        return False
    told = [pair.value for pair in status.values if pair.key.startswith("condition")]
    return any(text in line for line in (status.message, *told))
