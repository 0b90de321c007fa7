"""`check_vehicle`: whether what publishes the vehicle's topics keeps the contract, item by item."""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable, Sequence

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.signals import SignalHandlerOptions
from rclpy.utilities import remove_ros_args

from auv_msgs_py.node.run import StopRequest
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check import verdict_report
from auv_sim.checks.vehicle_check.items.all_items import check, mistakes
from auv_sim.checks.vehicle_check.listener import VehicleListener
from auv_sim.checks.vehicle_check.samples import Recording
from auv_sim.checks.vehicle_check.wiggle import END, THRUST_SHARE
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, Parser, command, positive, ros_namespace
from auv_sim.terminal import console

#: How long the discovery of a /clock may take, and how long ROS time may stand still, s of wall time.
_DISCOVERY, _STILL = 1.0, 10.0
_CONSENT = "--yes-the-vehicle-may-move"


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="check_vehicle",
        description="Listen to a vehicle's topics and say, item by item, whether they keep the contract.",
        epilog="Exit code: 0 nothing failed (with --wiggle: and everything was judged), 1 otherwise,"
        " 2 input that cannot be used.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--namespace",
        type=ros_namespace,
        help="of the vehicle's topics (default: that of `-r __ns:=`, else /auv); / is the root",
    )
    p.add_argument(
        "--duration", type=positive, default=10.0, metavar="S", help="how long to listen (default 10 s)"
    )
    p.add_argument(
        "--vehicle",
        default="remus100",
        metavar="FILE",
        help="what the vehicle is: file or shipped name (default remus100)",
    )
    p.add_argument(
        "--wiggle", action="store_true",
        help="move: a small test of rudder and thrust, 20 s within 40 m; asks first",
    )  # fmt: skip
    p.add_argument(_CONSENT, action="store_true", dest="consent", help="the answer to that question")
    p.add_argument(
        "--wait", type=positive, default=15.0, metavar="S", help="for the first message (default 15 s)"
    )
    p.add_argument("--json", action="store_true", help="print JSON in place of the table")
    p.add_argument(
        "--self-test", action="store_true",
        help="check the check: simulated vehicles with one mistake each, over ROS 2, nothing else moves",
    )  # fmt: skip
    return p


@command("check", interrupted="interrupted: zero commands were sent")
def main(argv: Sequence[str] | None = None) -> int:
    """Check; returns the exit code."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    options = parser().parse_args(remove_ros_args(["check_vehicle", *arguments])[1:])
    hull = vehicle.load(options.vehicle)
    if options.self_test:
        from auv_sim.checks.vehicle_check.self_test import self_test

        return self_test(console(), hull)
    if options.wiggle:
        _ask(options.consent)
    elif options.consent:
        raise ConfigurationError(_CONSENT, "no --wiggle", "both: without it nothing moves")
    return _check(options, arguments, hull)


def _ask(consent: bool) -> None:
    """The vehicle moves only if a person says so."""
    if consent:
        return
    if not sys.stdin.isatty():
        raise ConfigurationError("--wiggle", "no terminal to ask at", f"{_CONSENT} as well, or a terminal")
    print(
        f"The vehicle will move for {END:g} s: {THRUST_SHARE:.0%} of its thrust, rudder up to 20 degrees,"
        " within some 40 m."
    )
    try:
        answer = input("Type yes if it may: ").strip().lower()
    except EOFError:
        raise ConfigurationError("--wiggle", "no answer", "yes") from None
    if answer != "yes":
        raise ConfigurationError("--wiggle", "another answer", "yes")


def _check(options: argparse.Namespace, arguments: list[str], hull: Vehicle) -> int:
    rclpy.init(args=arguments, signal_handler_options=SignalHandlerOptions.NO)
    stop = StopRequest()
    node = Node("check_vehicle", start_parameter_services=False)
    if options.namespace is None:
        remapped = any("__ns:=" in argument for argument in arguments)
        options.namespace = node.get_namespace() if remapped else "/auv"
    try:
        listener = VehicleListener(node, options.namespace, hull if options.wiggle else None)
        recording = _listen(node, listener, options, stop)
    finally:
        stop.withdraw()
        node.destroy_node()
        rclpy.try_shutdown()
    verdicts = check(recording, hull)
    if options.json:
        print(json.dumps(verdict_report.as_dict(verdicts, recording), indent=2))
    else:
        out = console()
        clock = "/clock" if recording.sim_time else "the system's clock"
        heard = f"{options.namespace}, {recording.duration:.1f} s by {clock}, {recording.listened_in}"
        out.print(verdict_report.table(verdicts, heard))
        if listener.cut_short:
            out.print(f"[yellow]the small test was cut short[/yellow]: {listener.cut_short}")
        out.print(verdict_report.conclusion(verdicts))
    return EXIT_FAILED if mistakes(verdicts) else EXIT_DONE


def _listen(
    node: Node, listener: VehicleListener, options: argparse.Namespace, stop: StopRequest
) -> Recording:
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def spin(until: Callable[[], bool], patience: float) -> bool:
        """Until it is so; False when it is not within `patience` s of wall time."""
        deadline = time.monotonic() + patience
        while not until():
            if stop.requested:
                raise KeyboardInterrupt
            if time.monotonic() > deadline:
                return False
            executor.spin_once(timeout_sec=0.01)
        return True

    recording = listener.recording
    spin(lambda: bool(recording.odom) and bool(recording.water), options.wait)
    spin(lambda: node.count_publishers("/clock") > 0, _DISCOVERY)
    sim_time = node.count_publishers("/clock") > 0
    if sim_time:
        node.set_parameters([Parameter("use_sim_time", value=True)])
        spin(lambda: listener.now() > 0.0, options.wait)
    if options.wiggle and (others := listener.other_commanders()):
        raise ConfigurationError(
            "--wiggle", f"{', '.join(others)} sending commands", "no other publisher of commands"
        )
    # What came before the clock was found is not judged.
    for samples in (
        recording.odom,
        recording.water,
        recording.rudder_state,
        recording.rudder_cmd,
        recording.thrust_cmd,
    ):
        samples.clear()
    begin = listener.now()
    try:
        if options.wiggle and spin(lambda: bool(recording.odom), _STILL):
            # As the autopilot does: a command for each odometry, and in silence of itself.
            while listener.tick() and spin(listener.due, _STILL):
                pass
        else:
            spin(lambda: listener.now() >= begin + options.duration, max(_STILL, 1.5 * options.duration))
    finally:
        listener.stop()
    return listener.finish(begin, sim_time)


if __name__ == "__main__":
    raise SystemExit(main())
