"""Runs the table of expectations against a flying graph, one fault after the other, and judges."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticStatus

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import STOP
from auv_path_following.missions import mission_file
from auv_sim.bags.bag_repair import repair
from auv_sim.bags.reading.bag_reader import read_bag
from auv_sim.checks.faults.expectations import Expectation
from auv_sim.checks.faults.spoiled_graph import PATIENCE, GraphFailed, Nodes, SpoiledFlight, says
from auv_sim.vehicle.remus import PlantState

#: What a busy machine may add to every bound, s of wall time.
_MACHINE = 0.25
#: The vehicle flies undisturbed for so long before a fault, s of ROS time.
_QUIET = 1.5
#: Nearer to the virtual point than this the vehicle is on its path, m.
_ON_PATH = 2.0
#: With less rudder than this the vehicle goes straight ahead, rad.
_STRAIGHT = 0.02
#: The virtual point may wait for the vehicle by so much of a subpath, and no more.
_BACK = 0.1
#: After a fault the mission goes on within this, s of ROS time: a new place is accepted after 3 s.
_RECOVERY = 6.0

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


@dataclass
class RowResult:
    """What happened in one row.

    Attributes:
        row: what was expected.
        noticed: until /diagnostics named it, s; NaN if it did not.
        safe: until the vehicle was stopped, s; NaN if it was not.
        wrong: what was not as it has to be, a line each.
    """

    row: Expectation
    noticed: float = math.nan
    safe: float = math.nan
    wrong: list[str] = field(default_factory=list)

    @property
    def good(self) -> bool:
        """Nothing was wrong."""
        return not self.wrong


class Matrix:
    """Several faults in one graph.

    Args:
        directory: logs and bag.
        speed: of the simulator, times real time.
        tell: called with each result.
    """

    def __init__(
        self, directory: Path, speed: float, tell: Callable[[RowResult], None] = lambda _: None
    ) -> None:
        self.directory, self.speed, self.tell = directory, speed, tell
        directory.mkdir(parents=True, exist_ok=True)
        mission = directory / "mission.yaml"
        mission.write_text(MISSION, encoding="utf-8")
        self._start_pose = mission_file.load(str(mission)).path.start_pose
        self.bag = directory / "bag"
        self.nodes = Nodes(directory / "log", mission, {topics.RECORDER: {"directory": str(self.bag)}})
        self.results: list[RowResult] = []
        self._machine = _MACHINE * speed

    def run(self, rows: Sequence[Expectation]) -> list[RowResult]:
        """All rows but the simulator's; returns a result for each.

        Raises:
            GraphFailed: the graph does not come up, or does not come back.
        """
        names = (topics.RECORDER, topics.OBSERVER, topics.AUTOPILOT, topics.GUIDANCE)
        for name in names:
            self.nodes.start(name)
        self.flight = SpoiledFlight(self.nodes, self.speed, self._start_pose)
        try:
            self.flight.until(lambda: set(names) <= set(self.flight.said), "all nodes to report")
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
        flight.farthest = 0.0
        self._spoil(row)
        begin, wall = flight.now, time.monotonic()

        def look(name: str, status: DiagnosticStatus) -> None:
            if math.isnan(result.noticed) and name == row.noticed_by and says(status, row.says):
                result.noticed = time.monotonic() - wall if row.wall else flight.now - begin

        flight.on_diagnostics = look
        if row.then_abort:
            flight.call(topics.ABORT_SERVICE)
        end = begin + max(row.lasts, min(row.safe, row.lasts) + self._machine)

        def over() -> bool:
            assert flight.plant is not None
            if math.isnan(result.safe) and flight.plant.command == STOP:
                result.safe = flight.now - begin
            ended = row.outcome == "aborts" and flight.state == "aborted" and not math.isnan(result.safe)
            waited = time.monotonic() - wall > row.within if row.wall else True
            heard = math.isfinite(result.noticed) or not row.says
            return (flight.now >= end and waited) or (ended and heard)

        flight.until(over, f"{row.name}: its time", 10 * PATIENCE)
        self._judge_fault(row, result)
        self._mend(row)
        flight.on_diagnostics = lambda *_: None
        self._judge_outcome(row, result)
        for name in self.nodes.crashed():
            result.wrong.append(f"{name} ended")
        self.results.append(result)
        self.tell(result)

    def _quiet(self, row: Expectation) -> bool:
        """Fly undisturbed, and until nobody says any more what is going to be waited for."""
        flight = self.flight
        if flight.state != "running":
            self._back_to_start()
        deadline = time.monotonic() + PATIENCE
        since = flight.now
        while flight.now - since < _QUIET:
            flight.pass_time(0.1)
            assert flight.plant is not None
            said = flight.said.get(row.noticed_by)
            calm = (
                flight.state == "running" and flight.plant.command.thrust > 0.0 and flight.off_path < _ON_PATH
            )
            if row.outcome == "aborts" and not row.then_abort:  # there has to be a turn to be missed
                calm = calm and abs(flight.plant.command.rudder) < _STRAIGHT
            if flight.state == "aborted":  # late, after the row before
                self._back_to_start()
            if not calm or (said is not None and row.says and says(said, row.says)):
                since = flight.now
            if time.monotonic() > deadline:
                return False
        return True

    def _back_to_start(self) -> None:
        """Put the vehicle where the path begins; the nodes believe that after a while; start."""
        flight = self.flight
        assert flight.plant is not None
        if flight.plant.steps:
            x, y, psi = self._start_pose
            flight.plant.simulated.place(PlantState(x, y, psi, 0.0, 0.0, 0.0))
            flight.pass_time(4.0)
        flight.s = 0.0
        refused = flight.call(topics.START_SERVICE)
        if refused:
            raise GraphFailed(f"start was refused: {refused}")
        flight.until(lambda: flight.state == "running", "the mission to run")

    def _spoil(self, row: Expectation) -> None:
        if row.fault == "kill":
            self.nodes.kill(row.place)
        else:
            assert self.flight.relay is not None
            self.flight.relay.inject(row.place, row.fault, delay=row.delay)

    def _mend(self, row: Expectation) -> None:
        if row.fault != "kill":
            assert self.flight.relay is not None
            self.flight.relay.inject(row.place, "none")
        elif row.place != topics.RECORDER:
            self.nodes.start(row.place)

    def _judge_fault(self, row: Expectation, result: RowResult) -> None:
        """Noticed and safe in time?"""
        within = row.within if row.wall else row.within + self._machine
        if row.noticed_by and not result.noticed <= within:
            when = "never" if math.isnan(result.noticed) else f"after {result.noticed:.2f} s"
            result.wrong.append(f"'{row.says}' by {row.noticed_by} {when}, at most {within:.2f} s")
        if row.safe and not result.safe <= row.safe + self._machine:
            when = "never" if math.isnan(result.safe) else f"after {result.safe:.2f} s"
            result.wrong.append(f"stopped {when}, at most {row.safe + self._machine:.2f} s")
        # A flood takes processor time; who is late because of it may be stopped until it is over.
        if not row.safe and row.fault != "flood" and not math.isnan(result.safe):
            result.wrong.append(f"stopped after {result.safe:.2f} s, though it need not")

    def _judge_outcome(self, row: Expectation, result: RowResult) -> None:
        """Does the mission go on, or has it ended?"""
        flight = self.flight
        if row.outcome == "aborts":
            if flight.state != "aborted":
                result.wrong.append(f"the mission is {flight.state}, not aborted")
            return
        if row.outcome == "waits":
            self._judge_waiting(row, result)
            return
        if row.fault == "kill":
            flight.until(lambda: self._reports(row.place), f"{row.name}: back")
        begin, recovery = flight.now, _RECOVERY + self._machine

        def goes_on() -> bool:
            assert flight.plant is not None
            return flight.state == "running" and flight.plant.command.thrust > 0.0

        flight.until(lambda: goes_on() or flight.now - begin > recovery, f"{row.name}: to go on")
        if not goes_on():
            result.wrong.append(f"the mission is {flight.state} and does not go on within {recovery:.1f} s")
        if flight.s < flight.farthest - _BACK:
            result.wrong.append(f"the path parameter went back from {flight.farthest:.2f} to {flight.s:.2f}")

    def _judge_waiting(self, row: Expectation, result: RowResult) -> None:
        """A guidance that was started again knows nothing of a mission: the vehicle stays where it is."""
        flight = self.flight
        flight.until(lambda: flight.state == "idle" and self._reports(row.place), f"{row.name}: back")
        flight.pass_time(2.0)
        assert flight.plant is not None
        if flight.plant.command != STOP:
            result.wrong.append("the vehicle moves though nobody has started a mission")

    def _reports(self, name: str) -> bool:
        """Whether a killed node has reported since; of one that is not started again nobody expects it."""
        if name == topics.RECORDER:
            return True
        return time.monotonic() - self.flight.heard.get(name, 0.0) < 1.0

    def _look_at_bag(self) -> None:
        """Intact: every topic is there and nothing is damaged; after a kill, once it is repaired."""
        killed = any(result.row.place == topics.RECORDER for result in self.results)
        if killed:
            repair(self.bag)
        bag = read_bag(self.bag)
        missing = sorted({f"/auv/{topic.name}" for topic in topics.PER_STEP} - set(bag.topics))
        wrong = [*bag.notes, *(f"no {name}" for name in missing)]
        if wrong and self.results:
            last = self.results[-1]
            last.wrong += [f"bag: {text}" for text in wrong]


def as_data(result: RowResult) -> dict[str, object]:
    """For JSON: NaN becomes null."""
    seconds = {name: getattr(result, name) for name in ("noticed", "safe")}
    return {
        "name": result.row.name,
        "good": result.good,
        **{f"{name}_s": None if math.isnan(v) else round(v, 3) for name, v in seconds.items()},
        "expected": result.row._asdict(),
        "wrong": result.wrong,
    }
