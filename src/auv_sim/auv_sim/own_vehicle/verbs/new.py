"""Write a vehicle file from what an owner has at hand, and a survey that the vehicle can fly.

At a terminal it asks for what is not given as an option, but not with --quiet. What is not known is assumed:
by similarity from the REMUS 100, bent to what is given, and marked in the file with the factor within which
it may be wrong. The file is then checked and flown, and the measurements that would help most are listed.
"""

from __future__ import annotations

import argparse
import math
import re
import sys
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError, printable
from auv_sim.command_line import (
    EXIT_DONE,
    Parser,
    add_overwrite,
    add_quiet,
    finite,
    not_negative,
    positive,
    say,
    target,
)

_PAIR = r"[0-9.eE+-]+"


def pair(text: str) -> tuple[float, float]:
    """Parse VALUE@AT, two positive numbers; AT may be left out and is then NaN."""
    found = re.fullmatch(rf"({_PAIR})(?:@({_PAIR}))?", text)
    if not found:
        raise argparse.ArgumentTypeError(f"found '{text}', expected a number, or two with @ between them")
    return positive(found[1]), math.nan if found[2] is None else positive(found[2])


def add_arguments(parser: Parser) -> None:
    """Add the options."""
    parser.add_argument("--out", type=target, metavar="FILE", help="the file to write (default: NAME.yaml)")
    add_overwrite(parser)
    add_quiet(parser)
    parser.add_argument("--name", help="of the vehicle")
    parser.add_argument("--length", type=positive, metavar="M", help="of the hull")
    parser.add_argument("--diameter", type=positive, metavar="M", help="of the hull")
    parser.add_argument("--mass", type=positive, metavar="KG", help="in air, flooded spaces full")
    parser.add_argument(
        "--thrust-unit", choices=("N", "percent", "rpm"), help="of the commands that your driver takes"
    )
    parser.add_argument("--thrust-max", type=positive, metavar="T", help="largest thrust, in that unit")
    parser.add_argument(
        "--speed", type=pair, action="extend", nargs="+", metavar="V@T",
        help="steady speed through the water (m/s) at a thrust, e.g. 1.8@60; without @ at the largest",
    )  # fmt: skip
    parser.add_argument(
        "--thrust-table", type=pair, action="extend", nargs="+", metavar="N@T",
        help="newtons at a thrust in another unit, e.g. 12@60 30@100",
    )  # fmt: skip
    parser.add_argument(
        "--radius", type=pair, action="extend", nargs="+", metavar="R@DEG",
        help="radius of a steady turn (m) at a rudder angle, e.g. 9.5@25; without @ with full rudder",
    )  # fmt: skip
    parser.add_argument("--rudder", type=positive, metavar="DEG", help="largest angle of the rudder")
    parser.add_argument("--rudder-rate", type=positive, metavar="DEG/S", help="its largest rate")
    parser.add_argument("--delay", type=not_negative, metavar="S", help="from a command to the fin's start")
    parser.add_argument(
        "--planes", type=not_negative, metavar="DEG", help="largest angle of stern planes; 0: none"
    )
    parser.add_argument("--planes-rate", type=positive, metavar="DEG/S", help="their largest rate")
    parser.add_argument(
        "--dive-rate", type=positive, metavar="M/S", help="steady, with the planes at their stop"
    )
    parser.add_argument("--effect", type=positive, metavar="B", help="turning.effect, where measured, 1/s^2")
    parser.add_argument(
        "--divergence", type=finite, metavar="P", help="turning.divergence, where measured, 1/s"
    )


def run(arguments: argparse.Namespace) -> int:
    """Write the file; return the exit code.

    Raises:
        ConfigurationError: a fact is missing, or contradicts another.
    """
    if sys.stdin.isatty() and not arguments.quiet and not _is_complete(arguments):
        _ask(arguments)
    from auv_sim.own_vehicle.new.new_session import new_vehicle
    from auv_sim.own_vehicle.output_files import vehicle_file_of
    from auv_sim.terminal import console

    facts = _facts(arguments)
    new_vehicle(
        facts, arguments.out or vehicle_file_of(facts.name), arguments.overwrite, console(arguments.quiet)
    )
    return EXIT_DONE


_REQUIRED = ("length", "speed", "rudder", "radius")


def _is_complete(options: argparse.Namespace) -> bool:
    return all(getattr(options, name) for name in _REQUIRED)


def _ask(options: argparse.Namespace) -> None:
    from auv_sim.own_vehicle.new.questions import Question, ask

    def unit(text: str) -> str:
        if text not in ("N", "percent", "rpm"):
            raise argparse.ArgumentTypeError(f"found '{text}', expected N, percent or rpm")
        return text

    def dives(given: argparse.Namespace) -> bool:
        return bool(given.planes)

    questions = [
        Question("name", "Name of the vehicle", str),
        Question("length", "Length of the hull, m", positive, required=True),
        Question("diameter", "Diameter, m", positive),
        Question("mass", "Mass in air with flooded spaces full, kg", positive),
        Question("thrust_unit", "Unit of thrust commands: N, percent or rpm", unit),
        Question("thrust_max", "Largest thrust in that unit", positive,
                 applies=lambda given: given.thrust_unit != "percent"),
        Question("speed", "Steady speeds, m/s @ thrust, such as 1.8@60", pair, several=True, required=True),
        Question("rudder", "Largest rudder angle, deg", positive, required=True),
        Question("rudder_rate", "Largest rate of the rudder, deg/s", positive),
        Question("radius", "Radii of steady turns, m @ deg of rudder, such as 9.5@25", pair, several=True,
                 required=True),
        Question("delay", "Delay from a command to the fin's start, s", not_negative),
        Question("planes", "Largest angle of the stern planes, deg; 0 if it has none", not_negative),
        Question("planes_rate", "Their largest rate, deg/s", positive, applies=dives),
        Question("dive_rate", "Steady dive rate with the planes at their stop, m/s", positive, applies=dives),
    ]  # fmt: skip
    try:
        ask(questions, options, input, say)
    except EOFError:
        raise ConfigurationError("new", "the end of the input", "answers, or options") from None


def _facts(o: argparse.Namespace) -> Any:
    """Return the facts.

    Raises:
        ConfigurationError: one that is needed is missing.
    """
    from auv_sim.own_vehicle.new.owner_facts import OwnerFacts

    for name in _REQUIRED:
        if not getattr(o, name):
            raise ConfigurationError(f"--{name}", "nothing", "this option, or a terminal to ask at")
    unit: Any = o.thrust_unit or "N"
    largest = o.thrust_max or (100.0 if unit == "percent" else None)
    if largest is None:
        given = [at for _, at in o.speed if not math.isnan(at)]
        if not given:
            other = "" if o.thrust_unit else ", or --thrust-unit percent"
            raise ConfigurationError("--thrust-max", "nothing", f"the largest thrust, {unit}{other}")
        largest = max(given)
    name = printable(" ".join((o.name or "").split())) or "my vehicle"
    return OwnerFacts(
        name=name, length=o.length, thrust_unit=unit, thrust_max=largest,
        speeds=_rows(o.speed, largest), radii=_rows(o.radius, o.rudder), max_angle_deg=o.rudder,
        mass=o.mass, diameter=o.diameter, rate_deg_s=o.rudder_rate, delay=o.delay,
        planes_deg=o.planes or None, planes_rate_deg_s=o.planes_rate, dive_rate=o.dive_rate,
        thrust_table=_rows(o.thrust_table or [], largest), effect=o.effect, divergence=o.divergence,
    )  # fmt: skip


def _rows(pairs: list[tuple[float, float]], at_most: float) -> tuple[tuple[float, float], ...]:
    """Return rows of (at, value) in increasing order; a value without `@` is at the most."""
    return tuple(sorted((at_most if math.isnan(at) else at, value) for value, at in pairs))
