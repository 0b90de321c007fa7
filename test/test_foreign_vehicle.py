"""A foreign simulator drives the nodes as they run on a vehicle: best effort, no lockstep, its own /clock.

It paces itself by the answers it gets, so the outcome does not depend on how fast this machine is.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from geometry_msgs.msg import TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from rclpy.experimental import EventsExecutor
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.conversions import fill_odometry, fill_water_velocity, set_stamp
from auv_msgs_py.values.types import Command, Current
from auv_path_following import vehicle
from auv_path_following.missions import mission_file
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.flight.scenario import start_of
from auv_sim.vehicle.simulated import SimulatedVehicle

CURRENT = Current(0.1, -0.1)
SENSOR = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)


class ForeignVehicle:
    """A plant behind the contract's topics, as another author would write it.

    Args:
        mission: where it starts.
        rate: odometries per second.
        frames: what it calls its world and its body.
    """

    def __init__(self, mission: Path, rate: float, frames: tuple[str, str]) -> None:
        self.node = rclpy.create_node("foreign_vehicle", namespace="/auv")
        start = start_of(mission_file.load(str(mission)).path)
        self.plant = SimulatedVehicle(vehicle.load("remus100"), start, current=CURRENT)
        self.step = 1.0 / rate
        self.stamp = topics.FIRST_STAMP_NS
        self.state = ""
        self.track: list[tuple[float, float]] = []
        self.odometry, self.water = Odometry(), TwistWithCovarianceStamped()
        self.odometry.header.frame_id, self.odometry.child_frame_id = frames
        self.water.header.frame_id = frames[1]
        self._commands: dict[str, float] = {}
        self._clock = self.node.create_publisher(Clock, "/clock", 10)
        self._odometry = self.node.create_publisher(Odometry, "odom", SENSOR)
        self._water = self.node.create_publisher(TwistWithCovarianceStamped, "velocity_through_water", SENSOR)
        for name in ("rudder_cmd", "thrust_cmd"):
            self.node.create_subscription(Float64, name, self._on_command(name), 10)
        self.node.create_subscription(
            String, "mission_state", self._on_state, qos.requested(topics.MISSION_STATE, reliable=True)
        )

    def _on_command(self, name: str) -> Any:
        return lambda message: self._commands.__setitem__(name, message.data)

    def _on_state(self, message: String) -> None:
        self.state = message.data

    def ready(self) -> bool:
        """All three nodes hear the odometry, two of them the water velocity."""
        matched = self._odometry.get_subscription_count(), self._water.get_subscription_count()
        return matched == (3, 2)

    def sense(self) -> None:
        self._commands.clear()
        clock = Clock()
        set_stamp(clock.clock, self.stamp)
        u, v = self.plant.ground_velocity
        fill_odometry(self.odometry, self.plant.navigation, u, v, self.stamp)
        fill_water_velocity(self.water, self.plant.water_velocity, self.stamp)
        self._clock.publish(clock)
        self._water.publish(self.water)
        self._odometry.publish(self.odometry)
        self.track.append(self.plant.motion[:2])

    def answered(self) -> bool:
        return len(self._commands) == 2

    def act(self) -> None:
        command = Command(self._commands.get("rudder_cmd", 0.0), self._commands.get("thrust_cmd", 0.0))
        self.plant.advance(command, self.step)
        self.stamp += round(self.step * 1e9)


@pytest.fixture
def ros(domain: int) -> Iterator[None]:
    rclpy.init(args=[], domain_id=domain)
    yield
    rclpy.try_shutdown()


def fly(mission: Path, rate: float, frames: tuple[str, str] = ("map", "base_link")) -> np.ndarray:
    """The track of a whole mission, shape (n, 2)."""
    foreign = ForeignVehicle(mission, rate, frames)
    clock = Parameter("use_sim_time", value=True)
    shared: dict[str, Any] = {"namespace": "/auv", "use_global_arguments": False}
    nodes = [
        CurrentObserverNode(parameter_overrides=[clock], **shared),
        GuidanceNode(parameter_overrides=[clock, Parameter("mission", value=str(mission))], **shared),
        HeadingAutopilotNode(parameter_overrides=[clock], **shared),
    ]
    executor = EventsExecutor()
    for node in (foreign.node, *nodes):
        executor.add_node(node)

    def until(condition: Any, patience: float = 180.0) -> bool:
        deadline = time.monotonic() + patience
        while not condition():
            if time.monotonic() > deadline:
                return False
            executor.spin_once(timeout_sec=0.02)
        return True

    try:
        assert until(foreign.ready)
        start = foreign.node.create_client(Trigger, "start")
        assert until(start.service_is_ready)
        start.call_async(Trigger.Request())
        assert until(lambda: foreign.state == "running")
        unanswered = 0
        while foreign.state == "running":
            foreign.sense()
            # Best effort may lose a message; the vehicle goes on all the same.
            unanswered += not until(foreign.answered, 2.0)
            foreign.act()
            assert len(foreign.track) < 200.0 * rate, "the mission does not end"
        assert foreign.state == "complete"
        assert unanswered <= 2
        return np.array(foreign.track)
    finally:
        for node in (foreign.node, *nodes):
            node.destroy_node()


def apart(track: np.ndarray, other: np.ndarray) -> float:
    """The largest distance from a track to another, m, wherever along it."""
    start, along = other[:-1], np.diff(other, axis=0)
    length = np.maximum((along**2).sum(axis=1), 1e-12)
    far = 0.0
    for point in track[::10]:
        t = np.clip(((point - start) * along).sum(axis=1) / length, 0.0, 1.0)
        far = max(far, float(np.hypot(*(start + t[:, None] * along - point).T).min()))
    return far


def test_the_rate_of_the_odometry_does_not_matter(short_mission: Path, ros: None) -> None:
    tracks = {rate: fly(short_mission, rate) for rate in (10.0, 20.0, 50.0)}
    assert apart(tracks[10.0], tracks[20.0]) < 0.05
    assert apart(tracks[50.0], tracks[20.0]) < 0.05


def test_ned_and_enu_vehicles_fly_the_same_track(short_mission: Path, ros: None) -> None:
    enu = fly(short_mission, 20.0, ("odom", "base_link"))
    ned = fly(short_mission, 20.0, ("torpedo/map_ned", "torpedo/base_link_frd"))
    assert apart(ned, enu) < 0.02
