"""The study of `vehicle.py identify --study`: many simulated vehicles, identified and judged by the truth."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_sim.command_line import at_least_one, whole
from auv_sim.own_vehicle.identify.study.identified_cases import Case, Judged, outcome_of
from auv_sim.own_vehicle.identify.study.identified_dives import DiveCase, JudgedDive, dive_outcome_of
from auv_sim.own_vehicle.verbs.study_figures import Row, dive_figures, figures
from auv_sim.studies.pool import each
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table, progress_bar, wrote
from auv_sim.views.doc_pages import markdown_table, renew


class Timed(NamedTuple):
    """An outcome and its wall time, flights included, s."""

    outcome: Judged | JudgedDive
    seconds: float


def add_study_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the study."""
    parser.add_argument(
        "--study", type=at_least_one, metavar="N",
        help="instead of recordings: identify N simulated vehicles with random hulls, and judge by the truth",
    )  # fmt: skip
    parser.add_argument("--first", type=whole, default=0, metavar="SEED", help="of the study's first vehicle")
    parser.add_argument(
        "--program", metavar="FILE", help="of the study (default: eight_minutes, or eight_minutes_dive)"
    )
    parser.add_argument(
        "--dive", action="store_true", help="of the study: heave and pitch of divers of 1 to 5 m"
    )
    parser.add_argument(
        "--sea", default="moderate", metavar="FILE", help="of the study (default: %(default)s)"
    )
    parser.add_argument(
        "--workers", type=at_least_one, default=2, metavar="N", help="processes of the study (2)"
    )
    parser.add_argument("--page", type=Path, metavar="FILE", help="page with the study's figures, to renew")


def study(
    count: int, first: int, program: str | None, sea: str, workers: int, out: Path, page: Path | None,
    quiet: bool = False, dive: bool = False,
) -> int:  # fmt: skip
    """Identify vehicles of seeds `first` on; print and write the figures.

    In the plane every second one is stable in yaw.

    Args:
        count: vehicles.
        first: seed of the first one.
        program: of manoeuvres.
        sea: their conditions.
        workers: processes.
        out: JSON file with every outcome.
        page: Markdown page whose part named by the program is renewed.
        quiet: whether nothing is printed.
        dive: whether heave and pitch are identified, of vehicles that dive.
    """
    console, seeds = terminal(quiet), range(first, first + count)
    program = program or ("eight_minutes_dive" if dive else "eight_minutes")
    cases: list[Case | DiveCase] = [
        DiveCase(seed, program, sea) if dive else Case(seed, seed % 2 == 1, program, sea) for seed in seeds
    ]
    found: list[Timed] = []
    with progress_bar(console, quiet) as bar:
        task = bar.add_task("vehicles", total=count)
        for _, timed in each(_timed, cases, min(workers, count), lambda: bar.advance(task)):
            found.append(timed)
            found.sort(key=lambda one: one.outcome.case.seed)
            write_text(out, json.dumps([_plain(one) for one in found], indent=1))
    rows = _judged([one.outcome for one in found], program)
    seconds = [one.seconds for one in found]
    title = f"{count} vehicles of seeds {first} to {first + count - 1}, {program} in {sea}"
    console.print(_table(title, rows))
    console.print(f"{np.median(seconds):.1f} s each (median), {max(seconds):.1f} s at most", highlight=False)
    wrote(console, out, "every outcome")
    if page is not None:
        renew(page, program, _markdown(rows))
    return 0 if all(row.met for row in rows) else 1


def _markdown(rows: Sequence[Row]) -> str:
    cells = [(row.name, row.median, row.worst, row.target, "yes" if row.met else "**no**") for row in rows]
    return markdown_table(("", "median", "worst", "target", "met"), cells)


def _timed(case: Case | DiveCase) -> Timed:
    begin = time.perf_counter()
    outcome = dive_outcome_of(case) if isinstance(case, DiveCase) else outcome_of(case)
    return Timed(outcome, time.perf_counter() - begin)


def _judged(outcomes: Sequence[Judged | JudgedDive], program: str) -> list[Row]:
    dives = [one for one in outcomes if isinstance(one, JudgedDive)]
    return (
        dive_figures(dives, program)
        if dives
        else figures([o for o in outcomes if isinstance(o, Judged)], program)
    )


def _plain(timed: Timed) -> dict[str, object]:
    return timed.outcome._asdict() | {"case": timed.outcome.case._asdict(), "seconds": timed.seconds}


def _table(title: str, rows: Sequence[Row]) -> Table:
    table = headed_table(title, ("",), ("median", "worst", "target", "met"))
    for row in rows:
        table.add_row(*row[:4], "yes" if row.met else "no")
    return table
