"""An operator holds and resumes a mission, sets another one and sends a goal: guidance over real DDS."""

from __future__ import annotations

import math
from typing import Any

import pytest
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import PoseStamped
from rclpy.parameter import Parameter

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.types import Navigation
from auv_path_following.nodes.guidance_node import GuidanceNode
from node_bench import Bench

NORTH = """\
version: 1
name: north
frame: ned
origin: {latitude_deg: 54.0, longitude_deg: 8.0}
thrust: 6.48
geofence: [[-50, -50], [300, -50], [300, 50], [-50, 50]]
segments:
  - line: {start: [0, 0], length: 100, course_deg: 0}
  - line: {start: [100, 0], length: 100, course_deg: 0}
"""
EAST = """\
version: 1
name: east
frame: ned
thrust: 6.48
segments: [{line: {start: [0, 0], length: 80, course_deg: 90}}]
"""
TIGHT = """\
version: 1
name: tight
frame: ned
thrust: 6.48
segments: [{arc: {centre: [0, 0], radius: 2, from_deg: 0, to_deg: 180}}]
"""


class Operator:
    """The bench with a clock of its own: every step is one odometry."""

    def __init__(self, bench: Bench, **parameters: Any) -> None:
        self.bench = bench
        self.node = bench.start(GuidanceNode, mission_text=NORTH, **parameters)
        self.time = 0.0

    def set(self, **values: Any) -> str:
        """Set parameters; return why they were refused, empty if they were accepted."""
        changes = [Parameter(name.replace("__", "."), value=value) for name, value in values.items()]
        return str(self.node.set_parameters_atomically(changes).reason)

    def step(self, north: float, east: float = 0.0, course: float = 0.0) -> float:
        """Send one odometry; return the thrust that guidance asks for."""
        self.time += 0.5
        last = topics.PATH_PARAMETER, topics.DESIRED_THRUST
        answers = [len(self.bench.values(topic)) for topic in last]
        self.bench.measurement(self.time, Navigation(north, east, course, 0.0), 2.0, ("map", "base_link"))
        self.bench.until(
            lambda: all(len(self.bench.values(t)) > n for t, n in zip(last, answers, strict=True))
        )
        return float(self.bench.values(topics.DESIRED_THRUST)[-1])

    def was_refused(self, text: str) -> bool:
        """Whether the latest refused message was refused with this text."""
        return text in self.node.health.refusals.latest

    def status(self) -> dict[str, str]:
        """The values of the newest `mission_status`."""
        self.bench.spin(0.1)
        self.bench.until(lambda: self.bench.received["mission_status"])
        return values_of(self.bench.received["mission_status"][-1])

    def shows(self, **expected: str) -> None:
        """Wait until the newest `mission_status` has these values."""
        self.bench.until_newest(
            topics.MISSION_STATUS, lambda status: expected.items() <= values_of(status).items()
        )


def values_of(status: DiagnosticStatus) -> dict[str, str]:
    return {pair.key: pair.value for pair in status.values}


@pytest.fixture
def operator(bench: Bench) -> Operator:
    return Operator(bench)


def test_a_hold_ends_by_resume_only(bench: Bench) -> None:
    operator = Operator(bench, holding__hold_after=1.0, holding__abort_after=0.3)
    refused = bench.call("hold")
    assert (refused.success, refused.message) == (False, "already idle")
    bench.call("start")
    assert operator.step(1.0) == 6.48
    assert bench.call("hold").message == "hold was called"
    assert [operator.step(2.0), operator.step(3.0)] == [0.0, 0.0], "navigation does not end it"
    bench.spin(1.6)  # neither do missing navigation nor abort_after
    assert operator.status()["state"] == "holding"
    assert bench.call("resume").message == "no usable navigation"

    def resumed() -> bool:
        assert operator.step(6.0) == 0.0
        return bool(bench.call("resume").success)

    bench.until(resumed)
    assert operator.set(holding__hold_after=60.0) == ""
    assert operator.step(7.0) == 6.48
    assert bench.values(topics.PATH_PARAMETER)[-1] == pytest.approx(0.07, abs=0.01), "P is beside the vehicle"
    refused = bench.call("resume")
    assert (refused.success, refused.message) == (False, "running: no hold that the service hold began")


def test_a_mission_is_set_while_none_is_under_way_and_in_an_operators_hold(operator: Operator) -> None:
    bench = operator.bench
    bench.until_newest(topics.ORIGIN, lambda origin: origin.latitude == 54.0)
    fence = bench.until_newest(topics.GEOFENCE, lambda fence: len(fence.polygon.points) == 4)
    assert (fence.polygon.points[1].x, fence.polygon.points[1].y) == (-50.0, 300.0)
    operator.shows(mission="north")
    bench.call("start")
    operator.step(1.0)
    assert "found a change while a mission is running" in operator.set(mission_text=EAST)
    bench.call("hold")
    refused = operator.set(mission_text=TIGHT)
    assert refused.startswith("mission_text: subpath 1 (arc)") and "at least 4.21 m" in refused
    assert operator.set(mission_text="version: 1\nnme: x\n").startswith("mission_text: ")
    assert operator.status()["mission"] == "north", "what is refused changes nothing"
    assert operator.set(mission_text=EAST) == ""
    bench.until_newest(topics.PATH, lambda path: abs(path.poses[-1].pose.position.x - 80.0) < 1e-6)
    bench.until_newest(topics.GEOFENCE, lambda fence: len(fence.polygon.points) == 0)
    bench.until_newest(topics.ORIGIN, lambda origin: origin.status.status == -1)  # it has none
    assert operator.step(1.0, 2.0, math.pi / 2) == 0.0
    bench.call("resume")
    assert operator.step(0.0, 3.0, math.pi / 2) == 6.48
    assert bench.values(topics.DESIRED_YAW)[-1] == pytest.approx(0.0, abs=0.1), "east is yaw 0"
    operator.shows(mission="east", state="running")
    bench.until_newest(topics.MISSION_STATUS, lambda status: values_of(status)["begun at [s]"])
    bench.call("abort")
    assert operator.set(mission="paper_composite") == ""
    assert operator.node.get_parameter("mission_text").value == "", "the file takes the text's place"
    operator.shows(mission="paper_composite")


def test_the_flown_share_leaves_out_what_a_later_beginning_leaves_out(operator: Operator) -> None:
    assert "expected a subpath from 1 to 2" in operator.set(start_at="subpath 3")
    assert "expected 'subpath 3', '120 m', or nothing" in operator.set(start_at="half way")
    assert "less than the path's 200.0 m" in operator.set(start_at="200 m")
    assert operator.set(start_at="150 m") == ""
    operator.bench.call("start")
    for north in range(149, 190, 1):
        operator.step(float(north))
    assert operator.bench.values(topics.PATH_PARAMETER)[-1] == pytest.approx(1.88, abs=0.05)
    share = pytest.approx(0.19, abs=0.03)
    operator.bench.until_newest(
        topics.MISSION_STATUS, lambda status: float(values_of(status)["flown share"]) == share
    )


def goal(north: float, east: float, frame: str = "map") -> PoseStamped:
    message = PoseStamped()
    message.header.frame_id = frame
    message.pose.position.x, message.pose.position.y = east, north
    message.pose.orientation.z, message.pose.orientation.w = math.sin(math.pi / 4), math.cos(math.pi / 4)
    return message


def test_a_goal_is_flown_to_if_the_parameter_allows_it(bench: Bench) -> None:
    operator = Operator(bench)
    sender = bench.node.create_publisher(PoseStamped, "goal_pose", qos.offered(topics.GOAL_POSE))
    bench.until(sender.get_subscription_count)
    sender.publish(goal(120.0, 60.0))
    bench.until(lambda: operator.was_refused("the parameter accept_goal is false"))
    operator.set(accept_goal=True)
    sender.publish(goal(120.0, 60.0))
    bench.until(lambda: operator.was_refused("expected an odometry of the vehicle"))
    bench.call("start")
    operator.step(10.0)
    sender.publish(goal(120.0, 60.0))
    bench.until(lambda: operator.was_refused("a change while a mission is running"))
    bench.call("hold")
    operator.step(11.0)
    sender.publish(goal(120.0, 60.0, "odom"))
    bench.until(lambda: operator.was_refused("frame_id 'odom'"))
    sender.publish(goal(120.0, 60.0))
    # Found by its last place: the goal's path is the newest, however many came before it.
    path = bench.until_newest(topics.PATH, lambda path: abs(path.poses[-1].pose.position.x - 60.0) < 1e-6)
    first, *_, last = [pose.pose.position for pose in path.poses]
    assert (first.x, first.y, last.x, last.y) == pytest.approx((0.0, 11.0, 60.0, 120.0), abs=1e-6)
    assert bench.call("resume").success
    assert operator.step(11.0) == 6.48
    operator.shows(mission="goal")
