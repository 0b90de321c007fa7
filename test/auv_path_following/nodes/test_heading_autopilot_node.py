"""heading_autopilot by itself, over real DDS."""

from __future__ import annotations

import math
import time

import pytest

from auv_msgs_py import topics
from auv_msgs_py.types import Navigation
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from node_bench import NORTHWARD, Bench


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
def test_an_odometry_that_is_no_number_is_refused(bench: Bench, wrong: float) -> None:
    node = bench.start(HeadingAutopilotNode)
    bench.odometry(1.0, Navigation(wrong, 0.0, 0.0, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 1)
    assert bench.values(topics.RUDDER_CMD) == []


@pytest.mark.parametrize(("yaw", "side"), [(math.pi / 2 + 0.3, +1.0), (math.pi / 2 - 0.3, -1.0)])
def test_the_autopilot_turns_towards_the_desired_yaw(bench: Bench, yaw: float, side: float) -> None:
    """A larger desired yaw is to port, and so is a positive rudder."""
    bench.start(HeadingAutopilotNode)
    for k in range(10):
        bench.odometry(1.0 + 0.05 * k, NORTHWARD)
        bench.reference(yaw, 0.0, 6.0)
        bench.until(lambda k=k: len(bench.values(topics.RUDDER_CMD)) > k)
    assert math.copysign(1.0, bench.values(topics.RUDDER_CMD)[-1]) == side
    assert bench.values(topics.THRUST_CMD)[-1] == 6.0


def test_the_autopilot_answers_each_odometry_exactly_once(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode)
    for k in range(20):
        bench.odometry(1.0 + 0.05 * k, NORTHWARD)
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.until(lambda k=k: len(bench.values(topics.THRUST_CMD)) > k)
    bench.spin(0.1)
    assert len(bench.values(topics.RUDDER_CMD)) == len(bench.values(topics.THRUST_CMD)) == 20


def test_the_autopilot_stops_the_vehicle_when_guidance_falls_silent(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode, reference_timeout=0.3)
    bench.odometry(1.0, NORTHWARD)
    bench.reference(math.pi / 2, 0.0, 6.0)
    bench.until(lambda: bench.values(topics.THRUST_CMD) == [6.0])
    t = time.monotonic()
    while bench.values(topics.THRUST_CMD)[-1] != 0.0:
        bench.odometry(1.0 + time.monotonic() - t + 0.01, NORTHWARD)
        bench.spin(0.05)
        assert time.monotonic() - t < 10.0
    assert bench.values(topics.RUDDER_CMD)[-1] == 0.0
    bench.until(lambda: bench.diagnosed("guidance is silent"))


def test_the_autopilot_stops_the_vehicle_when_odometry_falls_silent(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode, odometry_timeout=0.3)
    bench.odometry(1.0, NORTHWARD)
    bench.reference(math.pi / 2, 0.0, 6.0)
    bench.until(lambda: bench.values(topics.THRUST_CMD) == [6.0])
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-1] == 0.0)
    bench.until(lambda: bench.diagnosed("no usable odom for 0.3 s: rudder and thrust are 0"))
