"""What the suite takes from rclpy's private parts is there and does what it is taken for."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from std_msgs.msg import Float64

from auv_msgs_py.contract.wire import Float64 as Light
from auv_msgs_py.node.private_rclpy import parameter_overrides, raw_sender, stop_reading_clock, take_polled


@pytest.fixture
def node(domain: int) -> Iterator[Node]:
    context = Context()
    rclpy.init(args=[], context=context, domain_id=domain)
    overrides = [Parameter("use_sim_time", value=True), Parameter("gain", value=2)]
    made = Node("private", context=context, parameter_overrides=overrides)
    yield made
    made.destroy_node()
    rclpy.try_shutdown(context=context)


def wait(until: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 180.0
    while not until():
        assert time.monotonic() < deadline
        time.sleep(0.01)


def test_overrides_count_when_they_are_changed(node: Node) -> None:
    overrides = parameter_overrides(node)
    assert {name: overrides[name].value for name in ("use_sim_time", "gain")} == {
        "use_sim_time": True,
        "gain": 2,
    }
    overrides["gain"] = Parameter("gain", value=3.0)
    assert node.declare_parameter("gain", 1.0).value == 3.0


def test_bytes_are_sent_and_taken_without_an_executor(node: Node) -> None:
    woken: list[object] = []
    subscription = node.create_subscription(Float64, "number", woken.append, 10, raw=True)
    take = take_polled(node, subscription)
    publisher = node.create_publisher(Float64, "number", 10)
    wait(lambda: publisher.get_subscription_count() == 1)
    raw_sender(publisher)(Light(4.5).serialized())
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    executor.spin_once(timeout_sec=0.2)
    executor.shutdown()
    assert woken == []
    data, info = take(Float64, True)
    received = Light()
    received.read(data)
    assert received.data == 4.5
    assert info["source_timestamp"] > 0
    assert take(Float64, True) is None


def test_the_clock_stays_simulated_without_its_reader(node: Node) -> None:
    assert node.count_subscribers("/clock") == 1
    stop_reading_clock(node)
    wait(lambda: node.count_subscribers("/clock") == 0)
    assert node.get_clock().ros_time_is_active
