"""`scripts/plan.py`: look at a mission before the vehicle is in the water."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_path_following import config_files
from auv_path_following.curves.switching_modes import MODES
from auv_sim.command_line import Parser, command, finite, not_default
from auv_sim.shared_options import add_mission_option


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    shipped = {kind: ", ".join(config_files.shipped(kind)) for kind in ("missions", "vehicles", "params")}
    p = Parser(
        prog="plan.py",
        description="Check whether the vehicle can fly a mission, and draw it.",
        epilog="Exit code 0: it can be flown, perhaps with warnings. 2: it is refused, or a file is wrong.",
        allow_abbrev=False,
    )
    add_mission_option(p, None, shipped["missions"])
    p.add_argument(
        "--vehicle", default="remus100", metavar="FILE", help=f"file or one of: {shipped['vehicles']}"
    )
    p.add_argument(
        "--params", metavar="FILE", help=f"file with circles of acceptance, or one of: {shipped['params']}"
    )
    p.add_argument(
        "--current",
        nargs=2,
        type=finite,
        default=(0.0, 0.0),
        metavar=("VX", "VY"),
        help="current towards north and east, m/s",
    )
    p.add_argument(
        "--upwelling", type=finite, metavar="V", help="current upwards, for a vehicle with stern planes, m/s"
    )
    p.add_argument("--switching", choices=MODES, help="which joints have a circle of acceptance")
    p.add_argument(
        "--out", type=Path, metavar="PNG", help="picture to write (default: plan-MISSION.png here)"
    )
    p.add_argument("--export", type=Path, metavar="FILE", help="write the path for a chart: .geojson or .kml")
    p.add_argument("--quiet", action="store_true", help="print only a refusal; draw only with --out")
    return p


@command("plan")
def main(argv: Sequence[str] | None = None) -> int:
    """Plan; return the exit code: 0 flyable, 2 refused or bad input, 130 interrupted."""
    p = parser()
    options = p.parse_args(argv)
    if options.mission is None:
        p.error("found no mission, expected MISSION")
    from auv_sim.checks.mission_check.plan_session import plan

    return plan(options, not_default(p, options))


if __name__ == "__main__":
    raise SystemExit(main())
