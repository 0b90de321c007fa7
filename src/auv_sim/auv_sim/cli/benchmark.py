"""`scripts/benchmark.py`: how fast the suite is on this machine, as ratios measured in one run."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import Parser, command, target

#: What can be measured alone.
SECTIONS = (
    "lockstep",
    "dimensions",
    "fleet",
    "latency",
    "operation",
    "console",
    "simulation",
    "start_up",
    "subpaths",
    "recording",
)


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="benchmark.py",
        description="Measure how fast the suite is on this machine, as ratios within one run.",
        allow_abbrev=False,
    )
    p.add_argument(
        "--quick", action="store_true", help="take a minute: shows that everything runs, not how fast"
    )
    p.add_argument(
        "--only",
        nargs="+",
        choices=SECTIONS,
        metavar="SECTION",
        help=f"measure only these of {', '.join(SECTIONS)}",
    )
    p.add_argument(
        "--against", type=Path, metavar="DIR", help="compare with another checkout of the suite, in turns"
    )
    p.add_argument("--json", type=target, metavar="FILE", help="write all figures to FILE")
    p.add_argument(
        "--write-docs", action="store_true", help="renew the figures and pictures of docs/performance.md"
    )
    p.add_argument("--page", type=Path, default=Path("docs/performance.md"), help="the page to renew")
    p.add_argument("--images", type=Path, default=Path("docs/images"), help="folder of its pictures")
    return p


@command("benchmark", interrupted="interrupted; nothing was written")
def main(argv: Sequence[str] | None = None) -> int:
    """Measure; return the exit code: 0 done, 1 something did not run, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    from auv_sim.checks.benchmark.benchmark_session import measure

    return measure(options)


if __name__ == "__main__":
    raise SystemExit(main())
