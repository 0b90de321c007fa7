"""The base node over real DDS: light messages, lockstep's time, an executor that stops on request."""

from __future__ import annotations

import signal
import struct
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import rclpy
from rclpy.parameter import Parameter
from rclpy.serialization import serialize_message
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos, topics, wire
from auv_msgs_py.node.run import StopRequest, run_nodes, spin
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.parameters import NodeParameters
from node_bench import NORTHWARD, Bench

#: std_msgs/msg/Float64 in CDR of the other byte order.
BIG_ENDIAN = b"\x00\x00\x00\x00" + struct.pack(">d", 0.25)


class Listener(SuiteNode):
    """Keeps what comes on rudder_cmd and odom."""

    def __init__(self, **arguments: Any) -> None:
        super().__init__("listener", NodeParameters, **arguments)
        self.heard: list[Any] = []
        self.times: list[float] = []
        self.listen(topics.RUDDER_CMD, lambda message: self.heard.append((type(message), message.data)))
        self.listen(topics.ODOM, lambda _: self.times.append(self.now()))
        self.output = self.advertise(topics.RUDDER_STATE)


@pytest.fixture
def start(bench: Bench) -> Callable[..., Any]:
    """Bench and listener, matched both ways."""

    def make(**parameters: Any) -> Any:
        for topic in (topics.ODOM, topics.RUDDER_CMD):
            kind = qos.message_class(topic.type)
            bench._publishers[topic.name] = bench.node.create_publisher(kind, topic.name, qos.offered(topic))
        bench._listen(topics.RUDDER_STATE)
        return bench.start(Listener, **parameters)

    return make


def test_a_light_and_a_generated_message_look_the_same_on_the_wire(
    bench: Bench, start: Callable[..., Any]
) -> None:
    node = start()
    for message in (wire.Float64(0.5), Float64(data=0.5)):
        node.output.publish(message)
    bench.until(lambda: len(bench.received[topics.RUDDER_STATE.name]) == 2)
    assert bench.values(topics.RUDDER_STATE) == [0.5, 0.5]


def test_bytes_that_only_rclpy_understands_are_left_to_it(bench: Bench, start: Callable[..., Any]) -> None:
    node = start()
    for data in (BIG_ENDIAN, serialize_message(Float64(data=0.5))):
        bench.send(topics.RUDDER_CMD, data)
    bench.until(lambda: len(node.heard) == 2)
    assert node.heard == [(Float64, 0.25), (wire.Float64, 0.5)]


@pytest.mark.parametrize("lockstep", [True, False])
def test_in_lockstep_the_odometry_is_the_clock(
    bench: Bench, start: Callable[..., Any], lockstep: bool
) -> None:
    node = start(use_sim_time=True, lockstep=lockstep)
    bench.odometry(12.5, NORTHWARD)
    bench.until(lambda: node.times)
    expected = 12.5 if lockstep else 0.0
    assert node.times == [expected]
    assert node.get_clock().now().nanoseconds == expected * 1e9
    bench.until(lambda: bench.node.count_subscribers("/clock") == (0 if lockstep else 1))


def test_a_fault_stops_the_executor_at_once(domain: int) -> None:
    rclpy.init(args=[], domain_id=domain)
    stop = StopRequest()
    heard: list[float] = []
    node = SuiteNode(
        topics.PLANT,
        NodeParameters,
        parameter_overrides=[Parameter("lockstep", value=True)],
        use_global_arguments=False,
    )

    def failing() -> None:
        heard.append(time.monotonic())
        node.fail("broken")

    node.create_timer(0.002, failing)
    try:
        assert spin([node], stop) == 1
        assert len(heard) == 1  # no second callback, though a tenth of a second would have had room for fifty
    finally:
        stop.withdraw()
        node.destroy_node()
        rclpy.try_shutdown()


@pytest.mark.parametrize("ignored", [False, True])
def test_a_lost_terminal_requests_a_stop_unless_it_is_ignored(ignored: bool) -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN if ignored else signal.SIG_DFL)
    try:
        stop = StopRequest()
        try:
            assert callable(signal.getsignal(signal.SIGHUP)) != ignored  # else it would end the tests
            signal.raise_signal(signal.SIGHUP)
            assert stop.requested != ignored
        finally:
            stop.withdraw()
    finally:
        signal.signal(signal.SIGHUP, before)


def test_an_error_in_one_node_leaves_the_others_to_be_closed_in_their_order(domain: int) -> None:
    ended: list[str] = []

    class Broken(SuiteNode):
        def close(self) -> None:
            ended.append(self.get_name())
            raise ValueError(self.get_name())

        def destroy_node(self) -> None:
            ended.append(f"{self.get_name()} destroyed")
            super().destroy_node()

    def node(name: str) -> SuiteNode:
        made = Broken(name, NodeParameters, use_global_arguments=False)
        made.finished = True
        return made

    with pytest.raises(ValueError, match="second"):
        run_nodes([lambda: node("first"), lambda: node("second")], ["--ros-args"])
    assert ended == ["first", "first destroyed", "second", "second destroyed"]
    assert not rclpy.ok()


def test_a_parameter_file_that_is_not_there_costs_one_line(
    domain: int, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    missing = tmp_path / "robust.yaml"
    assert run_nodes([], ["--ros-args", "--params-file", str(missing)]) == 2
    assert capfd.readouterr().err == f"{missing}: found no such file, expected a YAML file\n"
