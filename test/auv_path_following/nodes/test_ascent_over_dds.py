"""ailos_guidance of a vehicle that dives, alone, over real DDS: a mission that ends with an ascent."""

from __future__ import annotations

import itertools
import math
from typing import Any

import pytest
from rclpy.parameter import Parameter

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import SpatialNavigation, SpatialWater
from auv_path_following.nodes.guidance_node import GuidanceNode
from node_bench import Bench

#: East at 10 m; helix begins at 5 m.
HEADING = 0.5 * math.pi


def states(bench: Bench) -> list[str]:
    return [message.data for message in bench.received["mission_state"]]


def step(bench: Bench, seconds: float, z: float, has_water: bool = True) -> tuple[float, float, float]:
    """One measurement at a depth, m; desired thrust (N), pitch and yaw (rad) on the wire."""
    wanted = (topics.DESIRED_THRUST, topics.DESIRED_PITCH, topics.DESIRED_YAW)
    before = [len(bench.values(topic)) for topic in wanted]
    navigation = SpatialNavigation(0.0, 0.1 * seconds, z, 0.0, 0.01, HEADING, 0.0, 0.0)
    bench.diving(seconds, navigation, SpatialWater(1.9, 0.0, 0.0) if has_water else None)
    bench.until(lambda: all(len(bench.values(t)) > n for t, n in zip(wanted, before, strict=True)))
    thrust, pitch, yaw = (bench.values(topic)[-1] for topic in wanted)
    return thrust, pitch, yaw


def test_a_mission_that_ends_under_water_runs_until_the_vehicle_is_at_the_surface(bench: Bench) -> None:
    """By a limit, by the service, and without velocity through the water or odometry."""
    parameters: dict[str, Any] = {
        "vehicle": "remus100_6dof", "mission": "helix", "gate__enabled": False,
        "limits__max_depth": 10.5, "ascent__when": "always", "ascent__on_abort": True,
    }  # fmt: skip
    node = bench.start(GuidanceNode, **parameters)

    def hold_after(seconds: float) -> None:
        """Set when a mission without navigation holds: soon only where that is tested."""
        names = ("holding.hold_after", "holding.abort_after")
        assert node.set_parameters_atomically([Parameter(name, value=seconds) for name in names]).successful

    bench.call("start")
    assert step(bench, 1.0, 10.0)[0] == 6.48
    thrust, pitch, yaw = step(bench, 1.1, 10.6)
    assert (thrust, yaw) == (6.48, pytest.approx(0.0))  # the heading is kept
    assert pitch == pytest.approx(-math.radians(20.0))  # REP-103: bow up is negative
    bench.until(lambda: bench.diagnosed("running: surfacing: limit max_depth: 10.6 m, at most 10.5 m"))
    assert not {"holding", "aborted"} & set(states(bench))
    assert step(bench, 1.2, 9.0, has_water=False)[0] == 6.48
    thrust, pitch, _ = step(bench, 1.3, 0.7)
    assert (thrust, pitch) == (0.0, 0.0)
    bench.until(lambda: states(bench)[-1] == "aborted")
    bench.until(lambda: bench.diagnosed("aborted: limit max_depth: 10.6 m"))

    bench.call("start")
    step(bench, 2.0, 9.0)
    asked = bench.call("abort")
    assert (asked.success, asked.message) == (True, "surfacing: abort was called")
    assert step(bench, 2.1, 9.0)[0] == 6.48
    assert bench.call("abort").message == "abort was called"
    assert step(bench, 2.2, 9.0) == (0.0, 0.0, pytest.approx(0.0))

    bench.call("start")
    step(bench, 3.0, 9.0)
    step(bench, 3.1, 10.6)
    bench.received["mission_state"].clear()
    hold_after(0.5)
    bench.until(lambda: states(bench)[-1:] == ["aborted"])  # without odometry: not held
    assert "holding" not in states(bench)
    bench.until(lambda: bench.diagnosed("aborted: limit max_depth"))

    stamps = itertools.count(4.0, 0.05)

    def ascends() -> bool:
        """Send odometry alone: the mission holds, and then it ascends."""
        if states(bench)[-1:] == ["aborted"]:  # at first, and where odometry was out for too long
            bench.call("start")
            step(bench, next(stamps), 9.0)
            bench.received["mission_state"].clear()
        step(bench, next(stamps), 9.0, has_water=False)
        return bench.diagnosed("running: surfacing: held for more than 0.5 s")

    bench.until(ascends)
    bench.until(lambda: "running" in states(bench)[states(bench).index("holding") :])
