"""The study of `vehicle.py identify --study`: many simulated vehicles, identified and judged by the truth."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_sim.command_line import at_least_one, whole
from auv_sim.own_vehicle.identify.results.identification_tables import IDENTIFIED
from auv_sim.own_vehicle.identify.study.identified_cases import Case, Judged, outcome_of
from auv_sim.studies.pool import each
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table, progress_bar, wrote
from auv_sim.views.doc_pages import markdown_table, renew

#: Half of a 95 % interval, in standard deviations.
_REACH = 1.96
#: Coefficients of each data set that have to be identified.
_LEAST = 8


class Timed(NamedTuple):
    """An outcome and its wall time, flights included, s."""

    outcome: Judged
    seconds: float


class Row(NamedTuple):
    """One figure: name, median, worst, unit, target, and whether it is met."""

    name: str
    median: str
    worst: str
    target: str
    met: bool


def add_study_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the study."""
    parser.add_argument(
        "--study", type=at_least_one, metavar="N",
        help="instead of recordings: identify N simulated vehicles with random hulls, and judge by the truth",
    )  # fmt: skip
    parser.add_argument("--first", type=whole, default=0, metavar="SEED", help="of the study's first vehicle")
    parser.add_argument(
        "--program", default="eight_minutes", metavar="FILE", help="of the study (default: %(default)s)"
    )
    parser.add_argument(
        "--sea", default="moderate", metavar="FILE", help="of the study (default: %(default)s)"
    )
    parser.add_argument(
        "--workers", type=at_least_one, default=2, metavar="N", help="processes of the study (2)"
    )
    parser.add_argument("--page", type=Path, metavar="FILE", help="page with the study's figures, to renew")


def study(
    count: int, first: int, program: str, sea: str, workers: int, out: Path, page: Path | None,
    quiet: bool = False,
) -> int:  # fmt: skip
    """Identify vehicles of seeds `first` on, every second one stable in yaw; print and write the figures.

    Args:
        count: vehicles.
        first: seed of the first one.
        program: of manoeuvres.
        sea: their conditions.
        workers: processes.
        out: JSON file with every outcome.
        page: Markdown page whose part named by the program is renewed.
        quiet: whether nothing is printed.
    """
    console = terminal(quiet)
    cases = [Case(seed, seed % 2 == 1, program, sea) for seed in range(first, first + count)]
    found: list[Timed] = []
    with progress_bar(console, quiet) as bar:
        task = bar.add_task("vehicles", total=count)
        for _, timed in each(_timed, cases, min(workers, count), lambda: bar.advance(task)):
            found.append(timed)
            found.sort(key=lambda one: one.outcome.case.seed)
            write_text(out, json.dumps([_plain(one) for one in found], indent=1))
    rows = figures([one.outcome for one in found], program)
    seconds = [one.seconds for one in found]
    title = f"{count} vehicles of seeds {first} to {first + count - 1}, {program} in {sea}"
    console.print(_table(title, rows))
    console.print(f"{np.median(seconds):.1f} s each (median), {max(seconds):.1f} s at most", highlight=False)
    wrote(console, out, "every outcome")
    if page is not None:
        heads = ("", "median", "worst", "target", "met")
        cells = [
            (row.name, row.median, row.worst, row.target, "yes" if row.met else "**no**") for row in rows
        ]
        renew(page, program, markdown_table(heads, cells))
    return 0 if all(row.met for row in rows) else 1


def _timed(case: Case) -> Timed:
    begin = time.perf_counter()
    outcome = outcome_of(case)
    return Timed(outcome, time.perf_counter() - begin)


def _plain(timed: Timed) -> dict[str, object]:
    return timed.outcome._asdict() | {"case": timed.outcome.case._asdict(), "seconds": timed.seconds}


def figures(outcomes: Sequence[Judged], program: str) -> list[Row]:
    """Return the figures and their targets; of two minutes only the rudder's effect has one."""
    b = _row(outcomes, "effect of the rudder b", "%", 100.0, 4.0 if "two" in program else 3.0, lambda o: o.b)
    if "two" in program:
        return [b]
    return [
        b,
        _row(outcomes, "tightest turn", "%", 100.0, 2.0, lambda o: o.radius),
        _row(outcomes, "speed", "%", 100.0, 3.0, lambda o: o.speed),
        _row(outcomes, "yaw pole", "1/s", 1.0, 0.1, lambda o: o.pole_off),
        _row(outcomes, "dead time", "ms", 1000.0, 10.0, lambda o: o.dead_time),
        _row(outcomes, "rudder rate", "%", 100.0, 1.0, lambda o: o.rate),
        _row(outcomes, "current", "m/s", 1.0, 0.02, lambda o: o.current),
        _row(outcomes, "left out, yaw rate over 2 s", "%", 100.0, 5.0, lambda o: o.two),
        _row(
            outcomes,
            "left out, over 10 s, over that of the truth",
            "",
            1.0,
            1.15,
            lambda o: o.ten / o.true_ten,
        ),
        *_coverage(outcomes),
    ]


def _row(
    outcomes: Sequence[Judged],
    name: str,
    unit: str,
    factor: float,
    target: float,
    value: Callable[[Judged], float],
) -> Row:
    sizes = factor * np.abs([value(outcome) for outcome in outcomes])
    met = bool(sizes.max() <= target)
    unit = f" {unit}" if unit else ""
    return Row(name, f"{np.median(sizes):.2g}{unit}", f"{sizes.max():.2g}{unit}", f"{target:g}{unit}", met)


def _coverage(outcomes: Sequence[Judged]) -> list[Row]:
    """Return the share of intervals that hold the truth, of the combinations identified, and how many are."""
    identified = np.array([outcome.shares for outcome in outcomes]) < IDENTIFIED
    holds = np.abs([outcome.scores for outcome in outcomes]) < _REACH
    inside, counts = float(holds[identified].mean()), identified.sum(axis=1)
    middle = float(np.median(counts))
    many = f"{int(identified.sum())} intervals"
    return [
        Row("95 % intervals that hold the truth", f"{100.0 * inside:.1f} %", many, "90 %", inside >= 0.9),
        Row("identified of 14", f"{middle:g}", f"{counts.min()}", f"{_LEAST} (median)", middle >= _LEAST),
    ]


def _table(title: str, rows: Sequence[Row]) -> Table:
    table = headed_table(title, ("",), ("median", "worst", "target", "met"))
    for row in rows:
        table.add_row(*row[:4], "yes" if row.met else "no")
    return table
