"""A vehicle of another author dives: its own model and integration, its own clock, NED, messages out of step.

Nothing of the simulator is used. It paces itself by the commands that arrive, not by this machine's speed.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.experimental import EventsExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from auv_path_following import vehicle
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.checks.vehicle_check.items.all_items import check
from auv_sim.checks.vehicle_check.live.listener import VehicleListener
from auv_sim.checks.vehicle_check.live.small_test import SmallTest
from auv_sim.checks.vehicle_check.verdict import Level

MISSION = Path(__file__).parent / "data" / "short_dive.yaml"
SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
CURRENT = np.array([0.1, -0.1, 0.02])


@dataclass(frozen=True)
class Habits:
    """Habits of this author: rate, Hz; first stamp, s; age of stamps, s; depth, m; speed, m/s; noise, rad."""

    rate: float = 12.5
    begin: float = 4000.0
    lag: float = 0.0
    depth: float = 3.0
    speed: float = 1.0
    vertical: bool = True
    roll_noise: float = 0.0
    jitter: float = 0.0
    water_every: int = 2
    frames: tuple[str, str] = ("odom_ned", "base_link_fsd")


class Torpedo:
    """A torpedo in NED/FRD with a rotation matrix as attitude."""

    def __init__(self, depth: float, speed: float) -> None:
        self.place = np.array([0.0, 0.0, depth])
        self.axes = np.eye(3)
        self.u, self.w, self.q, self.r = speed, 0.0, 0.0, 0.0
        self.rudder = self.planes = 0.0

    def move(self, rudder: float, planes: float, thrust: float, dt: float) -> None:
        count = max(1, round(dt / 0.005))
        h = dt / count
        for _ in range(count):
            self.rudder += np.clip(rudder - self.rudder, -0.26 * h, 0.26 * h)
            self.planes += np.clip(planes - self.planes, -0.26 * h, 0.26 * h)
            square, nose = self.u * abs(self.u), -self.axes[2, 0]
            self.u += h * (thrust - 1.7 * square) / 32.0
            self.w += h * (-1.5 * self.u * self.w + 0.3 * self.u * self.q - 0.1 * square * self.planes - 0.02)
            self.q += h * (-0.7 * square * self.planes - 1.3 * self.u * self.q - 0.6 * nose)
            self.r += h * (-0.7 * square * self.rudder - 1.3 * self.u * self.r)
            roll = math.atan2(self.axes[2, 1], self.axes[2, 2])
            p = -2.0 * (roll + 0.06)
            turn = np.array([[0.0, -self.r, self.q], [self.r, 0.0, -p], [-self.q, p, 0.0]])
            self.place = self.place + h * (self.axes @ [self.u, 0.0, self.w] + CURRENT)
            axes = self.axes @ (np.eye(3) + h * turn + 0.5 * h * h * turn @ turn)
            self.axes = 1.5 * axes - 0.5 * axes @ axes.T @ axes  # orthogonal to the third order


def quaternion(axes: np.ndarray) -> np.ndarray:
    """(x, y, z, w) of a rotation matrix."""
    w = 0.5 * math.sqrt(max(1.0 + np.trace(axes), 1e-9))
    return np.array(
        [axes[2, 1] - axes[1, 2], axes[0, 2] - axes[2, 0], axes[1, 0] - axes[0, 1], 4.0 * w * w]
    ) / (4.0 * w)


class ForeignDiver:
    """The torpedo's driver."""

    def __init__(self, habits: Habits) -> None:
        self.habits, self.body = habits, Torpedo(habits.depth, habits.speed)
        self.node = rclpy.create_node("torpedo", namespace="/auv")
        self.now, self.count, self.state = habits.begin, 0, ""
        self.dice = np.random.default_rng(3)
        self.track: list[np.ndarray] = []
        self.commands: dict[str, float] = {}
        self.clock = self.node.create_publisher(Clock, "/clock", 10)
        self.odom = self.node.create_publisher(Odometry, "odom", SENSOR)
        self.water = self.node.create_publisher(TwistWithCovarianceStamped, "velocity_through_water", SENSOR)
        for name in ("rudder_cmd", "sternplane_cmd", "thrust_cmd"):
            self.node.create_subscription(Float64, name, self._take(name), 10)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.node.create_subscription(String, "mission_state", self._on_state, latched)

    def _take(self, name: str) -> Callable[[Float64], None]:
        return lambda message: self.commands.__setitem__(name, message.data)

    def _on_state(self, message: String) -> None:
        self.state = message.data

    def _stamp(self, stamp: Any, seconds: float) -> None:
        ns = round(max(seconds, 0.0) * 1e9)
        stamp.sec, stamp.nanosec = ns // 10**9, ns % 10**9

    def sense(self) -> None:
        """Publish the time, every second time the log, and the odometry."""
        h, body = self.habits, self.body
        self.commands.clear()
        clock, odom = Clock(), Odometry()
        self._stamp(clock.clock, self.now)
        self.clock.publish(clock)
        self._stamp(odom.header.stamp, self.now - h.lag)
        odom.header.frame_id, odom.child_frame_id = h.frames
        place, q, twist = odom.pose.pose.position, odom.pose.pose.orientation, odom.twist.twist
        place.x, place.y, place.z = body.place.tolist()
        roll = self.dice.normal(0.0, h.roll_noise) if h.roll_noise else 0.0
        c, s = math.cos(roll), math.sin(roll)
        axes = body.axes @ np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        q.x, q.y, q.z, q.w = quaternion(axes).tolist()
        over_ground = np.array([body.u, 0.0, body.w]) + body.axes.T @ CURRENT
        twist.linear.x, twist.linear.y, twist.linear.z = over_ground.tolist()
        twist.angular.y, twist.angular.z = float(body.q), float(body.r)
        if not h.vertical:
            twist.linear.z = math.nan
        self.odom.publish(odom)
        if self.count % h.water_every == 0:
            water = TwistWithCovarianceStamped()
            water.header.stamp, water.header.frame_id = odom.header.stamp, h.frames[1]
            linear = water.twist.twist.linear
            linear.x, linear.z = float(body.u), float(body.w) if h.vertical else math.nan
            self.water.publish(water)
        self.count += 1
        self.track.append(body.place.copy())

    def act(self) -> None:
        """Move on under the newest commands; none means stop."""
        names = ("rudder_cmd", "sternplane_cmd", "thrust_cmd")
        dt = (1.0 + self.habits.jitter * self.dice.uniform(-1.0, 1.0)) / self.habits.rate
        self.body.move(*(self.commands.get(name, 0.0) for name in names), dt)
        self.now += dt


@pytest.fixture
def ros(domain: int) -> Iterator[None]:
    rclpy.init(args=[], domain_id=domain)
    yield
    rclpy.try_shutdown()


def fly(habits: Habits, mission: Path = MISSION) -> np.ndarray:
    """The track of a whole mission, shape (n, 3), m, NED."""
    torpedo = ForeignDiver(habits)
    own = [Parameter("use_sim_time", value=True), Parameter("vehicle", value="remus100_6dof")]
    shared: dict[str, Any] = {"namespace": "/auv", "use_global_arguments": False}
    nodes = [
        CurrentObserverNode(parameter_overrides=own, **shared),
        GuidanceNode(parameter_overrides=[*own, Parameter("mission", value=str(mission))], **shared),
        HeadingAutopilotNode(parameter_overrides=own, **shared),
    ]
    executor = EventsExecutor()
    for node in (torpedo.node, *nodes):
        executor.add_node(node)

    def until(condition: Callable[[], bool], patience: float = 180.0) -> bool:
        deadline = time.monotonic() + patience
        while not condition() and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.02)
        return condition()

    try:
        assert until(lambda: torpedo.odom.get_subscription_count() == 3)
        start = torpedo.node.create_client(Trigger, "start")
        assert until(start.service_is_ready)
        start.call_async(Trigger.Request())
        assert until(lambda: torpedo.state == "running")
        unanswered = 0
        while torpedo.state == "running":
            torpedo.sense()
            unanswered += not until(lambda: len(torpedo.commands) == 3, 2.0)
            assert unanswered < 10, "commands are missing"
            torpedo.act()
            assert len(torpedo.track) < 120.0 * habits.rate, "the mission does not end"
        assert torpedo.state == "complete"
        return np.array(torpedo.track)
    finally:
        for node in (torpedo.node, *nodes):
            node.destroy_node()


def test_a_foreign_vehicle_flies_a_mission_with_depths(ros: None) -> None:
    track = fly(Habits())
    north, east, depth = track.T
    assert depth.max() == pytest.approx(5.0, abs=0.2)
    turn = (north > 20.0) & (east < 20.0)
    assert np.abs(np.hypot(north[turn] - 20.0, east[turn] - 20.0) - 20.0).max() < 1.0
    assert np.hypot(north[-1] - 40.0, east[-1] - 40.0) < 5.0


def examined(habits: Habits) -> set[tuple[str, Level]]:
    """What the small test finds that does not pass."""
    hull, torpedo = vehicle.load("remus100_6dof"), ForeignDiver(habits)
    node = rclpy.create_node("check_vehicle", parameter_overrides=[Parameter("use_sim_time", value=True)])
    listener = VehicleListener(node, "/auv", hears_commands=False, dives=True)
    small_test, heard = SmallTest(listener, hull), listener.recording
    executor = EventsExecutor()
    for each in (torpedo.node, node):
        executor.add_node(each)

    def until(condition: Callable[[], bool], patience: float) -> None:
        deadline = time.monotonic() + patience
        while not condition() and time.monotonic() < deadline:
            executor.spin_once(timeout_sec=0.01)

    def step() -> bool:
        """Sense, and return whether time and odometry have arrived."""
        before = len(heard.odom)
        torpedo.sense()
        until(lambda: len(heard.odom) > before and listener.now() >= torpedo.now - 1e-6, 1.0)
        return len(heard.odom) > before and listener.now() >= torpedo.now - 1e-6

    try:
        while not step():  # both ends find each other
            torpedo.now += 0.08
        heard.odom.clear()
        heard.water.clear()
        begin = listener.now()
        torpedo.act()
        step()
        while small_test.tick():
            until(lambda: len(torpedo.commands) == 3, 1.0)
            torpedo.act()
            step()
        assert small_test.cut_short == ""
        verdicts = check(listener.finish(begin, sim_time=True), hull)
        return {(v.item, v.level) for v in verdicts if v.level is not Level.PASS}
    finally:
        for each in (torpedo.node, node):
            each.destroy_node()


def test_the_check_passes_it_at_rest_and_without_vertical_velocities(ros: None) -> None:
    assert examined(Habits(speed=0.0, depth=5.0, vertical=False)) == set()
