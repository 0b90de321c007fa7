"""`scripts/campaign.py`: fly a study, continue an interrupted one, repeat one of its runs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from auv_path_following import config_files
from auv_sim.command_line import Parser, add_quiet, at_least_one, command, to_type


def parser() -> argparse.ArgumentParser:
    """Return the command line's parser."""
    p = Parser(
        prog="campaign.py",
        description="Fly a study: many missions with parameters drawn from distributions or grids.",
        epilog="After an interruption the same command continues the campaign.",
        allow_abbrev=False,
    )
    shipped = ", ".join(config_files.shipped("studies"))
    p.add_argument("study", metavar="STUDY", help=f"file, directory of a campaign, or one of: {shipped}")
    p.add_argument("--out", type=Path, metavar="DIR", help="campaign directory (default: campaigns/STUDY)")
    p.add_argument(
        "--workers", type=at_least_one, metavar="N", help="worker processes (default: one for each core)"
    )
    p.add_argument(
        "--chunk", type=at_least_one, metavar="N", help="runs that one worker flies and stores at once"
    )
    p.add_argument(
        "--dask", nargs="?", const="", metavar="ADDRESS",
        help="use Dask: a scheduler such as tcp://host:8786, or without ADDRESS a cluster on this machine",
    )  # fmt: skip
    p.add_argument("--replay-run", type=_number, metavar="K", help="fly run K (from 0) again, and draw it")
    p.add_argument("--graph", action="store_true", help="with --replay-run: fly it over ROS 2, and record it")
    add_quiet(p)
    return p


def _number(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"found '{text}', expected the number of a run, from 0")
    return int(text)


@command("campaign")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly; return 0 done, 1 failed, 2 bad input, 130 interrupted."""
    words = sys.argv[1:] if argv is None else argv
    options = parser().parse_args(words)
    again = to_type("campaign.py", *words)
    try:
        from auv_sim.studies.campaign.campaign_session import run

        return run(options, again)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(
            f"\ncampaign interrupted; finished chunks are kept. Go on:  {again}"
        ) from None


if __name__ == "__main__":
    raise SystemExit(main())
