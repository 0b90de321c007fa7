"""`scripts/fault_matrix.py`: make everything fail that can, and check the suite's reaction."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import Parser, command, not_default, positive, ros_domain, target


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="fault_matrix.py",
        description="Kill nodes and disturb topics in flight, and check how the suite reacts.",
        allow_abbrev=False,
    )
    p.add_argument(
        "rows", nargs="*", metavar="ROW", help="only these, e.g. 'odom jump' (default: a representative part)"
    )
    p.add_argument("--full", action="store_true", help="all rows of the table in docs/safety.md")
    p.add_argument(
        "--hostile", type=positive, metavar="S",
        help="instead: fly for S seconds of wall time beside a node that publishes nonsense on every topic",
    )  # fmt: skip
    p.add_argument("--list", action="store_true", help="print the names of all rows")
    p.add_argument(
        "--speed",
        type=positive,
        default=4.0,
        metavar="N",
        help="speed of the simulator, times real time (default 4)",
    )
    p.add_argument("--json", type=target, metavar="FILE", help="write the results to FILE")
    p.add_argument("--out", type=Path, metavar="DIR", help="keep logs and bag there (default: delete them)")
    p.add_argument("--domain", type=ros_domain, help="ROS domain (default: a free one)")
    return p


@command("fault matrix")
def main(argv: Sequence[str] | None = None) -> int:
    """Return 0 when all rows are as expected, 1 when one is not, 2 for bad input, 130 when interrupted."""
    p = parser()
    options = p.parse_args(argv)
    from auv_sim.checks.faults.fault_session import run

    return run(options, not_default(p, options))


if __name__ == "__main__":
    raise SystemExit(main())
