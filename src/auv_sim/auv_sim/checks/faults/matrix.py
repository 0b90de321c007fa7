"""Runs the table of expectations against a flying graph, one fault after the other, and judges."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from diagnostic_msgs.msg import DiagnosticStatus

from auv_msgs_py.contract import topics
from auv_sim.bags.bag_repair import repair
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.checks.faults.fault_row import MACHINE_DELAY, Expectation, Flight
from auv_sim.checks.faults.graph_listener import says
from auv_sim.checks.faults.graph_processes import KINDS, GraphProcesses, write_mission
from auv_sim.checks.faults.row_judge import RowJudge, RowResult
from auv_sim.checks.faults.spoiled_graph import GraphFailed, SpoiledFlight
from auv_sim.checks.patience import PATIENCE
from auv_sim.vehicle.hulls.rigid_body import body_at
from auv_sim.vehicle.remus import PlantState

#: Undisturbed flight before each fault, s of ROS time.
_QUIET = 1.5
#: Nearer to the virtual point than this the vehicle is on its path, m.
_ON_PATH = 2.0
#: With less rudder than this the vehicle goes straight ahead, rad.
_STRAIGHT = 0.02
#: Least speed through the water of a vehicle that dives, before a fault, m/s.
_UP_TO_SPEED = 1.5
#: Change of the buoyancy, N: by far more than the trim of the stern planes.
_BALLAST: dict[str, float] = {"heavy": -12.0, "light": 16.0}


class Matrix:
    """Several faults in one graph.

    Args:
        directory: logs and bag.
        speed: of the simulator, times real time.
        on_result: called with each result.
        flight: that is spoiled.
    """

    def __init__(
        self,
        directory: Path,
        speed: float,
        on_result: Callable[[RowResult], None] = lambda _: None,
        flight: Flight = "plane",
    ) -> None:
        self.directory, self.speed, self.on_result = directory, speed, on_result
        mission, self._start_pose = write_mission(directory, flight)
        self._kind, self._vehicle = flight, KINDS[flight].vehicle
        self.bag = directory / "bag"
        controllers = (topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT)
        parameters = {name: {"vehicle": self._vehicle} for name in controllers}
        parameters[topics.RECORDER] = {"directory": str(self.bag)}
        self.nodes = GraphProcesses(directory / "log", mission, parameters)
        self.results: list[RowResult] = []
        self._machine = MACHINE_DELAY * speed

    def run(self, rows: Sequence[Expectation]) -> list[RowResult]:
        """Run all rows but the simulator's; return a result for each.

        Raises:
            GraphFailed: the graph does not come up, or does not come back.
        """
        names = (topics.RECORDER, topics.OBSERVER, topics.AUTOPILOT, topics.GUIDANCE)
        for name in names:
            self.nodes.start(name)
        sea = self.directory / "sea.yaml"
        self.flight = SpoiledFlight(self.nodes, self.speed, self._start_pose, self._kind, sea)
        self._judge = RowJudge(self.flight, self._machine)
        try:
            self.flight.until(lambda: set(names) <= set(self.flight.graph.said), "all nodes to report")
            for row in rows:
                self._run(row)
        finally:
            self.flight.close()
            self.nodes.stop()
        self._look_at_bag()
        return self.results

    def _run(self, row: Expectation) -> None:
        flight, result = self.flight, RowResult(row)
        if not self._quiet(row):
            result.wrong.append("the graph was not quiet before the fault")
        flight.graph.farthest = 0.0
        self._spoil(row)
        begin, wall = flight.now, time.monotonic()

        def look(name: str, status: DiagnosticStatus) -> None:
            if math.isnan(result.noticed) and name == row.noticed_by and says(status, row.says):
                result.noticed = time.monotonic() - wall if row.wall else flight.now - begin

        flight.graph.on_diagnostics = look
        if row.then_abort:
            flight.call(topics.ABORT_SERVICE)
        end = begin + max(row.lasts, min(row.safe, row.lasts) + self._machine)

        def over() -> bool:
            if math.isnan(result.safe) and flight.is_stopped:
                result.safe = flight.now - begin
            ended = (
                row.outcome == "aborts" and flight.graph.state == "aborted" and not math.isnan(result.safe)
            )
            waited = time.monotonic() - wall > row.within if row.wall else True
            heard = math.isfinite(result.noticed) or not row.says
            return (flight.now >= end and waited) or (ended and heard)

        flight.until(over, f"{row.name}: its time", 10 * PATIENCE)
        self._judge.judge_fault(row, result)
        self._mend(row)
        flight.graph.on_diagnostics = lambda *_: None
        self._judge.judge_outcome(row, result)
        for name in self.nodes.crashed():
            result.wrong.append(f"{name} ended")
        self.results.append(result)
        self.on_result(result)

    def _quiet(self, row: Expectation) -> bool:
        """Fly undisturbed until the expected diagnostic has cleared; return False if it does not in time."""
        flight = self.flight
        if flight.graph.state != "running":
            self._back_to_start()
        deadline = time.monotonic() + PATIENCE
        since = flight.now
        while flight.now - since < _QUIET:
            flight.pass_time(0.1)
            assert flight.plant is not None
            said = flight.graph.said.get(row.noticed_by)
            calm = (
                flight.graph.state == "running"
                and flight.plant.command.thrust > 0.0
                and flight.graph.off_path < _ON_PATH
            )
            if row.flight != "plane":  # it has come up to speed
                calm = calm and flight.plant.simulated.motion.ur > _UP_TO_SPEED
            turns = row.flight == "plane" and row.outcome == "aborts" and not row.then_abort
            if turns:  # its next turn must be missed
                calm = calm and abs(flight.plant.command.rudder) < _STRAIGHT
            if flight.graph.state == "aborted":  # late, after the row before
                self._back_to_start()
            if not calm or (said is not None and row.says and says(said, row.says)):
                since = flight.now
            if time.monotonic() > deadline:
                return False
        return True

    def _back_to_start(self) -> None:
        """Put the vehicle at the path's start, wait until the nodes accept that position, and start."""
        flight = self.flight
        assert flight.plant is not None
        if flight.plant.steps:
            x, y, psi, z = self._start_pose
            still: Any = PlantState(x, y, psi, 0.0, 0.0, 0.0)
            if self._kind != "plane":
                still = body_at(x, y, z, 0.0, 0.0, psi, 0.0)
            flight.plant.simulated.place(still)
            flight.pass_time(4.0)
        flight.graph.s = 0.0
        refused = flight.call(topics.START_SERVICE)
        if refused:
            raise GraphFailed(f"start was refused: {refused}")
        flight.until(lambda: flight.graph.state == "running", "the mission to run")

    def _spoil(self, row: Expectation) -> None:
        assert self.flight.relay is not None and self.flight.plant is not None
        if row.also:
            self.flight.relay.inject(row.also, "stop")
        if row.fault == "kill":
            self.nodes.kill(row.place)
        elif row.fault in _BALLAST:
            self.flight.plant.simulated.ballast(_BALLAST[row.fault])
        else:
            self.flight.relay.inject(row.place, row.fault, delay=row.delay)  # type: ignore[arg-type]

    def _mend(self, row: Expectation) -> None:
        assert self.flight.relay is not None and self.flight.plant is not None
        if row.also:
            self.flight.relay.inject(row.also, "none")
        if row.fault in _BALLAST:
            self.flight.plant.simulated.ballast(-_BALLAST[row.fault])
        elif row.fault != "kill":
            self.flight.relay.inject(row.place, "none")
        elif row.place != topics.RECORDER:
            self.nodes.start(row.place)

    def _look_at_bag(self) -> None:
        """Check the recording, after a kill once it is repaired: every topic, nothing damaged."""
        killed = any(result.row.place == topics.RECORDER for result in self.results)
        if killed:
            repair(self.bag)
        bag = read_bag(self.bag)
        missing = sorted({f"/auv/{topic.name}" for topic in topics.PER_STEP} - set(bag.topics))
        wrong = [*bag.notes, *(f"no {name}" for name in missing)]
        if wrong and self.results:
            last = self.results[-1]
            last.wrong += [f"bag: {text}" for text in wrong]
