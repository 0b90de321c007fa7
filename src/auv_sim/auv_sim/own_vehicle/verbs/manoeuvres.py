"""Fly zig-zags, circles and steps within bounds, and record them: on the simulator, or on your vehicle.

On the simulator it is a rehearsal. With --no-sim the vehicle's driver has to run; the command then asks
before anything moves. Rudder and planes go to neutral and thrust to 0 when a bound is left, navigation is
lost, another node sends commands, the terminal is lost, or on Ctrl-C.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from auv_sim.command_line import Parser, add_quiet, finite, not_negative, ros_namespace, whole
from auv_sim.command_verbs import refuse_without_effect

_BOX, _DEPTH, _SPEED = 200.0, 10.0, 10.0
#: Ranges of the parameters that the options set: box, m; current, m/s; speed.
BOX, CURRENT, SPEED = (1.0, 5000.0), (-5.0, 5.0), (0.01, 1000.0)
#: Options of the simulator.
_REHEARSAL = ("controller_model", "sea", "seed", "current", "speed")


def within(low: float, high: float) -> Callable[[str], float]:
    """Return the parser of a number in a range, with its ends."""

    def number(text: str) -> float:
        value = finite(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"found {text}, expected a number from {low:g} to {high:g}")
        return value

    return number


def add_arguments(parser: Parser) -> None:
    """Add the options."""
    parser.add_argument("--vehicle", required=True, metavar="FILE", help="vehicle file, or a shipped name")
    parser.add_argument(
        "--program", default="two_minutes", metavar="FILE",
        help="two_minutes, eight_minutes, the same with _dive, or a file (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument(
        "--depth", type=not_negative, default=_DEPTH, metavar="M",
        help="to hold, of a vehicle that dives (default: %(default)g)",
    )  # fmt: skip
    parser.add_argument(
        "--box", type=within(*BOX), default=_BOX, metavar="M",
        help="largest distance from the start to north and east (default: %(default)g)",
    )  # fmt: skip
    parser.add_argument(
        "--out", type=Path, metavar="DIR", help="run directory (default: runs/manoeuvres-...)"
    )
    parser.add_argument(
        "--namespace", type=ros_namespace, default="/auv", metavar="NAME",
        help="of the vehicle's topics (default: %(default)s)",
    )  # fmt: skip
    add_quiet(parser)
    rehearsal = parser.add_argument_group("on the simulator")
    rehearsal.add_argument(
        "--controller-model", metavar="FILE",
        help="file by which the manoeuvres are flown, where --vehicle is another hull in the water",
    )  # fmt: skip
    rehearsal.add_argument("--sea", metavar="FILE", help="sea file, or a shipped name")
    rehearsal.add_argument("--seed", type=whole, default=0, metavar="N",
                           help="of the sea (default: %(default)d)")  # fmt: skip
    rehearsal.add_argument("--current", type=within(*CURRENT), nargs=2, default=(0.0, 0.0),
                           metavar=("VX", "VY"), help="constant, towards north and east, m/s")  # fmt: skip
    rehearsal.add_argument("--speed", type=within(*SPEED), default=_SPEED, metavar="N",
                           help="times real time (default: %(default)g)")  # fmt: skip
    real = parser.add_argument_group("on your vehicle")
    real.add_argument("--no-sim", action="store_true", help="fly the vehicle whose driver runs")
    real.add_argument("--yes-the-vehicle-may-move", action="store_true", dest="consent",
                      help="the answer to the question that --no-sim asks")  # fmt: skip


def run(arguments: argparse.Namespace) -> int:
    """Fly; return 0 all flown, 1 ended early.

    Raises:
        ConfigurationError: an option of the simulator with --no-sim, on which it has no effect.
    """
    if arguments.no_sim:
        refuse_without_effect(arguments, _REHEARSAL, "--no-sim", "the simulator")
    from auv_sim.nodes.manoeuvres.manoeuvre_session import fly

    return fly(arguments)
