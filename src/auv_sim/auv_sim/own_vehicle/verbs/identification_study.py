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
from auv_sim.own_vehicle.output_files import check_outputs
from auv_sim.own_vehicle.verbs.study_figures import Row, dive_figures, figures
from auv_sim.studies.pool import each
from auv_sim.terminal import console as terminal
from auv_sim.terminal import headed_table, progress_bar, wrote
from auv_sim.views import doc_pages


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
    parser.add_argument(
        "--first", type=whole, default=0, metavar="N", help="seed of the study's first vehicle (default: 0)"
    )
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
        "--workers",
        type=at_least_one,
        default=2,
        metavar="N",
        help="processes of the study (default: %(default)d)",
    )
    parser.add_argument("--page", type=Path, metavar="FILE", help="page with the study's figures, to renew")


def study(options: argparse.Namespace) -> int:
    """Identify vehicles of seeds from `options.first` on; print and write the figures.

    Args:
        options: those of `add_study_arguments`; also `out`, which gives the JSON file with every outcome its
            name, `overwrite` and `quiet`.

    Returns:
        0 if every target is met, else 1.

    Raises:
        ConfigurationError: the JSON file exists, the page has no part named by the program, or there is no
            such program or sea.
    """
    console, out, page = terminal(options.quiet), options.out.with_suffix(".json"), options.page
    check_outputs([out], [] if page is None else [page], options.overwrite)
    program = options.program or ("eight_minutes_dive" if options.dive else "eight_minutes")
    if page is not None:
        doc_pages.check(page, program)
    found = _identified(_cases(options, program), options.workers, out, options.quiet)
    rows = _judged([one.outcome for one in found], program)
    seconds = [one.seconds for one in found]
    last = options.first + options.study - 1
    title = f"{options.study} vehicles of seeds {options.first} to {last}, {program} in {options.sea}"
    console.print(_table(title, rows))
    console.print(f"{np.median(seconds):.1f} s each (median), {max(seconds):.1f} s at most", highlight=False)
    wrote(console, out, "every outcome")
    if page is not None:
        doc_pages.renew(page, program, _markdown(rows))
    return 0 if all(row.met for row in rows) else 1


def _cases(options: argparse.Namespace, program: str) -> Sequence[Case | DiveCase]:
    """Return what to identify; in the plane every second vehicle is stable in yaw."""
    seeds = range(options.first, options.first + options.study)
    if options.dive:
        return [DiveCase(seed, program, options.sea) for seed in seeds]
    return [Case(seed, seed % 2 == 1, program, options.sea) for seed in seeds]


def _identified(cases: Sequence[Case | DiveCase], workers: int, out: Path, quiet: bool) -> list[Timed]:
    """Return the outcomes by seed; those so far are written after each identification."""
    found: list[Timed] = []
    with progress_bar(terminal(quiet), quiet) as bar:
        task = bar.add_task("vehicles", total=len(cases))
        for _, timed in each(_timed, cases, min(workers, len(cases)), lambda: bar.advance(task)):
            found.append(timed)
            found.sort(key=lambda one: one.outcome.case.seed)
            write_text(out, json.dumps([_plain(one) for one in found], indent=1))
    return found


def _markdown(rows: Sequence[Row]) -> str:
    cells = [(row.name, row.median, row.worst, row.target, "yes" if row.met else "**no**") for row in rows]
    return doc_pages.markdown_table(("", "median", "worst", "target", "met"), cells)


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
