"""Prove gains on a vehicle: a campaign, one page, one verdict.

Flies drawn courses in a sea, in further currents, on hulls within the uncertainty of their coefficients, and
hard starts on straight lines. 99 % of the flights keep within the distance that it prints, at 95 %
confidence. Exit code 0: within the distance asked for, and limit cycles from at most 1 % of the starts, at
the same confidence; 1: not.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from auv_sim.command_line import at_least_one, positive
from auv_sim.own_vehicle.verbs.gain_options import add_conditions


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Add the options of `prove`."""
    p.add_argument("vehicle", metavar="VEHICLE", help="vehicle file, or the name of a shipped one")
    p.add_argument(
        "--params", metavar="FILE",
        help="gains: a file, the name of a shipped one, or rule (default: what the vehicle's file names)",
    )  # fmt: skip
    p.add_argument(
        "--within", type=positive, default=2.5, metavar="M",
        help="true distance away from corners that 99 %% must keep (default: 2.5 m)",
    )  # fmt: skip
    p.add_argument(
        "--flights", type=at_least_one, default=1000, metavar="N",
        help="in the sea, and as many starts on lines (default: 1000; fewer than 299 bound nothing)",
    )  # fmt: skip
    p.add_argument(
        "--laws", action="store_true",
        help="beside them PID, LOS, ILOS, vector field and AILOS with NISM, each tuned with one budget",
    )  # fmt: skip
    p.add_argument(
        "--generations", type=at_least_one, default=30, metavar="N", help="budget of each law (default: 30)"
    )
    p.add_argument(
        "--in-plane", action="store_true",
        help="a diving vehicle: fly its horizontal motion alone, which takes a fifth of the time",
    )  # fmt: skip
    p.add_argument(
        "--out", type=Path, default=Path("proof"), metavar="DIR", help="where to write (default: proof)"
    )
    add_conditions(p)


def run(options: argparse.Namespace) -> int:
    """Prove; return the exit code."""
    from auv_sim.own_vehicle.prove.prove_session import run as prove

    return prove(options)
