"""ailos_guidance alone, over real DDS."""

from __future__ import annotations

import itertools
import math
import time
from typing import Any

import pytest

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.types import Navigation
from auv_path_following.nodes.guidance_node import GuidanceNode
from node_bench import Bench


def test_guidance_asks_for_nothing_before_the_start_and_for_thrust_after_it(bench: Bench) -> None:
    bench.start(GuidanceNode)
    bench.until_newest(topics.MISSION_STATE, lambda state: state.data == "idle")
    bench.until_newest(topics.PATH, lambda path: path.poses)
    bench.water(1.0, 1.9)
    bench.odometry(1.0, Navigation(-20.0, 20.0, 0.5, 0.0))
    bench.until(lambda: bench.values(topics.DESIRED_THRUST) and bench.values(topics.DESIRED_YAW))
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
    bench.until_newest(topics.MISSION_STATE, lambda state: state.data == "aborted")
    assert bench.call("start").success


@pytest.mark.parametrize(("east", "turn"), [(2.5, +1.0), (-2.5, -1.0)])
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
    bench.odometry(1.0, Navigation(0.0, east, 0.0, 0.0))
    bench.until(lambda: bench.values(topics.DESIRED_YAW) and bench.received["path_error"])
    assert math.copysign(1.0, bench.values(topics.DESIRED_YAW)[0] - math.pi / 2) == turn
    assert math.copysign(1.0, bench.received["path_error"][0].vector.y) == turn


def test_guidance_holds_without_navigation_and_goes_on_with_it(bench: Bench) -> None:
    bench.start(GuidanceNode, guidance__minimum_speed=0.2, holding__hold_after=0.4)
    bench.call("start")
    bench.until(lambda: was_in(bench, "running", "holding"))
    bench.water(1.0, 1.9)
    bench.odometry(1.0, Navigation(-20.0, 20.0, 0.5, 0.0))
    bench.until(lambda: was_in(bench, "running", "holding", "running"))
    bench.until(lambda: bench.values(topics.DESIRED_THRUST)[-1:] == [6.48])


def test_guidance_aborts_when_it_had_to_hold_for_too_long(bench: Bench) -> None:
    bench.start(GuidanceNode, holding__hold_after=0.2, holding__abort_after=0.4)
    bench.call("start")
    bench.until_newest(topics.MISSION_STATE, lambda state: state.data == "aborted")


NORTH = (
    "version: 1\nname: north\nframe: ned\nthrust: 6\nlimits: {path_distance: 20}\n"
    "segments: [{line: {start: [0, 0], length: 100, course_deg: 0}}]\n"
)


def states(bench: Bench) -> list[str]:
    return [message.data for message in bench.received["mission_state"]]


def was_in(bench: Bench, *words: str) -> bool:
    """Whether the mission was in these states, one after the other; each is published more than once."""
    changes = [word for word, _ in itertools.groupby(states(bench))]
    return any(changes[k : k + len(words)] == list(words) for k in range(len(changes)))


def fly_north(bench: Bench, tmp_path: Any, **parameters: Any) -> Any:
    """A started mission that has flown the first five metres."""
    mission = tmp_path / "north.yaml"
    mission.write_text(NORTH)
    node = bench.start(GuidanceNode, mission=str(mission), **parameters)
    bench.call("start")
    for k in range(26):
        step(bench, 1.0 + 0.1 * k, 0.2 * k)
    return node


def step(bench: Bench, seconds: float, north: float, east: float = 0.0) -> float:
    """One measurement; the path parameter that is answered."""
    before = len(bench.values(topics.PATH_PARAMETER))
    bench.measurement(seconds, Navigation(north, east, 0.0, 0.0), 1.9, ("map", "base_link"))
    bench.until(lambda: len(bench.values(topics.PATH_PARAMETER)) > before)
    return bench.values(topics.PATH_PARAMETER)[-1]


def test_after_a_hold_guidance_rejoins_its_path_ahead_beside_the_vehicle(bench: Bench, tmp_path: Any) -> None:
    fly_north(bench, tmp_path, holding__hold_after=0.4)
    before = bench.values(topics.PATH_PARAMETER)[-1]
    bench.until(lambda: states(bench)[-1] == "holding")
    bench.until(lambda: bench.diagnosed("holding: no usable navigation for 0.4 s"))
    s = step(bench, 20.0, 12.0, 3.0)  # carried along in 16 s; at its last speed P would be at 36 m
    bench.until(lambda: was_in(bench, "holding", "running"))
    assert before < s == pytest.approx(0.12, abs=1e-4)


def test_a_vehicle_clock_that_was_set_back_does_not_begin_the_path_anew(bench: Bench, tmp_path: Any) -> None:
    node = fly_north(bench, tmp_path, holding__hold_after=20.0)
    before = bench.values(topics.PATH_PARAMETER)[-1]
    bench.odometry(0.5, Navigation(5.1, 0.0, 0.0, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 1)
    for k in range(1, 4):
        step(bench, 0.5 + 0.1 * k, 5.1 + 0.2 * k)
    assert bench.values(topics.PATH_PARAMETER)[-1] >= before > 0.03


def test_a_jump_is_refused_and_the_mission_aborts_where_the_vehicle_turns_out_to_be(
    bench: Bench, tmp_path: Any
) -> None:
    node = fly_north(bench, tmp_path, holding__hold_after=20.0, gate__accept_after=0.5)
    for k in range(4):
        bench.water(3.6 + 0.1 * k, 1.9)
        bench.odometry(3.6 + 0.1 * k, Navigation(5.0, 100.0, 0.0, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 4)
    bench.until(lambda: bench.diagnosed("from the last accepted one"))
    assert bench.values(topics.DESIRED_THRUST)[-1] == 6.0
    for k in range(4, 8):
        bench.water(3.6 + 0.1 * k, 1.9)
        bench.odometry(3.6 + 0.1 * k, Navigation(5.0, 100.0, 0.0, 0.0))
    bench.until(lambda: states(bench)[-1] == "aborted")
    bench.until(lambda: bench.diagnosed("aborted: limit path_distance: 100.0 m"))
    bench.until(lambda: bench.values(topics.DESIRED_THRUST)[-1] == 0.0)


def test_a_pose_that_froze_is_accepted_again_after_a_new_start(bench: Bench, tmp_path: Any) -> None:
    node = fly_north(bench, tmp_path, gate__frozen_after=1.0, holding__hold_after=0.4)
    for k in range(12):
        bench.measurement(3.6 + 0.1 * k, Navigation(5.0, 0.0, 0.0, 0.0), 1.9, ("map", "base_link"))
    bench.until(lambda: node.health.refused["odom"] >= 2)
    bench.until(lambda: states(bench)[-1] == "holding")
    bench.call("abort")
    bench.call("start")
    bench.measurement(5.0, Navigation(5.0, 0.0, 0.0, 0.0), 0.0, ("map", "base_link"))
    bench.until(lambda: states(bench)[-1] == "running")
    bench.until(lambda: bench.values(topics.DESIRED_THRUST)[-1] == 6.0)


def test_time_before_the_start_does_not_count_and_time_that_is_held_does(bench: Bench, tmp_path: Any) -> None:
    """Odometry was out for 50 s before; then the mission holds for want of velocity through water.

    It holds by the stamps, which are 10 s apart: no watchdog of wall time is as quick.
    """
    mission = tmp_path / "north.yaml"
    mission.write_text(NORTH)
    bench.start(GuidanceNode, mission=str(mission), limits__duration=40.0, holding__hold_after=9.0)
    step(bench, 1.0, 0.0)
    bench.call("start")
    step(bench, 51.0, 0.2)
    step(bench, 51.1, 0.4)
    assert states(bench)[-1] == "running"
    for k in range(1, 8):
        bench.odometry(51.1 + 10.0 * k, Navigation(0.4, 0.1 * k, 0.0, 0.0))
        bench.spin(0.05)
    bench.until(lambda: was_in(bench, "running", "holding", "aborted"))
    bench.until(lambda: bench.diagnosed("aborted: limit duration"))


def test_a_new_place_found_without_velocity_through_water_is_rejoined_later(
    bench: Bench, tmp_path: Any
) -> None:
    node = fly_north(bench, tmp_path, holding__hold_after=20.0, gate__accept_after=0.2)
    for k in range(8):
        bench.odometry(6.0 + 0.1 * k, Navigation(60.0, 5.0, 0.0, 0.0))
        bench.spin(0.02)
    bench.until(lambda: node.keeper.state.rejoins)
    s = step(bench, 7.0, 60.0, 5.0)
    assert s == pytest.approx(0.55, abs=0.06)


@pytest.mark.parametrize("watchdog", [True, False], ids=["watchdog first", "stamps first"])
def test_a_gap_of_time_holds_and_rejoins_whichever_notices_it_first(
    bench: Bench, tmp_path: Any, watchdog: bool
) -> None:
    """16 s between two stamps, at 12 m: at its last speed P would be at 36 m."""
    node = fly_north(bench, tmp_path, holding__hold_after=1.0 if watchdog else 15.0)
    if watchdog:
        bench.until(lambda: states(bench)[-1] == "holding")
    s = step(bench, 20.0, 12.0, 1.0)
    bench.until(lambda: was_in(bench, "holding", "running"))
    assert s == pytest.approx(0.12, abs=1e-4)
    assert node.keeper.state.follower.progress.point.t == pytest.approx(s, abs=1e-9)


def test_an_approach_is_a_phase_of_its_own(bench: Bench, tmp_path: Any) -> None:
    mission = tmp_path / "north.yaml"
    mission.write_text(NORTH)
    own = {"guidance__approach__overdue": 0.3, "holding__hold_after": 30.0}
    node = bench.start(GuidanceNode, mission=str(mission), **own)
    bench.call("start")
    for k in range(3):
        assert step(bench, 1.0 + 0.2 * k, -50.0 + 0.4 * k) == 0.0
    assert node.report()["phase"] == "approaching: 49 m to the path's start"
    assert bench.values(topics.DISTANCE_TO_GO)[0] == pytest.approx(150.0)
    late = "condition approach", "the approach to the path's start takes more than 0.3 s"
    reports = bench.received[topics.DIAGNOSTICS.name]
    bench.until(lambda: any(late == (v.key, v.value) for m in reports for v in m.status[0].values))
    assert step(bench, 40.0, -0.1) == 0.0  # a gap of time: planned anew, and the vehicle is there
    assert node.report()["phase"] == "on the path"
    bench.until(lambda: bench.values(topics.DISTANCE_TO_GO)[-1] == pytest.approx(100.0))


@pytest.mark.parametrize("state", ["idle", "holding"])
def test_abort_works_without_any_navigation(bench: Bench, state: str) -> None:
    bench.start(GuidanceNode, holding__hold_after=0.2)
    if state == "holding":
        bench.call("start")
    bench.until(lambda: states(bench)[-1:] == [state])
    assert bench.call("abort").success
    bench.until(lambda: states(bench)[-1] == "aborted")


def test_a_late_reader_gets_the_present_state_and_all_get_it_once_a_second(bench: Bench) -> None:
    bench.start(GuidanceNode)
    bench.until(lambda: states(bench))
    bench.call("start")
    bench.until(lambda: "running" in states(bench))
    heard: list[tuple[float, str]] = []
    topic = topics.MISSION_STATE
    late = qos.requested(topic, reliable=True, depth=100)
    bench.node.create_subscription(
        qos.message_class(topic.type), topic.name, lambda m: heard.append((time.monotonic(), m.data)), late
    )
    begin = time.monotonic()
    bench.until(lambda: heard)
    assert [word for _, word in heard] == ["running"]
    # After a pause of the machine one repetition may be late, and the next one is not.
    bench.until(lambda: any(b - a > 0.9 for (a, _), (b, _) in itertools.pairwise(heard[1:])))
    assert {word for _, word in heard} == {"running"}
    assert len(heard) <= 3 + (heard[-1][0] - begin), "the present state, then one a second"
