"""Options that `tune` and `prove` share: delay, rates, sea, uncertainty, seed."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence

from auv_path_following import config_files
from auv_sim.command_line import at_least_one, not_negative, positive, whole

#: Word for `--spread` where the vehicle file's comments state the uncertainty.
FROM_FILE = "file"


def spread(text: str) -> float | str:
    """Parse a spread: per cent, or `file`."""
    return text if text == FROM_FILE else not_negative(text)


spread.__name__ = "number"


def add_conditions(p: argparse.ArgumentParser, several: Sequence[str] = ()) -> None:
    """Add the options.

    Args:
        p: parser.
        several: seas if none is named, where more than one may be; without, one sea is.
    """
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument(
        "--delay", type=not_negative, default=0.0, metavar="S",
        help="further delay from a measurement to its command's arrival, besides the file's dead_time (0 s)",
    )  # fmt: skip
    p.add_argument(
        "--rate", type=positive, default=20.0, metavar="HZ", help="odometries a second (default: 20)"
    )
    p.add_argument(
        "--slowest", type=positive, default=10.0, metavar="HZ",
        help="slowest rate of the flights on lines (default: 10)",
    )  # fmt: skip
    if several:
        text = f"file or one of: {seas}; once for each sea (default: {' and '.join(several)})"
        p.add_argument("--sea", action="append", metavar="FILE", help=text)
    else:
        text = f"file or one of: {seas} (default: moderate)"
        p.add_argument("--sea", default="moderate", metavar="FILE", help=text)
    p.add_argument(
        "--spread", type=spread, default=0.0, metavar="PERCENT",
        help="uncertainty of coefficients, fin rates and dead times, half width (0); or `file`: of "
        "each as the comments of the vehicle file state it",
    )  # fmt: skip
    p.add_argument("--seed", type=whole, default=0, metavar="N", help="of all draws (default: 0)")
    p.add_argument(
        "--threads", type=at_least_one, default=os.cpu_count() or 1, metavar="N",
        help="flights at the same time (default: all cores)",
    )  # fmt: skip
    p.add_argument("--overwrite", action="store_true", help="replace files that exist")
    p.add_argument("--quiet", action="store_true", help="print nothing unless something goes wrong")
