"""`scripts/vehicle.py`: parses the verb and hands over to its module."""

from __future__ import annotations

import argparse
from collections.abc import Container, Sequence

from auv_sim.command_line import command
from auv_sim.command_verbs import parser_of_verbs, run_verb

#: In the order of the work on a vehicle.
VERBS = {
    "new": "a vehicle file from what an owner has at hand: length, speed, turning radius",
    "manoeuvres": "fly zig-zags, circles and steps within bounds, and record them",
    "identify": "coefficients, servo and current from recordings of manoeuvres",
    "tune": "gains for a vehicle, or for all that its uncertain coefficients allow",
    "prove": "a campaign and one page: how close these gains keep the vehicle to its path",
}


def parser(verbs_with_options: Container[str] = VERBS) -> argparse.ArgumentParser:
    """Return the command line's parser; see `parser_of_verbs`."""
    return parser_of_verbs(
        "vehicle.py", "Describe, identify, tune and prove a vehicle of your own.",
        "auv_sim.own_vehicle.verbs", VERBS, verbs_with_options,
    )  # fmt: skip


@command("vehicle.py")
def main(argv: Sequence[str] | None = None) -> int:
    """Run one verb; return 0 done, 1 failed, 2 bad input, 130 interrupted."""
    return run_verb(parser, argv)


if __name__ == "__main__":
    raise SystemExit(main())
