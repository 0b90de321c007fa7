"""All nodes of a mission in one process, each with the ROS arguments that it would have in its own."""

from __future__ import annotations

import importlib
import json
from collections.abc import Mapping, Sequence
from functools import partial

from auv_msgs_py.contract import topics

#: Node name -> module:class.
NODES = {
    topics.RECORDER: "auv_sim.nodes.recorder_node:RecorderNode",
    topics.OBSERVER: "auv_path_following.nodes.current_observer_node:CurrentObserverNode",
    topics.GUIDANCE: "auv_path_following.nodes.guidance_node:GuidanceNode",
    topics.AUTOPILOT: "auv_path_following.nodes.heading_autopilot_node:HeadingAutopilotNode",
    topics.PLANT: "auv_sim.nodes.plant_node:RemusPlantNode",
    topics.MAVLINK_DRIVER: "auv_sim.nodes.mavlink.driver:MavlinkDriverNode",
    topics.DISPLAY: "auv_sim.nodes.display.display_node:DisplayNode",
}


def main(argv: Sequence[str], nodes: Mapping[str, str] = NODES) -> int:
    """Run the nodes named in the one argument, a JSON object of node name -> its ROS arguments."""
    from auv_msgs_py.node.run import run_nodes  # the launcher reads the table without rclpy

    requested: dict[str, list[str]] = json.loads(argv[0])
    factories = []
    for name, ros_arguments in requested.items():
        module, cls = nodes[name].split(":")
        make = getattr(importlib.import_module(module), cls)
        factories.append(partial(make, cli_args=["--ros-args", *ros_arguments], use_global_arguments=False))
    return run_nodes(factories, [])


if __name__ == "__main__":
    import sys

    raise SystemExit(main(sys.argv[1:]))
