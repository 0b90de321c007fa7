"""Each node by itself, over real DDS: a test bench plays the rest of the vehicle."""

from __future__ import annotations

import math
import time
from collections import defaultdict
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.experimental import EventsExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from auv_msgs_py import qos, topics
from auv_msgs_py.conversions import fill_odometry, fill_water_velocity, nanoseconds
from auv_msgs_py.errors import ConfigurationError
from auv_msgs_py.runtime import SuiteNode
from auv_msgs_py.topics import Topic
from auv_msgs_py.types import Navigation, WaterVelocity
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.nodes.plant_node import RemusPlantNode

ALL_NODES = (RemusPlantNode, CurrentObserverNode, GuidanceNode, HeadingAutopilotNode)


class Bench:
    """A node that publishes what the node under test needs and keeps what it answers."""

    def __init__(self) -> None:
        self.node = rclpy.create_node("bench", namespace="/auv")
        self.executor = EventsExecutor()
        self.executor.add_node(self.node)
        self.received: dict[str, list[Any]] = defaultdict(list)
        self._publishers: dict[str, Any] = {}
        self._under_test: list[SuiteNode] = []

    def start(self, make: Callable[..., SuiteNode], **parameters: Any) -> SuiteNode:
        """Create the node under test and wait until the bench is matched with it."""
        overrides = [Parameter(name.replace("__", "."), value=value) for name, value in parameters.items()]
        node = make(namespace="/auv", parameter_overrides=overrides, use_global_arguments=False)
        self._under_test.append(node)
        self.executor.add_node(node)
        for topic in topics.CONTRACT:
            if topic.publisher == node.get_name() or topic is topics.DIAGNOSTICS:
                self._listen(topic)
            elif node.get_name() in topic.subscribers:
                kind = qos.message_class(topic.type)
                self._publishers[topic.name] = self.node.create_publisher(
                    kind, topic.name, qos.offered(topic)
                )
        self.until(
            lambda: (
                all(publisher.get_subscription_count() for publisher in self._publishers.values())
                and all(publisher.get_subscription_count() for publisher in node.publishers_by_topic.values())
            )
        )
        return node

    def _listen(self, topic: Topic) -> None:
        kind = qos.message_class(topic.type)
        keep = self.received[topic.name].append
        self.node.create_subscription(kind, topic.name, keep, qos.requested(topic, reliable=True, depth=100))

    def until(self, condition: Callable[[], Any], patience: float = 20.0) -> None:
        deadline = time.monotonic() + patience
        while not condition():
            assert time.monotonic() < deadline, "the node did not do what was waited for"
            self.executor.spin_once(timeout_sec=0.02)

    def spin(self, seconds: float) -> None:
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            self.executor.spin_once(timeout_sec=0.02)

    def send(self, topic: Topic, message: Any) -> None:
        self._publishers[topic.name].publish(message)

    def odometry(
        self, seconds: float, navigation: Navigation, frames: tuple[str, str] = ("map", "base_link")
    ) -> None:
        message = Odometry()
        message.header.frame_id, message.child_frame_id = frames
        fill_odometry(message, navigation, 1.9, 0.0, round(seconds * 1e9))
        self.send(topics.ODOM, message)

    def water(self, seconds: float, ur: float, vr: float = 0.0, frame: str = "base_link") -> None:
        message = TwistWithCovarianceStamped()
        message.header.frame_id = frame
        fill_water_velocity(message, WaterVelocity(ur, vr), round(seconds * 1e9))
        self.send(topics.WATER_VELOCITY, message)

    def measurement(self, seconds: float, navigation: Navigation, ur: float, frames: tuple[str, str]) -> None:
        """Water velocity, then odometry: two topics, between which DDS keeps no order."""
        self.water(seconds, ur, frame=frames[1])
        self.spin(0.01)
        self.odometry(seconds, navigation, frames)

    def reference(self, yaw: float, rate: float, thrust: float) -> None:
        for topic, value in zip(
            (topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST),
            (yaw, rate, thrust),
            strict=True,
        ):
            self.send(topic, Float64(data=value))

    def call(self, service: str) -> Trigger.Response:
        client = self.node.create_client(Trigger, service)
        self.until(client.service_is_ready)
        future = client.call_async(Trigger.Request())
        self.until(future.done)
        return future.result()

    def values(self, topic: Topic) -> list[float]:
        return [message.data for message in self.received[topic.name]]

    def diagnosed(self, text: str) -> bool:
        arrays: list[DiagnosticArray] = self.received[topics.DIAGNOSTICS.name]
        return any(text in status.message for array in arrays for status in array.status)

    def close(self) -> None:
        for node in self._under_test:
            node.close()
            node.destroy_node()
        self.node.destroy_node()


@pytest.fixture
def bench(domain: int) -> Iterator[Bench]:
    rclpy.init(args=[], domain_id=domain)
    made = Bench()
    yield made
    made.close()
    rclpy.try_shutdown()


NORTHWARD = Navigation(0.0, 0.0, 0.0, 0.0)


def test_every_endpoint_has_the_contracts_quality_of_service(bench: Bench) -> None:
    for make in ALL_NODES:
        bench.start(make)
    for topic in topics.CONTRACT:
        name = bench.node.resolve_topic_name(topic.name)
        durability = DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE
        offered = [
            info
            for info in bench.node.get_publishers_info_by_topic(name)
            if info.node_name != "bench" and info.topic_type == topic.type
        ]
        assert offered, topic.name
        for info in offered:
            assert info.qos_profile.reliability is ReliabilityPolicy.RELIABLE, topic.name
            assert info.qos_profile.durability is durability, topic.name
        for info in bench.node.get_subscriptions_info_by_topic(name):
            if info.node_name in topic.subscribers:
                wanted = ReliabilityPolicy.RELIABLE if topic.latched else ReliabilityPolicy.BEST_EFFORT
                assert info.qos_profile.reliability is wanted, topic.name


def test_the_observer_finds_the_current(bench: Bench) -> None:
    bench.start(CurrentObserverNode)
    # 1 m/s to the north through water that itself goes 0.2 m/s to the east.
    for k in range(60):
        t = 1.0 + 0.25 * k
        bench.measurement(t, Navigation(1.0 * t, 0.2 * t, 0.0, 0.0), 1.0, ("map", "base_link"))
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > k)
    last = bench.received["current_estimate"][-1]
    assert last.header.frame_id == "map"
    assert (last.vector.x, last.vector.y) == pytest.approx((0.2, 0.0), abs=1e-3)


def test_a_vehicle_that_speaks_ned_gives_the_same_estimate(bench: Bench) -> None:
    bench.start(CurrentObserverNode)
    frames = ("auv1/odom_ned", "auv1/base_link_frd")
    for k in range(60):
        t = 1.0 + 0.25 * k
        bench.measurement(t, Navigation(1.0 * t, 0.2 * t, 0.0, 0.0), 1.0, frames)
        bench.until(lambda k=k: len(bench.received["current_estimate"]) > k)
    last = bench.received["current_estimate"][-1]
    assert (last.vector.x, last.vector.y) == pytest.approx((0.2, 0.0), abs=1e-3)


def test_unknown_frames_are_refused_with_both_names(bench: Bench) -> None:
    node = bench.start(CurrentObserverNode)
    for k in range(3):
        bench.odometry(1.0 + k, NORTHWARD, ("map", "base_link_frd"))
    bench.until(lambda: node.health.refused["odom"] == 3)
    node.health.publish()
    bench.until(lambda: bench.diagnosed("frame_id 'map' with child_frame_id 'base_link_frd'"))
    assert bench.received["current_estimate"] == []


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
def test_an_odometry_that_is_no_number_is_refused(bench: Bench, wrong: float) -> None:
    node = bench.start(HeadingAutopilotNode)
    bench.odometry(1.0, Navigation(wrong, 0.0, 0.0, 0.0))
    bench.until(lambda: node.health.refused["odom"] == 1)
    assert bench.values(topics.RUDDER_CMD) == []


def test_guidance_asks_for_nothing_before_the_start_and_for_thrust_after_it(bench: Bench) -> None:
    bench.start(GuidanceNode)
    bench.until(lambda: [m.data for m in bench.received["mission_state"]] == ["idle"])
    assert len(bench.received["path"]) == 1
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
    """Seen on the wire: right of a northward path the desired yaw (counter-clockwise) is larger than north's."""
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
    while bench.values(topics.THRUST_CMD)[-1] != 0.0:
        bench.odometry(1.0 + time.monotonic() - t + 0.01, NORTHWARD)
        bench.spin(0.05)
        assert time.monotonic() - t < 10.0
    assert bench.values(topics.RUDDER_CMD)[-1] == 0.0
    bench.until(lambda: bench.diagnosed("guidance is silent"))


def test_the_autopilot_stops_the_vehicle_when_odometry_falls_silent(bench: Bench) -> None:
    bench.start(HeadingAutopilotNode, odometry_timeout=0.3)
    bench.odometry(1.0, NORTHWARD)
    bench.reference(math.pi / 2, 0.0, 6.0)
    bench.until(lambda: bench.values(topics.THRUST_CMD) == [6.0])
    bench.until(lambda: bench.values(topics.THRUST_CMD)[-1] == 0.0)
    bench.until(lambda: bench.diagnosed("no odom: rudder and thrust are 0"))


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


def test_the_plant_waits_for_the_mission_and_begins_its_clock_at_one_second(bench: Bench) -> None:
    bench.start(RemusPlantNode, speed=50.0, initial__x=3.0, initial__y=4.0)
    bench.spin(0.3)
    assert bench.received["odom"] == []
    bench.send(topics.MISSION_STATE, qos.message_class(topics.MISSION_STATE.type)(data="running"))
    bench.until(lambda: len(bench.received["odom"]) > 3)
    first = bench.received["odom"][0]
    assert (first.header.stamp.sec, first.header.stamp.nanosec) == (1, 0)
    assert (first.pose.pose.position.x, first.pose.pose.position.y) == (4.0, 3.0)
    bench.call("reset")
    stamps = [nanoseconds(message.header.stamp) for message in bench.received["odom"]]
    bench.until(lambda: nanoseconds(bench.received["odom"][-1].header.stamp) < stamps[-1])


def test_gains_may_change_in_flight_and_wiring_may_not(bench: Bench) -> None:
    node = bench.start(HeadingAutopilotNode)

    def change(**values: Any) -> Any:
        parameters = [Parameter(name.replace("__", "."), value=value) for name, value in values.items()]
        return node.set_parameters_atomically(parameters)

    assert change(autopilot__nism__k1=0.5).successful
    assert node.autopilot.controller.config.k1 == 0.5
    for wrong in (-1.0, math.nan, 1e9):
        refused = change(autopilot__nism__k1=wrong)
        assert not refused.successful
        assert node.autopilot.controller.config.k1 == 0.5
    assert not change(lockstep=True).successful
    described = node.describe_parameter("autopilot.nism.k1")
    assert "[rad/s]" in described.description
    assert described.floating_point_range[0].to_value == 10.0
    assert node.describe_parameter("vehicle").read_only


def test_the_parameter_service_refuses_with_a_reason(bench: Bench) -> None:
    bench.start(GuidanceNode)
    client = bench.node.create_client(SetParametersAtomically, "ailos_guidance/set_parameters_atomically")
    bench.until(client.service_is_ready)
    request = SetParametersAtomically.Request(
        parameters=[Parameter("guidance.switching.mode", value="sometimes").to_parameter_msg()]
    )
    future = client.call_async(request)
    bench.until(future.done)
    result = future.result().result
    assert not result.successful
    assert "guidance.switching.mode: found 'sometimes', expected one of 'off', 'g0' or 'all'" in result.reason


@pytest.mark.parametrize(
    ("make", "parameters", "expected"),
    [
        (GuidanceNode, {"mission": "nowhere"}, "nowhere: found no such mission file"),
        (HeadingAutopilotNode, {"vehicle": "nowhere"}, "nowhere: found no such vehicle file"),
        (
            HeadingAutopilotNode,
            {"autopilot.nism.k1": "fast"},
            "autopilot.nism.k1: found 'fast', expected a number",
        ),
        (
            HeadingAutopilotNode,
            {"autopilot.nism.k1": -1.0},
            "autopilot.nism.k1: found -1.0, expected a number",
        ),
        (HeadingAutopilotNode, {"autopilot.nism.kk": 1.0}, "autopilot.nism.kk: found an unknown name"),
        (
            RemusPlantNode,
            {"body_frame": "base_link_frd"},
            "frame_id 'map' with child_frame_id 'base_link_frd'",
        ),
        (RemusPlantNode, {"step": 0.0}, "step: found 0.0, expected a number from 0.001"),
    ],
)
def test_a_parameter_that_cannot_be_used_is_named(
    bench: Bench, make: Callable[..., SuiteNode], parameters: dict[str, Any], expected: str
) -> None:
    overrides = [Parameter(name, value=value) for name, value in parameters.items()]
    with pytest.raises(ConfigurationError) as error:
        make(namespace="/auv", parameter_overrides=overrides, use_global_arguments=False)
    assert expected in str(error.value)
    assert "\n" not in str(error.value)
