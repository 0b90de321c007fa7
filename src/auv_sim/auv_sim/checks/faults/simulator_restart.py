"""The simulator killed and started again: the clock stops with it, so this row has a graph of its own."""

from __future__ import annotations

import math
import time
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticStatus

from auv_msgs_py.contract import topics
from auv_sim.checks.faults.fault_row import Expectation
from auv_sim.checks.faults.graph_listener import says
from auv_sim.checks.faults.graph_processes import GraphProcesses, write_mission
from auv_sim.checks.faults.row_judge import RowResult
from auv_sim.checks.faults.spoiled_graph import GraphFailed, SpoiledFlight

_CONTROLLERS = (topics.OBSERVER, topics.AUTOPILOT, topics.GUIDANCE)
#: What a busy machine may add to the bound, s of wall time.
_MACHINE = 2.0


def kill_simulator(row: Expectation, directory: Path, speed: float) -> RowResult:
    """Kill the simulator in flight and start it again: time stands still, then begins anew.

    Args:
        row: what is expected.
        directory: of the logs.
        speed: of the simulator, times real time.
    """
    mission, start = write_mission(directory)
    x, y, psi, _ = start
    plant = {"speed": str(speed), "initial.x": str(x), "initial.y": str(y), "initial.psi": str(psi)}
    nodes = GraphProcesses(directory / "log", mission, {topics.PLANT: plant}, relayed=False)
    names = (*_CONTROLLERS, topics.PLANT)
    for name in names:
        nodes.start(name)
    flight = SpoiledFlight(nodes, speed, start, own_plant=False)
    graph, result = flight.graph, RowResult(row)
    try:
        flight.until(lambda: set(names) <= set(graph.said), "all nodes to report")
        flight.call(topics.START_SERVICE)
        flight.until(lambda: graph.thrust_cmd > 0.0 and graph.s > 0.1, "the mission to run")
        nodes.kill(topics.PLANT)
        _wait_for_notice(flight, result)
        nodes.start(topics.PLANT)
        graph.thrust_cmd, graph.s = 0.0, 1.0
        flight.until(lambda: graph.thrust_cmd > 0.0 and 0.0 < graph.s < 1.0, "the mission to go on")
        result.wrong += [f"{name} ended" for name in nodes.crashed()]
    except GraphFailed as error:
        result.wrong.append(str(error))
    finally:
        flight.close()
        nodes.stop()
    return result


def _wait_for_notice(flight: SpoiledFlight, result: RowResult) -> None:
    """Wait until every controller has reported the standstill, and keep when the last one did."""
    row, begin = result.row, time.monotonic()
    noticed: dict[str, float] = {}

    def look(name: str, status: DiagnosticStatus) -> None:
        if says(status, row.says):
            noticed.setdefault(name, time.monotonic() - begin)

    flight.graph.on_diagnostics = look
    flight.until(
        lambda: set(_CONTROLLERS) <= set(noticed) or time.monotonic() - begin > 3 * row.within, row.name
    )
    result.noticed = max(noticed.get(name, math.inf) for name in _CONTROLLERS)
    if not result.noticed <= row.within + _MACHINE:
        result.wrong.append(f"noticed by {', '.join(noticed) or 'no node'} only")
