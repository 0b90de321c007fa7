"""The check checked: every planted mistake over ROS 2, all vehicles at once, paced by their own /clock."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import rclpy
from rclpy.experimental import EventsExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rich.console import Console
from rosgraph_msgs.msg import Clock

from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.contract.conversions import set_stamp
from auv_msgs_py.node.graph_look import GraphLook
from auv_path_following import vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.patience import PATIENCE
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.live.listener import VehicleListener
from auv_sim.checks.vehicle_check.live.planted_diver_driver import PlantedDiverDriver
from auv_sim.checks.vehicle_check.live.planted_driver import PlantedDriver
from auv_sim.checks.vehicle_check.live.small_test import SmallTest
from auv_sim.checks.vehicle_check.planted import PLANTED, Planted
from auv_sim.checks.vehicle_check.planted_divers import PLANTED_DIVERS, PlantedDiver
from auv_sim.checks.vehicle_check.verdict import Mistake
from auv_sim.checks.vehicle_check.wiggle import FAREWELL
from auv_sim.checks.vehicle_check.wiggle_dive import END as END_OF_DIVE
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED
from auv_sim.terminal import headed_table

_BEGIN, _STEP = 100.0, 0.05
#: Wall time for one step's messages to arrive, s.
_ARRIVAL = 10.0
#: A subscription that was matched just now may miss the first message.
_ATTEMPTS = 10


#: A driver in the plane, or one that dives.
AnyPlanted = Planted | PlantedDiver


class Arrivals:
    """Messages on their way to the other end.

    Args:
        sent: returns how many were sent.
        heard: returns how many have arrived.
    """

    def __init__(self, sent: Callable[[], int], heard: Callable[[], int]) -> None:
        self._sent, self._heard, self._lost = sent, heard, 0

    def are_complete(self) -> bool:
        """Return whether all have arrived but those that count as lost."""
        return self._heard() >= self._sent() - self._lost

    def give_up(self) -> None:
        """Count as lost what has not arrived: no later step waits for it."""
        self._lost = max(0, self._sent() - self._heard())


class _Examinee:
    """A planted vehicle, its listener and its small test."""

    def __init__(self, planted: AnyPlanted, hull: Vehicle, drivers: Node, checks: Node) -> None:
        self.planted = planted
        self.driver: PlantedDriver | PlantedDiverDriver
        if isinstance(planted, PlantedDiver):
            self.driver = PlantedDiverDriver(drivers, planted, hull, _BEGIN)
        else:
            self.driver = PlantedDriver(drivers, planted, hull, _BEGIN)
        self.listener = VehicleListener(checks, self.driver.namespace, False, hull.dives)
        self.test = SmallTest(self.listener, hull)
        self.measured = Arrivals(lambda: self.driver.sent, self._measurements)
        self.commanded = Arrivals(self._commands, lambda: self.driver.heard)

    def _measurements(self) -> int:
        heard = self.listener.recording
        state = heard.sternplane_state if isinstance(self.planted, PlantedDiver) else heard.rudder_state
        return min(len(heard.odom), len(heard.odom if self.planted.bare else state))

    def _commands(self) -> int:
        """Return how many commands were sent that the driver can hear with its mistake."""
        deaf = isinstance(self.planted, Planted) and self.planted.latched_commands
        return 0 if deaf else len(self.listener.recording.thrust_cmd)


def _look_around(node: Node, executor: EventsExecutor) -> None:
    """Look for another /clock first: a mission may be flying in this domain.

    Raises:
        GraphTaken: there is one.
    """
    claim = Claim(holder="check_vehicle --self-test", namespace="/", names=(), clock=True)
    look = GraphLook(node, claim)
    while not look.ended():
        executor.spin_once(timeout_sec=0.02)


class _Graph:
    """Drivers and checks as two participants: one of them cannot have two types on one topic."""

    def __init__(self) -> None:
        self._contexts = [rclpy.Context() for _ in range(2)]
        for context in self._contexts:
            rclpy.init(args=[], context=context, signal_handler_options=SignalHandlerOptions.NO)
        clock = Parameter("use_sim_time", value=True)
        plain: dict[str, Any] = {"start_parameter_services": False, "use_global_arguments": False}
        self.drivers = Node("planted_driver", context=self._contexts[0], **plain)
        self.checks = Node("check_vehicle", context=self._contexts[1], parameter_overrides=[clock], **plain)
        self.driving, self.checking = (EventsExecutor(context=context) for context in self._contexts)
        self.driving.add_node(self.drivers)
        self.checking.add_node(self.checks)

    def close(self) -> None:
        """Leave the graph."""
        for node in (self.drivers, self.checks):
            node.destroy_node()
        for context in self._contexts:
            context.try_shutdown()


def _until(condition: Callable[[], bool], patience: float, *executors: EventsExecutor) -> None:
    """Spin until the condition holds, for `patience` s of wall time at most."""
    deadline = time.monotonic() + patience
    while not condition() and time.monotonic() < deadline:
        for executor in executors:
            executor.spin_once(timeout_sec=0.005)


def find_all(
    planted: Sequence[AnyPlanted], hull: Vehicle, progress: Callable[[float], None] = lambda _: None
) -> dict[str, set[Mistake]]:
    """Check simulated vehicles over ROS 2, each with its mistake.

    Args:
        planted: the drivers, of the vehicle's kind.
        hull: the vehicle.
        progress: called with the share of the work that is done.

    Returns:
        Name of the driver -> what was found.

    Raises:
        GraphTaken: another /clock is published in this domain.
    """
    graph = _Graph()
    try:
        _look_around(graph.drivers, graph.driving)
        clock = graph.drivers.create_publisher(Clock, "/clock", 10)
        examinees = [_Examinee(p, hull, graph.drivers, graph.checks) for p in planted]

        def is_matched() -> bool:
            return all(one.driver.is_ready() for one in examinees) and clock.get_subscription_count() > 0

        _until(is_matched, PATIENCE, graph.driving, graph.checking)
        _drive(examinees, graph, clock, progress)
        recordings = [one.listener.finish(_BEGIN, sim_time=True) for one in examinees]
    finally:
        graph.close()
    return {
        one.planted.name: mistakes(check(recording, one.planted.file(hull)))
        for one, recording in zip(examinees, recordings, strict=True)
    }


def _drive(
    examinees: Sequence[_Examinee], graph: _Graph, clock: Any, progress: Callable[[float], None]
) -> None:
    """Run all small tests: time, measurements, commands, each step when the one before has arrived."""
    now, is_going, message = _BEGIN, True, Clock()

    def is_on_time() -> bool:
        return examinees[0].listener.now() >= now - 1e-6

    while is_going:
        set_stamp(message.clock, round(now * 1e9))
        for _ in range(_ATTEMPTS):
            clock.publish(message)
            _until(is_on_time, _ARRIVAL, graph.checking)
            if is_on_time():
                break
        for one in examinees:
            one.driver.live(now)
        _arrive([one.measured for one in examinees], graph.checking)
        ticks = [one.test.tick() for one in examinees]
        is_going = all(ticks)
        _arrive([one.commanded for one in examinees], graph.driving)
        now += _STEP
        progress((now - _BEGIN) / (END_OF_DIVE + FAREWELL))


def _arrive(messages: Sequence[Arrivals], executor: EventsExecutor) -> None:
    """Spin until all messages have arrived; what is late counts as lost."""
    _until(lambda: all(one.are_complete() for one in messages), _ARRIVAL, executor)
    for one in messages:
        one.give_up()


def self_test(console: Console, hull: Vehicle) -> int:
    """Check every planted mistake and print what was found; return the exit code.

    Args:
        console: of the terminal.
        hull: the vehicle of one kind; the other kind is checked with a shipped vehicle.
    """
    begin = time.monotonic()
    planar = hull if not hull.dives else vehicle.load("remus100")
    diver = hull if hull.dives else vehicle.load("remus100_6dof")
    found: dict[str, set[Mistake]] = {}
    with console.status("checking simulated vehicles") as status:
        for kind, drivers, one in (("planar", PLANTED, planar), ("diving", PLANTED_DIVERS, diver)):

            def show(share: float, kind: str = kind) -> None:
                status.update(f"checking simulated {kind} vehicles: {share:.0%}")

            found |= find_all(drivers, one, show)
    everyone: tuple[AnyPlanted, ...] = (*PLANTED, *PLANTED_DIVERS)
    table = headed_table("one mistake each", ("driver", "verdict", "found"))
    wrong = 0
    for planted in everyone:
        right = found[planted.name] == ({planted.mistake} if planted.mistake else set())
        wrong += not right
        names = "; ".join(sorted(mistake.value for mistake in found[planted.name])) or "nothing"
        table.add_row(planted.name, "[green]ok[/green]" if right else "[bold red]missed[/bold red]", names)
    console.print(table)
    console.print(
        f"{len(everyone) - wrong} of {len(everyone)} as they should be, {time.monotonic() - begin:.0f} s"
    )
    return EXIT_FAILED if wrong else EXIT_DONE
