"""What the nodes say while they start: nothing false, in the log or in /diagnostics."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import pytest
import rclpy

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.types import Navigation
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from node_bench import NORTHWARD, Bench

#: diagnostic_msgs/msg/DiagnosticStatus.
OK = b"\x00"


def _levels(bench: Bench, node: SuiteNode) -> list[bytes]:
    arrays = bench.received[topics.DIAGNOSTICS.name]
    return [s.level for array in arrays for s in array.status if s.hardware_id == node.get_name()]


@pytest.mark.parametrize("make", [CurrentObserverNode, GuidanceNode, HeadingAutopilotNode])
def test_a_node_that_has_had_no_odometry_is_not_ok(bench: Bench, make: Callable[..., SuiteNode]) -> None:
    node = bench.start(make)
    bench.until(lambda: bench.diagnosed("no odom yet"))
    stamps = itertools.count(1.0, 0.1)

    def is_ok_while_odometry_flows() -> bool:
        t = next(stamps)
        bench.odometry(t, Navigation(1.9 * t, 0.0, 0.0, 0.0))
        bench.spin(0.1)
        levels = _levels(bench, node)
        return bool(levels) and levels[-1] == OK

    bench.until(is_ok_while_odometry_flows)


@pytest.mark.parametrize("make", [CurrentObserverNode, GuidanceNode])
def test_the_first_odometry_may_come_before_the_first_velocity_through_water(
    bench: Bench, make: Callable[..., SuiteNode], capfd: pytest.CaptureFixture[str]
) -> None:
    """Nothing is late yet; after `water_velocity_timeout` it is."""
    bench.start(make, water_velocity_timeout=0.5)
    if make is GuidanceNode:
        bench.call("start")
    bench.odometry(1.0, NORTHWARD)
    bench.spin(0.1)
    bench.measurement(1.1, Navigation(0.1, 0.0, 0.0, 0.0), 1.9, ("map", "base_link"))
    bench.spin(0.1)
    assert "WARN" not in capfd.readouterr().err
    bench.odometry(1.7, Navigation(0.7, 0.0, 0.0, 0.0))
    bench.until(lambda: bench.diagnosed("no fresh velocity_through_water"))


def test_a_second_publisher_of_a_topic_is_named(bench: Bench) -> None:
    node = bench.start(CurrentObserverNode)
    stranger = rclpy.create_node("stranger", namespace="/auv")
    stranger.create_publisher(qos.message_class(topics.ODOM.type), "odom", 10)
    conditions = {"condition publishers": "odom is published by /auv/bench, /auv/stranger"}
    arrays = bench.received[topics.DIAGNOSTICS.name]
    bench.until(
        lambda: any(
            conditions.items() <= {pair.key: pair.value for pair in status.values}.items()
            for array in arrays for status in array.status if status.hardware_id == node.get_name()
        )
    )  # fmt: skip
    stranger.destroy_node()
