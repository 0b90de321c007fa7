"""`scripts/soak.py`: fly an hour of mission time; does any process grow, is any message lost?"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import Parser, command, positive


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="soak.py",
        description="Fly a looped survey for an hour of mission time, and watch memory and losses.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--vehicle",
        default="remus100",
        metavar="FILE",
        help="vehicle file, or the name of a shipped one; with stern planes the survey has depths"
        " (default %(default)s)",
    )
    p.add_argument("--minutes", type=positive, default=60.0, help="least mission time (default 60)")
    p.add_argument(
        "--flat",
        type=positive,
        default=20.0,
        metavar="KB",
        help="largest growth, kB per 1000 steps (default 20)",
    )
    p.add_argument("--out", type=Path, metavar="DIR", help="run directory (default: runs/soak-DATE)")
    return p


@command("soak")
def main(argv: Sequence[str] | None = None) -> int:
    """Return 0 when nothing grew or was lost, 1 when something did, 2 for bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    from auv_sim.checks.soak.long_flight import soak

    return soak(options)


if __name__ == "__main__":
    raise SystemExit(main())
