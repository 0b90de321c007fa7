"""`check_vehicle`: whether a vehicle's topics keep the contract, item by item."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from auv_sim.command_line import Parser, command, positive, ros_namespace

_CONSENT = "--yes-the-vehicle-may-move"


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="check_vehicle",
        description="Listen to a vehicle's topics and report, item by item, whether they keep the contract.",
        epilog="Exit code: 0 nothing failed (with --wiggle: and everything was judged), 1 otherwise,"
        " 2 input that cannot be used.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--namespace", type=ros_namespace,
        help="namespace of the vehicle's topics (default: that of `-r __ns:=`, else /auv); / is the root",
    )  # fmt: skip
    p.add_argument(
        "--duration", type=positive, default=10.0, metavar="S", help="time to listen (default 10 s)"
    )
    p.add_argument(
        "--vehicle", default="remus100", metavar="FILE",
        help="vehicle file or name of a shipped one (default remus100)",
    )  # fmt: skip
    p.add_argument(
        "--wiggle", action="store_true",
        help="ask, then move the vehicle: rudder and thrust for 20 s within 40 m; with stern planes 27 s,"
        " and within 4 m of the depth",
    )  # fmt: skip
    p.add_argument(_CONSENT, action="store_true", dest="consent", help="with --wiggle: move without asking")
    p.add_argument(
        "--wait",
        type=positive,
        default=15.0,
        metavar="S",
        help="time to wait for the first message (default 15 s)",
    )
    p.add_argument("--json", action="store_true", help="print JSON in place of the table")
    p.add_argument(
        "--self-test", action="store_true",
        help="test this command on simulated vehicles with one mistake each; no real vehicle moves",
    )  # fmt: skip
    return p


@command("check", interrupted="interrupted: zero commands were sent")
def main(argv: Sequence[str] | None = None) -> int:
    """Check; return 0 nothing failed, 1 something did, 2 bad input, 130 interrupted."""
    arguments = list(sys.argv[1:] if argv is None else argv)
    options = parser().parse_args(_without_ros(arguments))
    from auv_sim.checks.vehicle_check.live.check_session import run

    return run(options, arguments, _CONSENT)


def _without_ros(arguments: list[str]) -> list[str]:
    if "--ros-args" not in arguments:
        return arguments  # and --help imports nothing
    from rclpy.utilities import remove_ros_args

    return list(remove_ros_args(["check_vehicle", *arguments])[1:])


if __name__ == "__main__":
    raise SystemExit(main())
