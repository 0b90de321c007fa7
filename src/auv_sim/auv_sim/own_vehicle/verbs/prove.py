"""Prove gains on a vehicle: a campaign, one page, one verdict.

Flies drawn courses in each sea, in further currents, on hulls within the uncertainty of their coefficients,
and hard starts on straight lines; a vehicle with stern planes changes its depth. 99 % of the flights keep
within the distance that it prints, at 95 % confidence. Exit code 0: within the distances asked for in every
sea, and limit cycles from at most 1 % of the starts, at the same confidence; 1: not.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

from auv_sim.command_line import at_least_one, positive, whole
from auv_sim.own_vehicle.verbs.gain_options import CLAIM, add_conditions

#: Seas if none is named.
SEAS = ("calm", "moderate")


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Add the options of `prove`."""
    p.add_argument("vehicle", metavar="VEHICLE", help="vehicle file, or the name of a shipped one")
    p.add_argument(
        "--params", metavar="FILE",
        help="gains: a file, the name of a shipped one, or rule (default: what the vehicle's file names)",
    )  # fmt: skip
    p.add_argument(
        "--within", type=positive, default=CLAIM["within"], metavar="M",
        help="true distance away from corners that 99 %% must keep (default: %(default)g m)",
    )  # fmt: skip
    p.add_argument(
        "--within-depth", type=positive, default=CLAIM["within_depth"], metavar="M",
        help="true error of depth that 99 %% must keep, of a vehicle that dives (default: %(default)g m)",
    )  # fmt: skip
    p.add_argument(
        "--flights", type=at_least_one, default=CLAIM["flights"], metavar="N",
        help="in each sea, and as many starts on lines (default: %(default)d; fewer than 299 bound nothing)",
    )  # fmt: skip
    p.add_argument(
        "--laws", action="store_true",
        help="beside them PID, LOS, ILOS, vector field, AILOS with NISM, and on straight legs the law of "
        "MSS, each tuned with one budget",
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
    p.add_argument(
        "--refly", type=whole, metavar="N", help="fly and draw flight N again, as the page names it, alone"
    )
    add_conditions(p, SEAS)


def run(options: argparse.Namespace) -> int:
    """Prove; return the exit code."""
    from auv_sim.own_vehicle.prove.prove_session import run as prove

    options.sea = options.sea or list(SEAS)
    options.made = time.strftime("%Y-%m-%d %H:%M UTC", time.gmtime())
    return prove(options)
