"""What a fault does to the messages of one topic."""

from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import TwistWithCovarianceStamped, Vector3Stamped
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message, serialize_message
from sensor_msgs.msg import Range
from std_msgs.msg import Float64, String

from auv_msgs_py.values.attitude import angles_of_quaternion, quaternion_of
from auv_sim.nodes.fault_injection import Injector
from auv_sim.nodes.message_faults import DEPTH_FAULTS, ROLL


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


def diving(z: float, w: float, x: float, y: float, yaw: float) -> Odometry:
    message = odometry(1.0, 3)
    message.pose.pose.position.z = z
    q = message.pose.pose.orientation
    q.w, q.x, q.y, q.z = w, x, y, yaw
    return message


def test_faults_of_the_depth_change_depth_or_attitude_alone() -> None:
    """On the wire z is up; a heading of 1 rad with a pitch."""
    attitude = quaternion_of(0.1, -0.2, 1.0)
    track = [diving(-float(k), *attitude) for k in range(5, 10)]
    found = {fault: spoiled(fault, track)[-1].pose.pose for fault in DEPTH_FAULTS}
    depths = {fault: pose.position.z for fault, pose in found.items()}
    assert math.isnan(depths.pop("depth_nan"))
    assert depths == {
        "depth_freeze": -6.0, "depth_jump": -39.0, "depth_turn": 9.0, "planar": 0.0, "rolled": -9.0,
    }  # fmt: skip
    angles = {
        fault: angles_of_quaternion(*(getattr(pose.orientation, name) for name in "wxyz"))
        for fault, pose in found.items()
    }
    assert angles.pop("rolled") == pytest.approx((0.1 + ROLL, -0.2, 1.0))
    phi, theta, psi = angles.pop("planar")
    assert (phi, theta) == (0.0, 0.0)
    assert psi == pytest.approx(1.0, abs=0.05)
    assert set(angles.values()) == {angles["depth_nan"]}
    assert spoiled("rolled", [Float64(data=2.0)] * 3) == [Float64(data=2.0)]  # not an odometry


def test_a_weak_thruster_and_an_altimeter_have_numbers() -> None:
    assert spoiled("weak", [Float64(data=5.0)] * 3)[0].data == pytest.approx(0.5)
    assert spoiled("jump", [Range(range=7.0)] * 3)[0].range == pytest.approx(107.0)
