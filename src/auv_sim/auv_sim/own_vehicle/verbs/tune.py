"""Tune gains, look-ahead, corners and limits of the reference for a vehicle.

Starts from the rule's gains (docs/tuning.md) or from those that the vehicle has, flies thousands of drawn
flights, and accepts what it finds only after flights that the search never saw. Otherwise the better of those
gains stay. Writes a parameter file that `mission.py --params FILE` flies, and a picture beside it.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from auv_sim.command_line import at_least_one, target
from auv_sim.own_vehicle.verbs.gain_options import add_conditions


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Add the options of `tune`."""
    p.add_argument("vehicle", metavar="VEHICLE", help="vehicle file, or the name of a shipped one")
    p.add_argument(
        "--out", type=target, default=Path("tuned.yaml"), metavar="FILE",
        help="parameter file to write (default: %(default)s); the picture stands beside it",
    )  # fmt: skip
    p.add_argument(
        "--members", type=at_least_one, metavar="N",
        help="hulls: the vehicle and N - 1 drawn within --spread (default: 5 with a spread, else 1)",
    )  # fmt: skip
    p.add_argument(
        "--generations",
        type=at_least_one,
        metavar="N",
        help="of the search (default: 80; 50 for several hulls)",
    )
    add_conditions(p)
    # By default the uncertainty is what the vehicle file states, if it states one.
    p.set_defaults(spread=None)


def run(options: argparse.Namespace) -> int:
    """Tune; return the exit code."""
    from auv_sim.own_vehicle.tune.tune_session import run as tune

    return tune(options)
