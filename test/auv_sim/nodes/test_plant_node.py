"""remus_plant by itself, over real DDS."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from std_msgs.msg import Float64

from auv_msgs_py.contract import mission_word, qos, topics
from auv_msgs_py.contract.conversions import nanoseconds
from auv_msgs_py.contract.topics import Topic
from auv_sim.nodes.plant_node import RemusPlantNode
from node_bench import Bench


@pytest.mark.parametrize(
    ("topic", "value"),
    [
        (topics.RUDDER_CMD, math.nan),
        (topics.RUDDER_CMD, 0.7),
        (topics.RUDDER_CMD, -0.7),
        (topics.THRUST_CMD, math.inf),
        (topics.THRUST_CMD, -1.0),
        (topics.THRUST_CMD, 100.0),
    ],
)
def test_the_plant_refuses_commands_that_no_servo_can_follow(
    bench: Bench, topic: Topic, value: float
) -> None:
    node = bench.start(RemusPlantNode)
    bench.send(topic, Float64(data=value))
    bench.until(lambda: node.health.refused[topic.name] == 1)
    node.health.publish()
    bench.until(lambda: bench.diagnosed(f"refused: {topic.name}: found"))


def test_the_plant_stops_by_itself_when_no_command_comes(bench: Bench) -> None:
    node = bench.start(RemusPlantNode, hold_until_running=False, speed=20.0, initial__surge=1.9)
    bench.send(topics.RUDDER_CMD, Float64(data=0.2))
    bench.send(topics.THRUST_CMD, Float64(data=6.0))
    bench.until(lambda: node.command.thrust == 6.0)
    bench.until(lambda: node.command.thrust == 0.0)
    bench.until(lambda: bench.received["rudder_state"][-1].data == 0.0)
    bench.until(lambda: bench.diagnosed("for 1 s: stopped"))


def test_before_the_mission_the_plant_lies_at_its_beginning_and_time_passes(bench: Bench) -> None:
    bench.start(RemusPlantNode, speed=50.0, initial__x=3.0, initial__y=4.0, current__Vx=0.2)
    bench.until(lambda: len(bench.received["odom"]) > 20)
    resting = bench.received["odom"][:20]
    assert (resting[0].header.stamp.sec, resting[0].header.stamp.nanosec) == (1, 0)
    assert np.unique(np.diff([nanoseconds(message.header.stamp) for message in resting])) == [50_000_000]
    for message in resting:
        pose, twist = message.pose.pose.position, message.twist.twist
        assert (pose.x, pose.y, twist.linear.x, twist.linear.y, twist.angular.z) == (4.0, 3.0, 0.0, 0.0, 0.0)
    water = bench.received["velocity_through_water"][0].twist.twist.linear
    assert (water.x, water.y) == pytest.approx((-0.2, 0.0))
    bench.send(topics.MISSION_STATE, qos.message_class(topics.MISSION_STATE.type)(data="running"))
    bench.until(lambda: bench.received["odom"][-1].pose.pose.position.y > 3.0)
    before = nanoseconds(bench.received["odom"][-1].header.stamp)
    bench.call("reset")
    bench.until(lambda: nanoseconds(bench.received["odom"][-1].header.stamp) < before)


def test_in_lockstep_nothing_moves_before_the_mission(bench: Bench) -> None:
    bench.start(RemusPlantNode, lockstep=True)
    bench.spin(0.3)
    assert bench.received["odom"] == []


def test_a_state_stops_the_plant_when_it_is_said_twice(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mission_word, "ALONE", 60.0)  # once, however long this machine pauses
    node = bench.start(RemusPlantNode, hold_until_running=False, command_timeout=60.0)
    word = qos.message_class(topics.MISSION_STATE.type)
    bench.send(topics.MISSION_STATE, word(data="running"))
    bench.send(topics.RUDDER_CMD, Float64(data=0.2))
    bench.send(topics.THRUST_CMD, Float64(data=6.0))
    bench.until(lambda: node.command.thrust == 6.0)
    bench.send(topics.MISSION_STATE, word(data="complete"))
    bench.spin(0.3)
    assert node.command.thrust == 6.0
    bench.send(topics.MISSION_STATE, word(data="complete"))
    bench.until(lambda: node.command.thrust == 0.0)


_BLIND = """
name: blind
sensors:
  water_track: {dropouts: {every: 1, length: 3}}
  bottom_track: {lock: false}
"""


def test_in_a_sea_the_truth_has_its_own_topic_and_a_blind_log_is_silent(bench: Bench, tmp_path: Path) -> None:
    file = tmp_path / "blind.yaml"
    file.write_text(_BLIND, encoding="utf-8")
    bench.start(RemusPlantNode, hold_until_running=False, speed=20.0, sea=str(file), seed=2)
    bench.until(lambda: len(bench.received["odom"]) > 200)
    odometry, truth = bench.received["odom"], bench.received["true_odom"]
    assert math.isnan(odometry[-1].twist.twist.linear.x)
    assert math.isfinite(truth[-1].twist.twist.linear.x)
    assert truth[0].pose.pose.position.x != odometry[0].pose.pose.position.x
    # Covariances: of the navigator's position, and none of a velocity that was not measured.
    assert odometry[-1].pose.covariance[0] > 0.0
    assert not odometry[-1].twist.covariance[:15].any()
    assert not truth[-1].pose.covariance.any()
    told = {nanoseconds(message.header.stamp) for message in bench.received["velocity_through_water"]}
    due = {nanoseconds(message.header.stamp) for message in odometry}
    assert 20 < len(due - told) < 190


def test_without_a_sea_there_is_no_truth_to_tell(bench: Bench) -> None:
    node = bench.start(RemusPlantNode, hold_until_running=False, speed=20.0)
    assert topics.TRUE_ODOM not in node.publishers_by_topic
    bench.until(lambda: bench.received["odom"])
    assert not bench.received["odom"][0].pose.covariance.any()
