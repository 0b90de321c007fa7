"""What `check_vehicle` does: listen to a vehicle, perhaps move it a little, print the verdicts."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

from auv_msgs_py.node.run import StopRequest, start_ros
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check import verdict_report
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.live.listener import VehicleListener
from auv_sim.checks.vehicle_check.live.small_test import SmallTest
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.checks.vehicle_check.verdict import Verdict
from auv_sim.checks.vehicle_check.wiggle import END, THRUST_SHARE
from auv_sim.checks.vehicle_check.wiggle_dive import END as END_OF_DIVE
from auv_sim.checks.vehicle_check.wiggle_dive import LARGEST_DIVE
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED
from auv_sim.terminal import console

#: Time for the discovery of a /clock, and longest standstill of ROS time, s of wall time.
_DISCOVERY, _STILL = 1.0, 10.0


def run(options: argparse.Namespace, arguments: list[str], consent_option: str) -> int:
    """Check the vehicle, or the check itself.

    Args:
        options: the command line's.
        arguments: its words, with those for ROS.
        consent_option: the option that lets the vehicle move.

    Returns:
        The exit code.

    Raises:
        ConfigurationError: a file or an option cannot be used, or another node sends commands.
    """
    hull = vehicle.load(options.vehicle)
    if options.self_test:
        from auv_sim.checks.vehicle_check.live.self_test import self_test

        return self_test(console(), hull)
    if options.wiggle:
        _ask(options.consent, consent_option, hull)
    elif options.consent:
        raise ConfigurationError(consent_option, "no --wiggle", "both: without it nothing moves")
    return _check(options, arguments, hull)


def _ask(consent: bool, consent_option: str, hull: Vehicle) -> None:
    """Ask for consent at the terminal unless it was given: the vehicle moves only with a person's word."""
    if consent:
        return
    if not sys.stdin.isatty():
        raise ConfigurationError(
            "--wiggle", "no terminal to ask at", f"{consent_option} as well, or a terminal"
        )
    seconds, planes = END, ""
    if hull.dives:
        seconds = END_OF_DIVE
        planes = f" stern planes up to 16 degrees, within {LARGEST_DIVE:g} m of its depth and"
    print(
        f"The vehicle will move for {seconds:g} s: {THRUST_SHARE:.0%} of its thrust, rudder up to 20 degrees,"
        f"{planes} within some 40 m."
    )
    try:
        answer = input("Type yes if it may: ").strip().lower()
    except EOFError:
        raise ConfigurationError("--wiggle", "no answer", "yes") from None
    if answer != "yes":
        raise ConfigurationError("--wiggle", "another answer", "yes")


def _check(options: argparse.Namespace, arguments: list[str], hull: Vehicle) -> int:
    start_ros(arguments)
    stop = StopRequest()
    node = Node("check_vehicle", start_parameter_services=False)
    if options.namespace is None:
        remapped = any("__ns:=" in argument for argument in arguments)
        options.namespace = node.get_namespace() if remapped else "/auv"
    try:
        listener = VehicleListener(
            node, options.namespace, hears_commands=not options.wiggle, dives=hull.dives
        )
        small_test = SmallTest(listener, hull) if options.wiggle else None
        recording = _Listening(node, listener, stop).record(options, small_test)
    finally:
        stop.withdraw()
        node.destroy_node()
        rclpy.try_shutdown()
    verdicts = check(recording, hull)
    if options.json:
        print(json.dumps(verdict_report.as_dict(verdicts, recording), indent=2))
    else:
        _show(verdicts, recording, options.namespace, small_test.cut_short if small_test else "")
    return EXIT_FAILED if mistakes(verdicts) else EXIT_DONE


def _show(verdicts: list[Verdict], recording: Recording, namespace: str, cut_short: str) -> None:
    out = console()
    clock = "/clock" if recording.sim_time else "the system's clock"
    heard = f"{namespace}, {recording.duration:.1f} s by {clock}, {recording.listened_in}"
    out.print(verdict_report.table(verdicts, heard))
    if cut_short:
        out.print(f"[yellow]the small test was cut short[/yellow]: {cut_short}")
    out.print(verdict_report.conclusion(verdicts))


class _Listening:
    """Spins the listener's node through the phases of a check."""

    def __init__(self, node: Node, listener: VehicleListener, stop: StopRequest) -> None:
        self._node, self._listener, self._stop = node, listener, stop
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)

    def record(self, options: argparse.Namespace, small_test: SmallTest | None) -> Recording:
        """Listen, with a small test if there is one, and return what was heard."""
        sim_time = self._find_clock(options.wait)
        if small_test is not None and (others := self._listener.other_commanders()):
            raise ConfigurationError(
                "--wiggle", f"{', '.join(others)} sending commands", "no other publisher of commands"
            )
        self._forget()
        begin = self._listener.now()
        try:
            if small_test is not None and self._until(lambda: bool(self._listener.recording.odom), _STILL):
                # As the autopilot does: a command for each odometry, and periodic ones in its silence.
                while small_test.tick() and self._until(small_test.is_due, _STILL):
                    pass
            else:
                duration = options.duration
                patience = max(_STILL, 1.5 * duration)
                self._until(lambda: self._listener.now() >= begin + duration, patience)
        finally:
            if small_test is not None:
                small_test.stop()
        return self._listener.finish(begin, sim_time)

    def _find_clock(self, wait: float) -> bool:
        """Wait for the first messages and follow a /clock; return whether there is one."""
        recording = self._listener.recording
        self._until(lambda: bool(recording.odom) and bool(recording.water), wait)
        self._until(self._has_clock, _DISCOVERY)
        sim_time = self._has_clock()
        if sim_time:
            self._node.set_parameters([Parameter("use_sim_time", value=True)])
            self._until(lambda: self._listener.now() > 0.0, wait)
        return sim_time

    def _has_clock(self) -> bool:
        return bool(self._node.count_publishers("/clock") > 0)

    def _forget(self) -> None:
        """Clear the recording: what came before the clock was found is not judged."""
        kept = self._listener.recording
        heard: tuple[list[Any], ...] = (
            kept.odom, kept.water, kept.rudder_state, kept.rudder_cmd, kept.thrust_cmd, kept.sternplane_state,
            kept.altitude, kept.sternplane_cmd,
        )  # fmt: skip
        for samples in heard:
            samples.clear()

    def _until(self, condition: Callable[[], bool], patience: float) -> bool:
        """Spin until the condition holds; return False when it does not within `patience` s of wall time.

        Raises:
            KeyboardInterrupt: a signal came.
        """
        deadline = time.monotonic() + patience
        while not condition():
            if self._stop.requested:
                raise KeyboardInterrupt
            if time.monotonic() > deadline:
                return False
            self._executor.spin_once(timeout_sec=0.01)
        return True
