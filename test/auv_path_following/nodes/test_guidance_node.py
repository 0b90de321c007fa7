"""ailos_guidance by itself, over real DDS."""

from __future__ import annotations

import math
from typing import Any

import pytest

from auv_msgs_py import topics
from auv_msgs_py.types import Navigation
from auv_path_following.nodes.guidance_node import GuidanceNode
from node_bench import Bench


def test_guidance_asks_for_nothing_before_the_start_and_for_thrust_after_it(bench: Bench) -> None:
    bench.start(GuidanceNode)
    bench.until(lambda: [m.data for m in bench.received["mission_state"]] == ["idle"])
    bench.until(lambda: len(bench.received["path"]) == 1)
    bench.water(1.0, 1.9)
    bench.odometry(1.0, Navigation(-20.0, 20.0, 0.5, 0.0))
    bench.until(lambda: bench.values(topics.DESIRED_THRUST))
    assert bench.values(topics.DESIRED_THRUST) == [0.0]
    assert bench.values(topics.DESIRED_YAW) == pytest.approx([math.pi / 2 - 0.5])
    assert bench.call("start").success
    again = bench.call("start")
    assert (again.success, again.message) == (False, "already running")
    bench.water(1.1, 1.9)
    bench.odometry(1.1, Navigation(-19.9, 20.1, math.pi / 4, 0.0))
    bench.until(lambda: len(bench.values(topics.DESIRED_THRUST)) == 2)
    assert bench.values(topics.DESIRED_THRUST)[1] == 6.48
    assert bench.call("abort").success
    bench.until(lambda: [m.data for m in bench.received["mission_state"]][-1] == "aborted")
    assert bench.call("start").success


@pytest.mark.parametrize(("east", "turn"), [(5.0, +1.0), (-5.0, -1.0)])
def test_guidance_steers_back_from_either_side(bench: Bench, tmp_path: Any, east: float, turn: float) -> None:
    """Seen on the wire: right of a northward path the desired yaw is larger than north's."""
    mission = tmp_path / "north.yaml"
    mission.write_text(
        "version: 1\nname: north\nframe: ned\nthrust: 6\n"
        "segments: [{line: {start: [0, 0], length: 100, course_deg: 0}}]\n"
    )
    bench.start(GuidanceNode, mission=str(mission))
    bench.call("start")
    bench.water(1.0, 1.9)
    bench.odometry(1.0, Navigation(10.0, east, 0.0, 0.0))
    bench.until(lambda: bench.values(topics.DESIRED_YAW) and bench.received["path_error"])
    assert math.copysign(1.0, bench.values(topics.DESIRED_YAW)[0] - math.pi / 2) == turn
    assert math.copysign(1.0, bench.received["path_error"][0].vector.y) == turn


def test_guidance_holds_without_navigation_and_goes_on_with_it(bench: Bench) -> None:
    bench.start(GuidanceNode, guidance__minimum_speed=0.2, holding__hold_after=0.4)
    bench.call("start")
    bench.until(lambda: [m.data for m in bench.received["mission_state"]][-1:] == ["holding"])
    bench.water(1.0, 1.9)
    bench.odometry(1.0, Navigation(-20.0, 20.0, 0.5, 0.0))
    bench.until(lambda: [m.data for m in bench.received["mission_state"]][-1:] == ["running"])
    assert bench.values(topics.DESIRED_THRUST)[-1] == 6.48


def test_guidance_aborts_when_it_had_to_hold_for_too_long(bench: Bench) -> None:
    bench.start(GuidanceNode, holding__hold_after=0.2, holding__abort_after=0.4)
    bench.call("start")
    bench.until(lambda: [m.data for m in bench.received["mission_state"]][-1:] == ["aborted"])
