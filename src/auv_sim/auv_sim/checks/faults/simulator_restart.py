"""The simulator killed and started again: with it dies the clock, so this row has a graph of its own."""

from __future__ import annotations

import math
import time
from pathlib import Path

from diagnostic_msgs.msg import DiagnosticStatus

from auv_msgs_py.contract import topics
from auv_path_following.missions import mission_file
from auv_sim.checks.faults.expectations import Expectation
from auv_sim.checks.faults.matrix import MISSION, RowResult
from auv_sim.checks.faults.spoiled_graph import GraphFailed, Nodes, SpoiledFlight, says


def kill_simulator(row: Expectation, directory: Path, speed: float) -> RowResult:
    """The simulator is killed and started again: time stands still, and begins anew."""
    directory.mkdir(parents=True, exist_ok=True)
    mission = directory / "mission.yaml"
    mission.write_text(MISSION, encoding="utf-8")
    x, y, psi = mission_file.load(str(mission)).path.start_pose
    plant = {"speed": str(speed), "initial.x": str(x), "initial.y": str(y), "initial.psi": str(psi)}
    nodes = Nodes(directory / "log", mission, {topics.PLANT: plant}, relayed=False)
    names = (topics.OBSERVER, topics.AUTOPILOT, topics.GUIDANCE, topics.PLANT)
    for name in names:
        nodes.start(name)
    flight = SpoiledFlight(nodes, speed, (x, y, psi), own_plant=False)
    result = RowResult(row)
    try:
        flight.until(lambda: set(names) <= set(flight.said), "all nodes to report")
        flight.call(topics.START_SERVICE)
        flight.until(lambda: flight.thrust_cmd > 0.0 and flight.s > 0.1, "the mission to run")
        nodes.kill(topics.PLANT)
        begin = time.monotonic()
        noticed: dict[str, float] = {}

        def look(name: str, status: DiagnosticStatus) -> None:
            if says(status, row.says):
                noticed.setdefault(name, time.monotonic() - begin)

        flight.on_diagnostics = look
        others = {topics.OBSERVER, topics.AUTOPILOT, topics.GUIDANCE}
        flight.until(lambda: others <= set(noticed) or time.monotonic() - begin > 3 * row.within, row.name)
        result.noticed = max((noticed.get(name, math.inf) for name in others), default=math.inf)
        if not result.noticed <= row.within + 2.0:
            result.wrong.append(f"noticed by {', '.join(noticed) or 'nobody'} only")
        nodes.start(topics.PLANT)
        flight.thrust_cmd, flight.s = 0.0, 1.0
        flight.until(lambda: flight.thrust_cmd > 0.0 and 0.0 < flight.s < 1.0, "the mission to go on")
        result.wrong += [f"{name} ended" for name in nodes.crashed()]
    except GraphFailed as error:
        result.wrong.append(str(error))
    finally:
        flight.close()
        nodes.stop()
    return result
