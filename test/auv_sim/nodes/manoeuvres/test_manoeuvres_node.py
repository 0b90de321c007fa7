"""The node that flies manoeuvres, over DDS: a whole program, another node's commands, lost navigation."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import rclpy
from nav_msgs.msg import Odometry
from rclpy.parameter import Parameter
from sensor_msgs.msg import Range

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import fill_odometry
from auv_msgs_py.node.run import StopRequest, spin
from auv_msgs_py.node.runtime import SuiteNode
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Navigation, SpatialNavigation
from auv_path_following.parameters import NodeParameters
from auv_sim.nodes.manoeuvres import manoeuvres_node
from auv_sim.nodes.manoeuvres.manoeuvres_node import ManoeuvresNode
from node_bench import Bench

PROGRAM = """
version: 1
name: short
legs:
  - straight: {seconds: 0.5, thrust: 0.5}
  - circle: {seconds: SECONDS, rudder_deg: 10}
"""


def started(bench: Bench, tmp_path: Path, seconds: float, farewell: float = 0.3, **parameters: Any) -> Any:
    file = tmp_path / "short.yaml"
    file.write_text(PROGRAM.replace("SECONDS", str(seconds)))
    bench._listen(topics.MISSION_STATE)
    settings = {"program": str(file), "consent": True, "look_around": 0.0, **parameters}
    node: Any = bench.start(ManoeuvresNode, role=topics.AUTOPILOT, **settings)
    node.farewell = farewell
    return node


def advertise(node: Any, topic: topics.Topic = topics.RUDDER_CMD) -> Any:
    return node.create_publisher(qos.message_class(topic.type), topic.name, qos.offered(topic))


def published(bench: Bench) -> list[str]:
    """The topics that the node has published, but for its diagnostics."""
    return [name for name, messages in bench.received.items() if messages and name != "/diagnostics"]


def words(bench: Bench) -> list[str]:
    heard = [message.data for message in bench.received["mission_state"]]
    return [word for word, _ in itertools.groupby(heard)]


def fly(bench: Bench, steps: int, begin: int = 0) -> None:
    for k in range(begin, begin + steps):
        count = len(bench.received["thrust_cmd"])
        bench.odometry(10.0 + 0.1 * k, Navigation(0.19 * k, 0.0, 0.0, 0.0))
        bench.until(lambda count=count: len(bench.received["thrust_cmd"]) > count)  # type: ignore[misc]


def test_it_does_not_move_without_consent(bench: Bench) -> None:
    with pytest.raises(ConfigurationError, match="manoeuvres: consent: found false"):
        bench.start(ManoeuvresNode)


def test_a_program_is_flown_and_ends_with_zeros(bench: Bench, tmp_path: Path) -> None:
    assert ManoeuvresNode.farewell > 10 * manoeuvres_node._PERIOD
    node = started(bench, tmp_path, 0.5, farewell=60.0)
    fly(bench, 12)
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-5:] == [0.0] * 5)
    assert not node.finished
    node.farewell = 0.0
    bench.until(lambda: node.finished)
    rudder = [message.data for message in bench.received["rudder_cmd"]]
    thrust = [message.data for message in bench.received["thrust_cmd"]]
    assert thrust[0] == pytest.approx(3.24) and rudder[0] == 0.0
    assert max(rudder) == pytest.approx(0.1745, abs=1e-3)  # to port
    assert thrust[-5:] == [0.0] * 5 and rudder[-5:] == [0.0] * 5
    assert words(bench) == ["running", "complete"]
    assert not node.fault
    sent: list[object] = []
    node._outputs.send = sent.append
    node._watch()  # a recorder waits for silence
    assert sent == []


def test_commands_of_another_node_stop_it(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    advertise(bench.node)
    bench.until(lambda: bool(node.run.over))
    assert "rudder_cmd is published by /auv/bench, /auv/manoeuvres" in node.run.over
    count = len(bench.received["thrust_cmd"])
    bench.until(lambda: len(bench.received["thrust_cmd"]) > count)
    assert bench.received["thrust_cmd"][-1].data == 0.0
    bench.until(lambda: words(bench) == ["running", "aborted"])


def test_lost_navigation_and_its_own_end_stop_it(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0, odometry_timeout=0.5)
    fly(bench, 3)
    bench.until(lambda: bool(node.run.over))
    assert node.run.over == "no usable odometry"
    bench.until(lambda: bench.received["thrust_cmd"][-1].data == 0.0)
    bench.until(lambda: bool(node.fault))
    assert node.fault == "ended early: no usable odometry"


def test_a_mission_that_is_under_way_is_left_alone(bench: Bench, tmp_path: Path) -> None:
    """Drivers obey `aborted` and the zeros, so a start that is refused sends neither."""
    node = started(bench, tmp_path, 60.0, look_around=60.0)
    bench.odometry(10.0, Navigation(0.0, 0.0, 0.0, 0.0))
    bench.until(lambda: node._heard_at)
    assert not node.run.begun and not node.fault  # it is still looking around
    advertise(bench.node)
    bench.until(lambda: node.fault)
    assert node.fault.startswith("not begun, nothing was sent: rudder_cmd is published by /auv/bench")
    bench.odometry(10.1, Navigation(0.19, 0.0, 0.0, 0.0))
    bench.spin(0.2)
    node.close()
    bench.spin(0.1)
    assert not node.run.begun and published(bench) == []


def test_it_begins_after_it_has_looked_around(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0, look_around=60.0)
    bench.odometry(9.9, Navigation(0.0, 0.0, 0.0, 0.0))
    bench.until(lambda: node._looking_since)
    assert not node.run.begun
    node._looking_since -= 60.0
    fly(bench, 1)
    assert node.run.begun and not node.run.over


def test_a_second_one_of_the_same_name_stops_it(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    twin = rclpy.create_node("manoeuvres", namespace="/auv", use_global_arguments=False)
    try:
        advertise(twin)
        bench.until(lambda: bool(node.run.over))
        assert node.run.over == "rudder_cmd is published by /auv/manoeuvres (2 times)"
    finally:
        twin.destroy_node()


def test_an_altimeter_that_falls_silent_stops_a_diver(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = started(bench, tmp_path, 60.0, vehicle="remus100_6dof")
    monkeypatch.setattr(manoeuvres_node, "_ALTITUDE_AGE", 60.0)
    for seconds in (math.nan, 20.0, math.nan):
        node._on_altitude(Range(range=seconds))
    bench.diving(10.0, SpatialNavigation(0.0, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0), None)
    bench.until(lambda: node.run.begun)
    assert not node.run.over  # one NaN is no loss
    monkeypatch.setattr(manoeuvres_node, "_ALTITUDE_AGE", 0.0)
    bench.diving(10.1, SpatialNavigation(0.19, 0.0, 10.0, 0.0, 0.0, 0.0, 0.0, 0.0), None)
    bench.until(lambda: bool(node.run.over))
    assert "no altitude any more" in node.run.over


def test_it_sends_zeros_when_it_is_closed(
    bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    before = len(bench.received["thrust_cmd"])
    bench.executor.remove_node(node)  # what comes after an error: no timer of it runs any more
    now = [100.0]

    def sleep(seconds: float) -> None:
        now[0] += seconds

    monkeypatch.setattr(manoeuvres_node, "time", SimpleNamespace(monotonic=lambda: now[0], sleep=sleep))
    node.close()
    bench.until(lambda: len(bench.received["thrust_cmd"]) >= before + 3)
    assert {message.data for message in bench.received["thrust_cmd"][before:]} == {0.0}
    assert node.run.over == "interrupted"


class Beside(SuiteNode):
    """A vehicle that goes on, in one process with the node; like the recorder it is busy at a stop."""

    def __init__(self, stop: StopRequest, flyer: Any) -> None:
        super().__init__("beside", NodeParameters, namespace="/auv", use_global_arguments=False)
        self.stop_request, self.flyer = stop, flyer
        self.thrusts: list[float] = []
        self.before = self.sent = 0
        self.odometry = self.advertise(topics.ODOM)
        self.listen(topics.THRUST_CMD, self.on_thrust)
        self.create_timer(0.02, self.send)

    def send(self) -> None:
        message = Odometry()
        message.header.frame_id, message.child_frame_id = "map", "base_link"
        self.sent += 1
        navigation = Navigation(0.03 * self.sent, 0.0, 0.0, 0.0)
        fill_odometry(message, navigation, 1.5, 0.0, round(1e9 * (10.0 + 0.02 * self.sent)))
        self.odometry.publish(message)

    def on_thrust(self, message: Any) -> None:
        self.thrusts.append(message.data)
        if len(self.thrusts) == 5:
            self.stop_request.requested, self.before = True, self.sent

    def busy(self) -> bool:
        return self.sent < self.before + 30


def test_a_stop_request_sends_zeros_while_odometry_comes_and_another_node_is_busy(
    domain: int, tmp_path: Path
) -> None:
    rclpy.init(args=[], domain_id=domain)
    (tmp_path / "short.yaml").write_text(PROGRAM.replace("SECONDS", "60"))
    values = {"program": str(tmp_path / "short.yaml"), "consent": True, "look_around": 0.0}
    values |= {"lateness": 60.0, "odometry_timeout": 10.0}
    overrides = [Parameter(name, value=value) for name, value in values.items()]
    flyer = ManoeuvresNode(namespace="/auv", parameter_overrides=overrides, use_global_arguments=False)
    flyer.farewell = 0.3
    stop = StopRequest()
    beside = Beside(stop, flyer)
    try:
        assert spin([beside, flyer], stop) == 0
        assert beside.thrusts[0] > 0.0
        # At most the answers that were under way have a thrust.
        assert sum(thrust > 0.0 for thrust in beside.thrusts[5:]) <= 3
        assert beside.thrusts[-10:] == [0.0] * 10
        assert flyer.run.over == "interrupted" and flyer.finished
    finally:
        stop.withdraw()
        for node in (flyer, beside):
            node.close()
            node.destroy_node()
        rclpy.try_shutdown()
