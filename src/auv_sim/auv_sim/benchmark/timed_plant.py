"""The simulator with a stopwatch: after so many steps it reports, and takes no further one."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from auv_msgs_py import topics
from auv_msgs_py.runtime import run_nodes
from auv_sim.benchmark.stopwatch import Stopwatch
from auv_sim.mission import composed
from auv_sim.nodes.plant_node import RemusPlantNode


class TimedPlantNode(RemusPlantNode):
    """remus_plant itself; `watch` decides how far it goes."""

    watch = Stopwatch(0)

    def publish_step(self) -> None:
        self.watch.step()
        if not self.watch.finished:
            super().publish_step()

    def waiting_for(self) -> str:
        return "" if self.watch.finished else super().waiting_for()


def main(argv: Sequence[str]) -> int:
    """STEPS, then the ROS arguments of remus_plant alone, or one JSON object as for `mission.composed`."""
    TimedPlantNode.watch = Stopwatch(int(argv[0]))
    if argv[1].startswith("{"):
        here = f"{TimedPlantNode.__module__}:{TimedPlantNode.__name__}"
        return composed.main(argv[1:], {**composed.NODES, topics.PLANT: here})
    return run_nodes([TimedPlantNode], argv[1:])


if __name__ == "__main__":
    # Under its own name, so that there is one TimedPlantNode however it is imported.
    from auv_sim.benchmark import timed_plant

    raise SystemExit(timed_plant.main(sys.argv[1:]))
