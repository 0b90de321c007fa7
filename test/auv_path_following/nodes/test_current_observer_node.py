"""current_observer alone, over real DDS."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.types import Navigation
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from node_bench import NORTHWARD, Bench


def test_the_observer_finds_the_current(bench: Bench) -> None:
    bench.start(CurrentObserverNode)
    # 1 m/s to the north through water that itself goes 0.2 m/s to the east.
    for k in range(60):
        t = 1.0 + 0.25 * k
        bench.measurement(t, Navigation(1.0 * t, 0.2 * t, 0.0, 0.0), 1.0, ("map", "base_link"))
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > k)
    last = bench.received["current_estimate"][-1]
    assert last.header.frame_id == "map"
    assert (last.vector.x, last.vector.y) == pytest.approx((0.2, 0.0), abs=1e-3)


def test_a_vehicle_that_speaks_ned_gives_the_same_estimate(bench: Bench) -> None:
    bench.start(CurrentObserverNode)
    frames = ("auv1/odom_ned", "auv1/base_link_frd")
    for k in range(60):
        t = 1.0 + 0.25 * k
        bench.measurement(t, Navigation(1.0 * t, 0.2 * t, 0.0, 0.0), 1.0, frames)
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > k)
    last = bench.received["current_estimate"][-1]
    assert (last.vector.x, last.vector.y) == pytest.approx((0.2, 0.0), abs=1e-3)


def test_unknown_frames_are_refused_with_both_names(bench: Bench) -> None:
    node = bench.start(CurrentObserverNode)
    for k in range(3):
        bench.odometry(1.0 + k, NORTHWARD, ("map", "base_link_frd"))
    bench.until(lambda: node.health.refused["odom"] == 3)
    node.health.publish()
    bench.until(lambda: bench.diagnosed("frame_id 'map' with child_frame_id 'base_link_frd'"))
    assert bench.received["current_estimate"] == []


def test_a_new_place_found_without_velocity_through_water_is_no_current(bench: Bench) -> None:
    """Accepted while the log was silent, 60 m away; two seconds later the log is back."""
    node = bench.start(CurrentObserverNode, gate__accept_after=0.3, water_velocity_timeout=0.2)
    for k in range(40):
        t = 1.0 + 0.1 * k
        bench.measurement(t, Navigation(t, 0.0, 0.0, 0.0), 1.0, ("map", "base_link"))
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > k)
    for k in range(40, 60):
        t = 1.0 + 0.1 * k
        bench.odometry(t, Navigation(t + 60.0, 0.0, 0.0, 0.0))
        bench.spin(0.02)
    bench.until(lambda: node.health.refused["odom"] > 2)
    heard = len(bench.received["current_estimate"])
    for k in range(60, 70):
        t = 1.0 + 0.1 * k
        bench.measurement(t, Navigation(t + 60.0, 0.0, 0.0, 0.0), 1.0, ("map", "base_link"))
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > heard + k - 60)
    for message in bench.received["current_estimate"][heard:]:
        assert (message.vector.x, message.vector.y) == pytest.approx((0.0, 0.0), abs=0.01)
