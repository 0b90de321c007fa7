"""heading_autopilot alone, over real DDS."""

from __future__ import annotations

import itertools
import math
import time

import pytest
from rclpy.duration import Duration
from std_msgs.msg import String

from auv_msgs_py.contract import mission_word, topics
from auv_msgs_py.values.types import Navigation
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

    def stopped() -> bool:
        bench.odometry(1.0 + time.monotonic() - t + 0.01, NORTHWARD)
        bench.spin(0.05)
        return bench.values(topics.THRUST_CMD)[-1] == 0.0

    bench.until(stopped)
    assert bench.values(topics.RUDDER_CMD)[-1] == 0.0
    bench.until(lambda: bench.diagnosed("guidance is silent"))


def test_the_autopilot_stops_the_vehicle_when_odometry_falls_silent(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode, odometry_timeout=0.3)
    stamps = itertools.count(1.0, 0.05)

    def answered() -> bool:
        bench.odometry(next(stamps), NORTHWARD)
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.spin(0.02)
        return 6.0 in bench.values(topics.THRUST_CMD)

    bench.until(answered)
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-1] == 0.0)
    bench.until(lambda: bench.diagnosed("no usable odom for 0.3 s: rudder and thrust are 0"))


def test_a_gap_between_stamps_begins_anew_as_after_a_silence(bench: Bench) -> None:
    """The laws would otherwise go on turning the rudder for the 5 s."""
    node = bench.start(HeadingAutopilotNode, odometry_timeout=4.0)
    for k, stamp in enumerate((1.0, 1.05, 6.0)):
        bench.odometry(stamp, Navigation(stamp, 0.0, 0.0, 0.0))
        bench.reference(math.pi / 2 + 0.3, 0.0, 6.0)
        bench.until(lambda k=k: len(bench.values(topics.THRUST_CMD)) > k)
    assert bench.values(topics.RUDDER_CMD)[1] > 0.0
    assert bench.values(topics.RUDDER_CMD)[2] == 0.0
    assert bench.values(topics.THRUST_CMD) == [6.0] * 3
    assert not node.health.refused


def test_a_heading_that_jumps_does_not_reach_the_rudder(bench: Bench) -> None:
    node = bench.start(HeadingAutopilotNode)
    for k in range(5):
        bench.odometry(1.0 + 0.05 * k, Navigation(0.1 * k, 0.0, 0.0, 0.0))
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.until(lambda k=k: len(bench.values(topics.RUDDER_CMD)) > k)
    bench.odometry(1.3, Navigation(0.6, 0.0, 1.5, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 1)
    bench.until(lambda: bench.diagnosed("a heading 86 deg from the last accepted one"))
    assert all(abs(rudder) < 1e-3 for rudder in bench.values(topics.RUDDER_CMD))


@pytest.mark.parametrize(
    ("reference", "named"),
    [
        ((100.0, 0.0, 6.0), "desired_yaw"),
        ((0.0, 100.0, 6.0), "desired_yaw_rate"),
        ((0.0, 0.0, 600.0), "desired_thrust"),
    ],
)
def test_a_reference_that_no_guidance_gives_is_refused(
    bench: Bench, reference: tuple[float, float, float], named: str
) -> None:
    node = bench.start(HeadingAutopilotNode)
    bench.reference(*reference)
    bench.until(lambda: node.health.refused[named] == 1)


def test_thrust_that_contradicts_the_state_of_the_mission_is_not_obeyed_for_long(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode, reference_timeout=0.3)
    bench.send(topics.MISSION_STATE, String(data="aborted"))
    t = time.monotonic()

    def diagnosed() -> bool:
        at = time.monotonic() - t
        bench.odometry(1.0 + at, Navigation(at, 0.0, 0.0, 0.0))
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.spin(0.05)
        return bench.diagnosed("though the mission is aborted")

    bench.until(diagnosed)
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-1] == 0.0)


def test_a_pose_that_froze_is_accepted_again_when_a_mission_is_started(bench: Bench) -> None:
    """It is not when a mission goes on that held."""
    node = bench.start(HeadingAutopilotNode, gate__frozen_after=1.0)

    def answered(seconds: float) -> bool:
        before, refused = len(bench.values(topics.RUDDER_CMD)), node.health.refused["odom"]
        bench.odometry(seconds, NORTHWARD)
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.until(
            lambda: len(bench.values(topics.RUDDER_CMD)) > before or node.health.refused["odom"] > refused
        )
        return node.health.refused["odom"] == refused

    bench.send(topics.MISSION_STATE, String(data="running"))
    assert not [answered(1.0 + 0.1 * k) for k in range(15)][-1]
    stops = ((["holding", "holding", "running"], False), (["aborted", "aborted", "running"], True))
    for words, accepted in stops:
        for word in words:
            bench.send(topics.MISSION_STATE, String(data=word))
        bench.until(lambda: node._references.mission.at(time.monotonic()) == "running")
        bench.spin(0.2)
        assert answered(2.5 + 0.1 * accepted) is accepted


def test_a_mission_state_that_is_repeated_is_no_start(bench: Bench) -> None:
    """A latched message comes again when a link does: the rudder goes on, and a jump is still a jump."""
    node = bench.start(HeadingAutopilotNode)
    bench.send(topics.MISSION_STATE, String(data="running"))
    for k in range(8):
        bench.odometry(1.0 + 0.05 * k, Navigation(0.1 * k, 0.0, 0.0, 0.0))
        bench.reference(math.pi / 2 + 0.3, 0.0, 6.0)
        bench.until(lambda k=k: len(bench.values(topics.RUDDER_CMD)) > k)
        if k == 6:
            bench.until(lambda: node._references.mission.at(time.monotonic()) == "running")
            bench.send(topics.MISSION_STATE, String(data="running"))
            bench.spin(0.2)
    before, after = bench.values(topics.RUDDER_CMD)[-2:]
    assert 0.5 * before < after
    bench.odometry(1.5, Navigation(0.9, 0.0, 1.5, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 1)


def test_a_vehicle_clock_that_is_set_back_far_is_followed(bench: Bench) -> None:
    """By more than would be too late: two messages that continue each other show what it is."""
    node = bench.start(HeadingAutopilotNode)
    assert node.parameters.lateness < 500.0
    for k in range(5):
        bench.odometry(1000.0 + 0.05 * k, Navigation(0.1 * k, 0.0, 0.0, 0.0))
        bench.spin(0.05)
    for k in range(20):
        bench.odometry(500.0 + 0.05 * k, Navigation(0.5 + 0.1 * k, 0.0, 0.0, 0.0))
        bench.spin(0.05)
    bench.until(lambda: node.health.refused["odom"] == 1)
    bench.reference(math.pi / 2, 0.0, 6.0)
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-1:] == [6.0])


def test_a_clock_of_the_computer_that_is_set_forward_makes_nothing_late(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = bench.start(HeadingAutopilotNode)
    assert node.parameters.lateness < 600.0
    true_time = node.get_clock().now
    for k in range(20):
        if k == 10:
            monkeypatch.setattr(node.get_clock(), "now", lambda: true_time() + Duration(seconds=700))
        bench.odometry(1000.0 + 0.05 * k, Navigation(0.1 * k, 0.0, 0.0, 0.0))
        bench.spin(0.05)
    assert node.get_clock().now() - true_time() > Duration(seconds=600)
    assert not node.health.refused


def test_stopping_the_autopilot_stops_the_vehicle(bench: Bench) -> None:
    node = bench.start(HeadingAutopilotNode)
    bench.odometry(1.0, NORTHWARD)
    bench.reference(math.pi / 2, 0.0, 6.0)
    bench.until(lambda: bench.values(topics.THRUST_CMD) == [6.0])
    node.close()
    bench.until(lambda: bench.values(topics.THRUST_CMD) == [6.0, 0.0])
    assert bench.values(topics.RUDDER_CMD)[-1] == 0.0


def test_one_forged_state_does_not_stop_the_vehicle(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Guidance repeats its own once a second; the forged one is counted and named."""
    monkeypatch.setattr(mission_word, "ALONE", 60.0)  # on a busy machine a repetition may be late
    node = bench.start(HeadingAutopilotNode, reference_timeout=0.3)
    bench.send(topics.MISSION_STATE, String(data="running"))
    begin = time.monotonic()
    for k in range(24):
        if k == 2:
            bench.send(topics.MISSION_STATE, String(data="idle"))
        if k == 20:
            bench.send(topics.MISSION_STATE, String(data="running"))
        at = time.monotonic() - begin
        bench.odometry(1.0 + at, Navigation(at, 0.0, 0.0, 0.0))
        bench.reference(math.pi / 2, 0.0, 6.0)
        bench.spin(0.05)
    bench.until(lambda: node.health.refused["mission_state"] == 1)
    bench.until(lambda: len(bench.values(topics.THRUST_CMD)) == 24)
    assert bench.values(topics.THRUST_CMD)[-1] == 6.0
    assert 0.0 not in bench.values(topics.THRUST_CMD)[1:]
    bench.until(lambda: bench.diagnosed("found 'idle' once among 'running'"))
