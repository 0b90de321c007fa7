"""`scripts/vehicle.py`: parses the verb and hands over to its module."""

from __future__ import annotations

import argparse
import importlib
import sys
from collections.abc import Container, Sequence

from auv_sim.command_line import Parser, command

_VERBS_PACKAGE = "auv_sim.own_vehicle.verbs"
#: In the order of the work on a vehicle.
VERBS = {
    "new": "a vehicle file from what an owner has at hand: length, speed, turning radius",
    "manoeuvres": "fly zig-zags, circles and steps within bounds, and record them",
    "identify": "coefficients, servo and current from recordings of manoeuvres",
    "tune": "gains for a vehicle, or for all that its uncertain coefficients allow",
    "prove": "a campaign and one page: how close these gains keep the vehicle to its path",
}


def parser(verbs_with_options: Container[str] = VERBS) -> argparse.ArgumentParser:
    """Return the command line's parser; only verbs that get their options are imported, which takes long."""
    top = Parser(
        prog="vehicle.py", description="Describe, identify, tune and prove a vehicle of your own.",
        allow_abbrev=False,
    )  # fmt: skip
    verbs = top.add_subparsers(dest="verb", required=True, metavar="VERB", parser_class=Parser)
    for name, what in VERBS.items():
        if name not in verbs_with_options:
            verbs.add_parser(name, help=what)
            continue
        module = importlib.import_module(f"{_VERBS_PACKAGE}.{name}")
        verb = verbs.add_parser(
            name, help=what, description=module.__doc__, allow_abbrev=False,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )  # fmt: skip
        module.add_arguments(verb)
        verb.set_defaults(run=module.run)
    return top


@command("vehicle.py")
def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb; return 0 done, 1 failed, 2 bad input, 130 interrupted."""
    words = sys.argv[1:] if argv is None else argv
    arguments = parser(words[:1]).parse_args(words)
    return int(arguments.run(arguments))


if __name__ == "__main__":
    raise SystemExit(main())
