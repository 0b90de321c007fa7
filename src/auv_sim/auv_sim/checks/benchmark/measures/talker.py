"""Publishes a Float64 fifty times a second on each of many topics, for a recorder to record."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from rclpy.clock import Clock, ClockType

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.contract.wire import Float64
from auv_msgs_py.node.run import run_nodes
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.parameters import NodeParameters

RATE = 50.0
NAME = "talker"


class TalkerNode(SuiteNode):
    """Publishes on ``talk_0``, ``talk_1``, ..."""

    number = 1

    def __init__(self) -> None:
        super().__init__(NAME, NodeParameters)
        self._outputs = [
            self.advertise(Topic(f"talk_{k}", topics.RUDDER_STATE.type, NAME)) for k in range(self.number)
        ]
        self.create_timer(1.0 / RATE, self._talk, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def _talk(self) -> None:
        for publisher in self._outputs:
            publisher.publish(Float64(1.0))


def main(argv: Sequence[str]) -> int:
    """Run; the first argument is the number of topics, the rest goes to ROS."""
    TalkerNode.number = int(argv[0])
    return run_nodes([TalkerNode], list(argv[1:]))


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
