"""`scripts/reproduce_paper.py`: the paper's figures and claims, and the studies beside them."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from auv_sim.command_line import Parser, at_least_one, command, not_default, whole
from auv_sim.studies.paper.variants import PLANTS, START_LAWS


def _seconds(text: str) -> float:
    value = float(text)
    if not 10.0 <= value <= 1e5:
        raise argparse.ArgumentTypeError(f"found {text}, expected a time from 10 to 100000 s")
    return value


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="reproduce_paper.py",
        allow_abbrev=False,
        description="Fly the paper's cases, draw its Figures 5 to 12, judge its claims.",
    )
    p.add_argument(
        "--out", type=Path, default=Path("reproduction"), metavar="DIR",
        help="where to write (default: reproduction)",
    )  # fmt: skip
    p.add_argument(
        "--workers", type=at_least_one, default=2, metavar="N", help="worker processes (default 2)"
    )
    p.add_argument(
        "--quick", action="store_true",
        help="use 10 instead of 20 odometries a second, and a shorter search at the corner",
    )  # fmt: skip
    p.add_argument(
        "--time-limit", type=_seconds, default=1500.0, metavar="S",
        help="longest flight; a path not reached by then counts as never reached (default 1500 s)",
    )  # fmt: skip
    _add_studies(p)
    return p


def _add_studies(p: argparse.ArgumentParser) -> None:
    p.add_argument(
        "--study", choices=("starts", "corners", "pictures"),
        help="instead: starts, the random starts; corners, one corner at a time, in currents from all sides; "
        "pictures, those of docs/reproduction.md and docs/tuning.md",
    )  # fmt: skip
    p.add_argument(
        "--runs",
        type=at_least_one,
        default=1000,
        metavar="N",
        help="study starts: number of flights (default 1000)",
    )
    p.add_argument("--seed", type=whole, default=1, metavar="N", help="study starts: seed (default 1)")
    p.add_argument(
        "--laws", nargs="+", choices=tuple(START_LAWS), default=["robust"], help="study starts: laws to fly"
    )
    p.add_argument(
        "--plants", nargs="+", choices=tuple(PLANTS), default=list(PLANTS), help="study starts: hulls to fly"
    )


@command("reproduction")
def main(argv: Sequence[str] | None = None) -> int:
    """Run the reproduction or a study; return 0 done, 1 failed, 2 bad input, 130 interrupted."""
    p = parser()
    options = p.parse_args(argv)
    from auv_sim.studies.paper.paper_session import run

    return run(options, not_default(p, options))


if __name__ == "__main__":
    raise SystemExit(main())
