"""Options that `tune` and `prove` share: delay, rates, sea, uncertainty, seed."""

from __future__ import annotations

import argparse
import os
from collections.abc import Mapping, Sequence

from auv_path_following import config_files
from auv_sim.command_line import add_overwrite, add_quiet, at_least_one, finite, whole

#: Word for `--spread` where the vehicle file's comments state the uncertainty.
FROM_FILE = "file"
#: Largest spread, per cent: a factor of 4. Largest delay, s, and rates of odometry, 1/s.
_WIDEST, _LATEST, _RATES = 300.0, 1.0, (0.5, 200.0)

#: Values of the conditions that are not given.
CONDITIONS = {"delay": 0.0, "rate": 20.0, "slowest": 10.0, "spread": 0.0}
#: Values of what `prove` claims that are not given.
CLAIM = {"flights": 1000, "within": 2.5, "within_depth": 1.0, "seed": 0}


def changed(options: argparse.Namespace, usual: Mapping[str, object]) -> dict[str, object]:
    """Return the options that differ from their usual values, by name."""
    values = {name: getattr(options, name) for name in usual}
    return {name: value for name, value in values.items() if value != usual[name]}


def spread(text: str) -> float | str:
    """Parse a spread: per cent, or `file`."""
    return text if text == FROM_FILE else _within(text, 0.0, _WIDEST, f" per cent, or `{FROM_FILE}`")


def delay(text: str) -> float:
    """Parse a delay, s."""
    return _within(text, 0.0, _LATEST, " s")


def rate(text: str) -> float:
    """Parse a rate of odometry, 1/s."""
    return _within(text, *_RATES, " a second")


def _within(text: str, low: float, high: float, unit: str) -> float:
    value = finite(text)
    if not low <= value <= high:
        raise argparse.ArgumentTypeError(f"found {text}, expected {low:g} to {high:g}{unit}")
    return value


spread.__name__ = delay.__name__ = rate.__name__ = "number"


def add_conditions(p: argparse.ArgumentParser, several: Sequence[str] = ()) -> None:
    """Add the options.

    Args:
        p: parser.
        several: seas if none is named, where more than one may be; without, one sea is.
    """
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument(
        "--delay", type=delay, default=CONDITIONS["delay"], metavar="S",
        help="further delay from a measurement to its command's arrival, besides the file's dead_time "
        "(default: %(default)g)",
    )  # fmt: skip
    p.add_argument(
        "--rate", type=rate, default=CONDITIONS["rate"], metavar="HZ",
        help="odometries a second (default: %(default)g)",
    )  # fmt: skip
    p.add_argument(
        "--slowest", type=rate, default=CONDITIONS["slowest"], metavar="HZ",
        help="slowest rate of the flights on lines (default: %(default)g)",
    )  # fmt: skip
    if several:
        text = f"file or one of: {seas}; once for each sea (default: {' and '.join(several)})"
        p.add_argument("--sea", action="append", metavar="FILE", help=text)
    else:
        text = f"file or one of: {seas} (default: moderate)"
        p.add_argument("--sea", default="moderate", metavar="FILE", help=text)
    usual = "0" if several else "what that file states, else 0"
    p.add_argument(
        "--spread", type=spread, default=CONDITIONS["spread"], metavar="PERCENT",
        help="uncertainty of coefficients, fin rates and dead times, half width; or `file`: of each as the "
        f"comments of the vehicle file state it (default: {usual})",
    )  # fmt: skip
    p.add_argument("--seed", type=whole, default=CLAIM["seed"], metavar="N", help="of all draws (default: 0)")
    p.add_argument(
        "--workers", type=at_least_one, default=os.cpu_count() or 1, metavar="N",
        help="flights at the same time (default: all cores)",
    )  # fmt: skip
    add_overwrite(p)
    add_quiet(p)
