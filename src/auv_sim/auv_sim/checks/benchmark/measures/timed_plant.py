"""The simulator under measurement: remus_plant itself with a stopwatch."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from auv_msgs_py.contract import topics
from auv_msgs_py.node.run import run_nodes
from auv_sim.checks.benchmark.measures.stopwatch import LatencyWatch, Stopwatch
from auv_sim.launch import composed
from auv_sim.nodes.plant_node import RemusPlantNode


class TimedPlantNode(RemusPlantNode):
    """Lockstep: takes no further step when the watch is done."""

    watch = Stopwatch(0)

    def publish_step(self) -> None:
        self.watch.step()
        if not self.watch.finished:
            super().publish_step()


class LatencyPlantNode(RemusPlantNode):
    """Free running: measures how long commands take."""

    watch = LatencyWatch(0)

    def publish_step(self) -> None:
        self.watch.sent()
        super().publish_step()

    def take_command(self, topic: str, value: float) -> None:
        if topic == topics.RUDDER_CMD.name:
            self.watch.answered()
        super().take_command(topic, value)


def main(argv: Sequence[str]) -> int:
    """Run; the arguments: `lockstep` or `latency`, steps, then those of remus_plant or `launch.composed`."""
    kind, steps, *rest = argv
    if kind == "latency":
        LatencyPlantNode.watch = LatencyWatch(int(steps))
        return run_nodes([LatencyPlantNode], rest)
    TimedPlantNode.watch = Stopwatch(int(steps))
    if rest[0].startswith("{"):
        here = f"{TimedPlantNode.__module__}:{TimedPlantNode.__name__}"
        return composed.main(rest, {**composed.NODES, topics.PLANT: here})
    return run_nodes([TimedPlantNode], rest)


if __name__ == "__main__":
    # Under its own name, so that there is one TimedPlantNode however it is imported.
    from auv_sim.checks.benchmark.measures import timed_plant

    raise SystemExit(timed_plant.main(sys.argv[1:]))
