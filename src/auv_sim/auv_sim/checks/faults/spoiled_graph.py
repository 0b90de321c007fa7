"""A flying graph to spoil: the suite's nodes as processes, the simulator and the relay in this one."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import Trigger

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import StopRequest
from auv_msgs_py.values.errors import SuiteError
from auv_sim.checks.faults.fault_row import Flight
from auv_sim.checks.faults.graph_listener import GraphListener
from auv_sim.checks.faults.graph_processes import KINDS, NAMESPACE, GraphProcesses, StartPose
from auv_sim.checks.patience import PATIENCE
from auv_sim.nodes.fault_relay import FaultRelay, raw
from auv_sim.nodes.pacing import Pacer
from auv_sim.nodes.plant_node import RemusPlantNode


class GraphFailed(SuiteError):
    """Something that has nothing to do with a fault did not happen."""


class AnsweredPacer(Pacer):
    """Steps at `speed` times real time while odometry is answered, and otherwise in real time.

    The simulator thus never outruns the nodes on a slow machine.

    Args:
        step: ROS time of a step, s.
        speed: times real time, at least 1.
        answers: returns how many answers have come so far.
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


def _plant_and_relay(
    speed: float, start: StartPose, flight: Flight, sea: Path
) -> tuple[RemusPlantNode, FaultRelay]:
    """Make the simulator, whose outputs go through the relay, and the relay."""
    kind = KINDS[flight]
    words = [w for name in kind.relayed for w in ("-r", f"{name}:={raw(name)}")]
    values: dict[str, Any] = {"speed": speed, "vehicle": kind.vehicle}
    values |= {"initial.x": start.x, "initial.y": start.y, "initial.psi": start.psi}
    values |= {"initial.depth": start.depth} | ({"sea": str(sea)} if flight == "bottom" else {})
    overrides = [Parameter(name, value=value) for name, value in values.items()]
    shared: dict[str, Any] = {"namespace": NAMESPACE, "use_global_arguments": False}
    plant = RemusPlantNode(parameter_overrides=overrides, cli_args=["--ros-args", *words], **shared)
    forwards = [Parameter("use_sim_time", value=True), Parameter("topics", value=kind.relay)]
    relay = FaultRelay(parameter_overrides=forwards, **shared)
    assert plant.free_run is not None
    plant.free_run.pacer = AnsweredPacer(plant.parameters.step, speed, lambda: relay.passed["rudder_cmd"])
    return plant, relay


class SpoiledFlight:
    """The simulator, the relay and a listener in this process; time is the simulator's.

    Args:
        nodes: the processes.
        speed: of the simulator, times real time.
        start: pose of the vehicle.
        flight: its kind.
        sea: file of the sea, for a flight above the bottom.
        own_plant: False: the simulator is a process too (so that it can be killed), and there is no relay.
    """

    def __init__(
        self,
        nodes: GraphProcesses,
        speed: float,
        start: StartPose,
        flight: Flight = "plane",
        sea: Path = Path("sea.yaml"),
        own_plant: bool = True,
    ) -> None:
        self.nodes = nodes
        rclpy.init(
            args=[],
            domain_id=int(os.environ["ROS_DOMAIN_ID"]),
            signal_handler_options=SignalHandlerOptions.NO,
        )
        # A KeyboardInterrupt inside a callback would be taken for the callback's own error.
        self._stop = StopRequest()
        self.executor = EventsExecutor()
        self.node = Node("fault_matrix", namespace=NAMESPACE, start_parameter_services=False)
        self.plant: RemusPlantNode | None = None
        self.relay: FaultRelay | None = None
        made: list[Any] = [self.node]
        if own_plant:
            self.plant, self.relay = _plant_and_relay(speed, start, flight, sea)
            made += [self.plant, self.relay]
        for node in made:
            self.executor.add_node(node)
        self.graph = GraphListener(self.node, relayed=own_plant)
        self._start = self.node.create_client(Trigger, topics.START_SERVICE)
        self._abort = self.node.create_client(Trigger, topics.ABORT_SERVICE)

    @property
    def is_stopped(self) -> bool:
        """Whether the vehicle's fins and thrust are commanded to 0."""
        assert self.plant is not None
        return not any(self.plant.command)

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
        """Let ROS time pass, s."""
        end = self.now + seconds
        self.until(lambda: self.now >= end, f"{seconds:g} s of ROS time")

    def call(self, service: str) -> str:
        """Call `start` or `abort`; return why it was refused, empty if it was accepted."""
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
