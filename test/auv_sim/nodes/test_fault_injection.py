"""What a fault does to the messages of one topic."""

from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import TwistWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import Float64, String

from auv_sim.nodes.fault_injection import Injector


def odometry(x: float, seconds: int) -> Odometry:
    message = Odometry()
    message.header.frame_id = "map"
    message.header.stamp.sec = seconds
    message.pose.pose.position.x = x
    return message


def spoiled(fault: Any, messages: list[Any], good: int = 2, **how: float) -> list[Any]:
    """What comes out after `good` messages that had no fault, one second apart."""
    kind = type(messages[0])
    injector = Injector(kind, **how)  # type: ignore[arg-type]
    found: list[bytes] = []
    for k, message in enumerate(messages):
        if k == good:
            injector.fault = fault
        sent = injector.pass_on(serialize_message(message), float(k))
        found += sent if k >= good else []
    return [deserialize_message(data, kind) for data in found]


TRACK = [odometry(float(k), 10 + k) for k in range(6)]


def seen(messages: list[Any]) -> list[tuple[int, float]]:
    return [(message.header.stamp.sec, message.pose.pose.position.x) for message in messages]


@pytest.mark.parametrize(
    ("fault", "expected"),
    [
        ("none", [(12, 2.0), (13, 3.0), (14, 4.0), (15, 5.0)]),
        ("stop", []),
        ("delay", [(12, 2.0), (13, 3.0)]),
        ("freeze", [(12, 1.0), (13, 1.0), (14, 1.0), (15, 1.0)]),
        ("jump", [(12, 102.0), (13, 103.0), (14, 104.0), (15, 105.0)]),
        ("reverse", [(11, 1.0), (10, 0.0), (10, 0.0), (10, 0.0)]),
    ],
)
def test_odometry(fault: str, expected: list[tuple[int, float]]) -> None:
    assert seen(spoiled(fault, TRACK)) == expected


def test_a_flood_has_copies_and_a_frameless_message_no_frame() -> None:
    injector = Injector(Odometry, copies=7)
    injector.pass_on(serialize_message(TRACK[0]), 0.0)
    injector.fault = "flood"
    assert len(injector.pass_on(serialize_message(TRACK[1]), 0.7)) == 1
    assert [len(injector.due(0.7 + 0.1 * k + 0.01)) for k in range(8)] == [0, 1, 1, 1, 1, 1, 1, 0]
    assert {message.header.frame_id for message in spoiled("frameless", TRACK)} == {""}


def test_every_kind_of_message_has_a_first_number() -> None:
    for message, first in (
        (odometry(1.0, 1), lambda m: m.pose.pose.position.x),
        (TwistWithCovarianceStamped(), lambda m: m.twist.twist.linear.x),
        (Vector3Stamped(), lambda m: m.vector.x),
        (Float64(), lambda m: m.data),
    ):
        before = first(message)
        assert math.isnan(first(spoiled("nan", [message], good=0)[0]))
        assert first(spoiled("jump", [message], good=0, jump=5.0)[0]) == before + 5.0
    assert spoiled("nan", [String(data="running")], good=0)[0].data == "nan"


def test_what_was_delayed_is_forgotten_when_the_fault_ends() -> None:
    injector = Injector(Float64, delay=10.0)
    injector.fault = "delay"
    assert injector.pass_on(serialize_message(Float64(data=1.0)), 0.0) == []
    injector.fault = "none"
    assert injector.due(100.0) == []


def test_a_timeless_message_has_no_time_and_a_cut_one_is_half_a_message() -> None:
    (first, *_) = spoiled("timeless", TRACK)
    assert first.header.stamp.nanosec == 2**32 - 1
    injector = Injector(Float64)
    injector.fault = "cut"
    data = serialize_message(Float64(data=1.0))
    assert injector.pass_on(data, 0.0) == [data[: len(data) // 2]]


def test_one_state_is_forged_behind_the_first_message() -> None:
    said = spoiled("forge", [String(data="running")] * 4)
    assert [message.data for message in said] == ["running", "complete", "running"]
