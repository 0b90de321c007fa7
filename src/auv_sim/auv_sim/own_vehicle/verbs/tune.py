"""Tune gains, look-ahead, corners and limits of the reference for a vehicle.

Starts from the rule's gains (docs/tuning.md), flies thousands of drawn flights, and accepts what it finds
only after flights that the search never saw. Otherwise the rule's gains stay. Writes a parameter file that
`mission.py --params FILE` flies, and a picture beside it.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from auv_path_following import config_files
from auv_sim.command_line import at_least_one, not_negative, positive, target, whole


def add_arguments(p: argparse.ArgumentParser) -> None:
    """Add the options of `tune`."""
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument("vehicle", metavar="VEHICLE", help="vehicle file, or the name of a shipped one")
    p.add_argument(
        "--out", type=target, default=Path("tuned.yaml"), metavar="FILE",
        help="parameter file to write (default: %(default)s); the picture stands beside it",
    )  # fmt: skip
    p.add_argument(
        "--delay", type=not_negative, default=0.0, metavar="S",
        help="further delay from a measurement to its command's arrival, besides the file's dead_time (0 s)",
    )  # fmt: skip
    p.add_argument(
        "--rate", type=positive, default=20.0, metavar="HZ", help="odometries a second (default: 20)"
    )
    p.add_argument(
        "--slowest", type=positive, default=10.0, metavar="HZ",
        help="no limit cycle down to this rate (default: 10)",
    )  # fmt: skip
    p.add_argument(
        "--sea", default="moderate", metavar="FILE", help=f"file or one of: {seas} (default: moderate)"
    )
    p.add_argument(
        "--spread", type=not_negative, default=0.0, metavar="PERCENT",
        help="uncertainty of coefficients, fin rate and dead time, half width (0)",
    )  # fmt: skip
    p.add_argument(
        "--members", type=at_least_one, default=1, metavar="N",
        help="hulls: the vehicle and N - 1 drawn within --spread (1)",
    )  # fmt: skip
    p.add_argument(
        "--generations", type=at_least_one, default=60, metavar="N", help="of the search (default: 60)"
    )
    p.add_argument("--seed", type=whole, default=0, metavar="N", help="of all draws (default: 0)")
    p.add_argument(
        "--threads", type=at_least_one, default=os.cpu_count() or 1, metavar="N",
        help="flights at the same time (default: all cores)",
    )  # fmt: skip
    p.add_argument("--quiet", action="store_true", help="print nothing unless something goes wrong")


def run(options: argparse.Namespace) -> int:
    """Tune; return the exit code."""
    from auv_sim.own_vehicle.tune.tune_session import run as tune

    return tune(options)
