"""`scripts/sea_trials.py`: one mission in one sea with many seeds, without ROS, on all cores."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

from auv_path_following import config_files
from auv_sim.command_line import Parser, at_least_one, command, positive, whole
from auv_sim.flight.least_share import LEAST_SHARE_AT_SEA
from auv_sim.launch.options import DEFAULT_MISSION, DEFAULT_PARAMS, DEFAULT_VEHICLE
from auv_sim.shared_options import add_flown_option


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="sea_trials.py",
        allow_abbrev=False,
        description="Fly a mission in a sea with many seeds, and judge it by the vehicle's true position.",
    )
    _add_flights(p)
    p.add_argument(
        "--limit",
        type=positive,
        default=2.5,
        metavar="M",
        help="largest true distance to the path that passes (default 2.5)",
    )
    p.add_argument(
        "--depth-limit", type=positive, default=0.5, metavar="M",
        help="for a vehicle that dives: largest depth error that passes (default 0.5)",
    )  # fmt: skip
    add_flown_option(p, LEAST_SHARE_AT_SEA)
    p.add_argument(
        "--study", choices=("noise",),
        help="instead: tabulate and draw rudder activity over the level of noise",
    )  # fmt: skip
    p.add_argument(
        "--workers",
        type=at_least_one,
        default=os.cpu_count() or 1,
        metavar="N",
        help="worker processes (default: one for each core)",
    )
    p.add_argument(
        "--out", type=Path, default=Path("sea_trials"), metavar="DIR",
        help="where to write (default: sea_trials)",
    )  # fmt: skip
    p.add_argument(
        "--page", type=Path, metavar="FILE",
        help="renew the table on this page (docs/sea.md), and the study's picture in images/ beside it",
    )  # fmt: skip
    return p


def _add_flights(p: argparse.ArgumentParser) -> None:
    p.add_argument("--mission", default=DEFAULT_MISSION, metavar="FILE", help="default: %(default)s")
    p.add_argument("--vehicle", default=DEFAULT_VEHICLE, metavar="FILE", help="default: %(default)s")
    p.add_argument(
        "--params", nargs="+", default=[DEFAULT_PARAMS, "rough"], metavar="FILE",
        help="gains to compare (default: robust rough)",
    )  # fmt: skip
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument("--sea", default="rough", metavar="FILE", help=f"file or one of: {seas} (default: rough)")
    p.add_argument("--seeds", type=at_least_one, default=50, metavar="N", help="number of seeds (default 50)")
    p.add_argument("--first", type=whole, default=0, metavar="N", help="the first seed (default 0)")


@command("sea trials")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly; return 0 all within the limit, 1 not, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    from auv_sim.studies.sea_trials_session import run

    return run(options)


if __name__ == "__main__":
    raise SystemExit(main())
