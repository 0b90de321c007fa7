"""The check checked: every planted mistake over ROS 2, all vehicles at once, paced by their own /clock."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from nav_msgs.msg import Odometry
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from rich.console import Console
from rich.table import Table
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64

from auv_msgs_py.contract import qos
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import set_stamp
from auv_msgs_py.node.graph_look import GraphLook
from auv_msgs_py.values.types import Command
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.listener import VehicleListener
from auv_sim.checks.vehicle_check.planted import PLANTED, Planted, PlantedVehicle
from auv_sim.checks.vehicle_check.samples import OdometrySample, WaterSample
from auv_sim.checks.vehicle_check.verdict import Mistake
from auv_sim.checks.vehicle_check.wiggle import END, FAREWELL
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED

_BEGIN, _STEP = 100.0, 0.05
#: Wall time for all to find each other, and for one step's messages to arrive, s.
_DISCOVERY, _ARRIVAL = 30.0, 2.0
_DEPTH = 100
#: A subscription that was matched just now may miss the first message.
_ATTEMPTS = 10


class PlantedDriver:
    """A planted vehicle on ROS topics of its own namespace.

    Args:
        node: whose publishers and subscriptions are used.
        planted: the mistake.
        hull: the vehicle.
    """

    def __init__(self, node: Node, planted: Planted, hull: Vehicle) -> None:
        self.planted = planted
        self.namespace = f"/{planted.name.replace('-', '_')}"
        self.vehicle = PlantedVehicle(planted, hull, _BEGIN)
        self.sent = 0
        self.heard = 0
        self._rudder = 0.0
        self._water_type = qos.message_class(planted.water_type)
        self._odometry = node.create_publisher(Odometry, f"{self.namespace}/odom", _DEPTH)
        self._water = node.create_publisher(
            self._water_type, f"{self.namespace}/velocity_through_water", _DEPTH
        )
        self._state = (
            None if planted.bare else node.create_publisher(Float64, f"{self.namespace}/rudder_state", _DEPTH)
        )
        profile = QoSProfile(depth=_DEPTH)
        if planted.latched_commands:
            profile.durability = DurabilityPolicy.TRANSIENT_LOCAL
        node.create_subscription(Float64, f"{self.namespace}/rudder_cmd", self._on_rudder, profile)
        node.create_subscription(Float64, f"{self.namespace}/thrust_cmd", self._on_thrust, profile)

    def _on_rudder(self, message: Float64) -> None:
        self._rudder = message.data

    def _on_thrust(self, message: Float64) -> None:
        self.heard += 1
        self.vehicle.order(Command(self._rudder, message.data))

    def ready(self) -> bool:
        """Whether its topics are matched, as far as the mistake allows."""
        publishers = (self._odometry, self._state) if self._state is not None else (self._odometry,)
        return all(publisher.get_subscription_count() for publisher in publishers)

    def live(self, until: float) -> None:
        """Let time pass and publish."""
        for odometry, water, rudder in self.vehicle.live(until):
            self._odometry.publish(_odometry(odometry))
            self._water.publish(_water(self._water_type, water))
            if self._state is not None:
                self._state.publish(Float64(data=rudder))
            self.sent += 1


def _odometry(sample: OdometrySample) -> Odometry:
    message = Odometry()
    set_stamp(message.header.stamp, round(sample.stamp * 1e9))
    message.header.frame_id, message.child_frame_id = sample.frame, sample.child
    pose, twist = message.pose.pose, message.twist.twist
    pose.position.x, pose.position.y = sample.x, sample.y
    q = pose.orientation
    q.x, q.y, q.z, q.w = sample.orientation
    twist.linear.x, twist.linear.y, twist.angular.z = sample.u, sample.v, sample.r
    message.pose.covariance[0:36:7] = sample.pose_covariance
    return message


def _water(kind: type[Any], sample: WaterSample) -> Any:
    message = kind()
    set_stamp(message.header.stamp, round(sample.stamp * 1e9))
    message.header.frame_id = sample.frame
    twist = message.twist.twist if hasattr(message.twist, "twist") else message.twist
    twist.linear.x, twist.linear.y = sample.u, sample.v
    return message


class _Fleet:
    """All drivers and their listeners, and what has to have arrived before time goes on."""

    def __init__(self, drivers: list[PlantedDriver], listeners: list[VehicleListener]) -> None:
        self._pairs = list(zip(drivers, listeners, strict=True))
        self.now = _BEGIN

    def knows_the_time(self) -> bool:
        return self._pairs[0][1].now() >= self.now - 1e-6

    def measured(self) -> bool:
        return all(
            len(listener.recording.odom) >= driver.sent
            and (driver.planted.bare or len(listener.recording.rudder_state) >= driver.sent)
            for driver, listener in self._pairs
        )

    def commanded(self) -> bool:
        return all(
            driver.heard >= len(listener.recording.thrust_cmd) or driver.planted.latched_commands
            for driver, listener in self._pairs
        )


def _matched(drivers: list[PlantedDriver], clock: Any) -> bool:
    return all(driver.ready() for driver in drivers) and clock.get_subscription_count() > 0


def _look_around(node: Node, executor: EventsExecutor) -> None:
    """Look for another /clock first: a mission may be flying in this domain.

    Raises:
        GraphTaken: there is one.
    """
    claim = Claim(holder="check_vehicle --self-test", namespace="/", names=(), clock=True)
    look = GraphLook(node, claim)
    while not look.ended():
        executor.spin_once(timeout_sec=0.02)


def find_all(
    planted: Sequence[Planted], hull: Vehicle, progress: Callable[[float], None] | None = None
) -> dict[str, set[Mistake]]:
    """Check simulated vehicles over ROS 2, each with its mistake.

    Args:
        planted: the drivers.
        hull: the vehicle.
        progress: called with the share of the work that is done.

    Returns:
        Name of the driver -> what was found.
    """
    # Two participants, as between processes: one of them cannot have two types on one topic.
    contexts = [rclpy.Context() for _ in range(2)]
    for context in contexts:
        rclpy.init(args=[], context=context, signal_handler_options=SignalHandlerOptions.NO)
    clock = Parameter("use_sim_time", value=True)
    plain: dict[str, Any] = {"start_parameter_services": False, "use_global_arguments": False}
    drivers_node = Node("planted_driver", context=contexts[0], **plain)
    check_node = Node("check_vehicle", context=contexts[1], parameter_overrides=[clock], **plain)
    driving, checking = (EventsExecutor(context=context) for context in contexts)
    driving.add_node(drivers_node)
    checking.add_node(check_node)

    def until(condition: Callable[[], bool], patience: float, *executors: EventsExecutor) -> None:
        deadline = time.monotonic() + patience
        while not condition() and time.monotonic() < deadline:
            for executor in executors:
                executor.spin_once(timeout_sec=0.005)

    try:
        _look_around(drivers_node, driving)
        tell_time = drivers_node.create_publisher(Clock, "/clock", 10)
        drivers = [PlantedDriver(drivers_node, p, hull) for p in planted]
        listeners = [VehicleListener(check_node, driver.namespace, hull) for driver in drivers]
        until(lambda: _matched(drivers, tell_time), _DISCOVERY, driving, checking)
        fleet = _Fleet(drivers, listeners)
        going, message = True, Clock()
        while going:
            set_stamp(message.clock, round(fleet.now * 1e9))
            for _ in range(_ATTEMPTS):
                tell_time.publish(message)
                until(fleet.knows_the_time, _ARRIVAL, checking)
                if fleet.knows_the_time():
                    break
            for driver in drivers:
                driver.live(fleet.now)
            until(fleet.measured, _ARRIVAL, checking)
            ticks = [listener.tick() for listener in listeners]
            going = all(ticks)
            until(fleet.commanded, _ARRIVAL, driving)
            fleet.now += _STEP
            if progress is not None:
                progress((fleet.now - _BEGIN) / (END + FAREWELL))
        recordings = [listener.finish(_BEGIN, sim_time=True) for listener in listeners]
    finally:
        for node in (drivers_node, check_node):
            node.destroy_node()
        for context in contexts:
            context.try_shutdown()
    return {
        driver.planted.name: mistakes(check(recording, driver.planted.file(hull)))
        for driver, recording in zip(drivers, recordings, strict=True)
    }


def self_test(console: Console, hull: Vehicle) -> int:
    """Every planted mistake, and a table of what was found; returns the exit code."""
    begin = time.monotonic()
    with console.status("checking simulated vehicles") as status:
        found = find_all(
            PLANTED, hull, lambda share: status.update(f"checking simulated vehicles: {share:.0%}")
        )
    table = Table(title="one mistake each", title_justify="left")
    for heading in ("driver", "verdict", "found"):
        table.add_column(heading)
    wrong = 0
    for planted in PLANTED:
        right = found[planted.name] == ({planted.mistake} if planted.mistake else set())
        wrong += not right
        names = "; ".join(sorted(mistake.value for mistake in found[planted.name])) or "nothing"
        table.add_row(planted.name, "[green]ok[/green]" if right else "[bold red]missed[/bold red]", names)
    console.print(table)
    console.print(
        f"{len(PLANTED) - wrong} of {len(PLANTED)} as they should be, {time.monotonic() - begin:.0f} s"
    )
    return EXIT_FAILED if wrong else EXIT_DONE
