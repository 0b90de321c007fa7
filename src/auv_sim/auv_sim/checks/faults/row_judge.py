"""Judges one row of the fault matrix: noticed and stopped in time, and what becomes of the mission."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, field

from auv_msgs_py.contract import topics
from auv_sim.checks.faults.fault_row import Expectation
from auv_sim.checks.faults.spoiled_graph import SpoiledFlight

#: Tolerated retreat of the path parameter: the virtual point may wait for the vehicle.
_BACK = 0.1
#: After a fault the mission goes on within this, s of ROS time: the gate accepts a new position after 3 s.
_RECOVERY = 6.0
#: Of a difference of stamps, s.
_ROUNDING = 1e-6
#: A node has reported "just now" within this, s of wall time.
_JUST_NOW = 1.0
#: Largest depth at the end of an ascent, m.
_AT_SURFACE = 1.5


@dataclass
class RowResult:
    """What happened in one row.

    Attributes:
        row: what was expected.
        noticed: time until /diagnostics named it, s; NaN if it did not.
        safe: time until the vehicle was stopped, s; NaN if it was not.
        wrong: every deviation from what was expected, a line each.
    """

    row: Expectation
    noticed: float = math.nan
    safe: float = math.nan
    wrong: list[str] = field(default_factory=list)

    @property
    def good(self) -> bool:
        """Whether nothing was wrong."""
        return not self.wrong

    @property
    def is_late(self) -> bool:
        """Whether a bound of the table was exceeded; a good row keeps it with the machine's allowance."""
        row = self.row
        return self.noticed > row.within + _ROUNDING or 0 < row.safe < self.safe - _ROUNDING


def as_data(result: RowResult) -> dict[str, object]:
    """Return a result for JSON; NaN becomes null."""
    seconds = {name: getattr(result, name) for name in ("noticed", "safe")}
    return {
        "name": result.row.name,
        "good": result.good,
        **{f"{name}_s": None if math.isnan(v) else round(v, 3) for name, v in seconds.items()},
        "expected": result.row._asdict(),
        "wrong": result.wrong,
    }


class RowJudge:
    """Judges rows of one flight.

    Args:
        flight: the flight.
        machine: what a busy machine may add to every bound, s of ROS time.
    """

    def __init__(self, flight: SpoiledFlight, machine: float) -> None:
        self._flight, self._machine = flight, machine

    def judge_fault(self, row: Expectation, result: RowResult) -> None:
        """Judge whether the fault was noticed and the vehicle stopped in time."""
        within = row.within if row.wall else row.within + self._machine
        if row.noticed_by and not result.noticed <= within:
            when = "never" if math.isnan(result.noticed) else f"after {result.noticed:.2f} s"
            result.wrong.append(f"'{row.says}' by {row.noticed_by} {when}, at most {within:.2f} s")
        if row.safe and not result.safe <= row.safe + self._machine:
            when = "never" if math.isnan(result.safe) else f"after {result.safe:.2f} s"
            result.wrong.append(f"stopped {when}, at most {row.safe + self._machine:.2f} s")
        # A flood takes processor time: a node that is late because of it may be stopped until it is over.
        if not row.safe and row.fault != "flood" and not math.isnan(result.safe):
            result.wrong.append(f"stopped after {result.safe:.2f} s, though it need not be")

    def judge_outcome(self, row: Expectation, result: RowResult) -> None:
        """Judge whether the mission goes on, or has ended, as expected."""
        flight = self._flight
        if row.outcome == "aborts":
            if flight.graph.state != "aborted":
                result.wrong.append(f"the mission is {flight.graph.state}, not aborted")
            if row.surfaces:
                self._judge_depth(result)
            return
        if row.outcome == "waits":
            self._judge_waiting(row, result)
            return
        if row.fault == "kill":
            flight.until(lambda: self._reports(row.place), f"{row.name}: back")
        begin, recovery = flight.now, _RECOVERY + self._machine

        def goes_on() -> bool:
            assert flight.plant is not None
            return flight.graph.state == "running" and flight.plant.command.thrust > 0.0

        flight.until(lambda: goes_on() or flight.now - begin > recovery, f"{row.name}: to go on")
        if not goes_on():
            result.wrong.append(
                f"the mission is {flight.graph.state} and does not go on within {recovery:.1f} s"
            )
        if flight.graph.s < flight.graph.farthest - _BACK:
            result.wrong.append(
                f"the path parameter went back from {flight.graph.farthest:.2f} to {flight.graph.s:.2f}"
            )

    def _judge_depth(self, result: RowResult) -> None:
        """Judge whether the vehicle is at the surface."""
        assert self._flight.plant is not None
        depth = self._flight.plant.simulated.motion.z
        if not depth < _AT_SURFACE:
            result.wrong.append(f"the vehicle is {depth:.1f} m deep, at most {_AT_SURFACE:g} m")

    def _judge_waiting(self, row: Expectation, result: RowResult) -> None:
        """Judge a guidance that was started again: it has no running mission, and the vehicle stays put."""
        flight = self._flight
        flight.until(lambda: flight.graph.state == "idle" and self._reports(row.place), f"{row.name}: back")
        flight.pass_time(2.0)
        if not flight.is_stopped:
            result.wrong.append("the vehicle moves though no mission was started")

    def _reports(self, name: str) -> bool:
        """Whether a killed node has reported since; the recorder, which is not started again, need not."""
        if name == topics.RECORDER:
            return True
        return time.monotonic() - self._flight.graph.heard.get(name, 0.0) < _JUST_NOW
