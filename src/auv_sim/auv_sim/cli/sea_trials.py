"""`scripts/sea_trials.py`: one mission in one sea with many seeds, without ROS, on all cores."""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_path_following import config_files
from auv_sim.command_line import (
    EXIT_DONE,
    EXIT_FAILED,
    Parser,
    add_flown_option,
    at_least_one,
    command,
    make_directory,
    positive,
    to_type,
    whole,
)
from auv_sim.flight.batch import engine
from auv_sim.flight.flown_share import percent
from auv_sim.flight.least_share import LEAST_SHARE_AT_SEA
from auv_sim.flight.metrics import without_nan
from auv_sim.launch import mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import DEFAULT_MISSION, DEFAULT_PARAMS, DEFAULT_VEHICLE, Options
from auv_sim.studies import noise_study
from auv_sim.studies.pool import tracked
from auv_sim.studies.trials import Together, Trial, judge, together
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, progress_bar, wrote
from auv_sim.views import doc_pages

#: Of the page.
PART = "trials"


class Job(NamedTuple):
    """One flight: names of files, and the seed."""

    mission: str
    vehicle: str
    params: str
    sea: str
    seed: int


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="sea_trials.py",
        allow_abbrev=False,
        description="Fly a mission in a sea with many seeds, and judge it by where the vehicle really was.",
    )
    p.add_argument("--mission", default=DEFAULT_MISSION, metavar="FILE", help="default: %(default)s")
    p.add_argument("--vehicle", default=DEFAULT_VEHICLE, metavar="FILE", help="default: %(default)s")
    p.add_argument(
        "--params",
        nargs="+",
        default=[DEFAULT_PARAMS, "rough"],
        metavar="FILE",
        help="gains to compare (default: robust rough)",
    )
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument("--sea", default="rough", metavar="FILE", help=f"file or one of: {seas} (default: rough)")
    p.add_argument("--seeds", type=at_least_one, default=50, metavar="N", help="how many (default 50)")
    p.add_argument("--first", type=whole, default=0, metavar="N", help="the first seed (default 0)")
    p.add_argument(
        "--limit", type=positive, default=2.5, metavar="M", help="largest true distance to the path (2.5 m)"
    )
    add_flown_option(p, LEAST_SHARE_AT_SEA)
    p.add_argument(
        "--study",
        choices=("noise",),
        help="instead: rudder activity against the level of noise, as a picture and a table",
    )
    p.add_argument(
        "--workers", type=at_least_one, default=os.cpu_count() or 1, metavar="N", help="processes (all)"
    )
    p.add_argument(
        "--out",
        type=Path,
        default=Path("sea_trials"),
        metavar="DIR",
        help="where to write (default: sea_trials)",
    )
    p.add_argument(
        "--page",
        type=Path,
        metavar="FILE",
        help="renew the table on this page (docs/sea.md), and the study's picture in images/ beside it",
    )
    return p


@command("sea trials")
def main(argv: Sequence[str] | None = None) -> int:
    """Returns the exit code: 0 all within the limit, 1 not, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    console = terminal()
    make_directory(options.out)
    noise = options.study == "noise"
    if options.page is not None:
        doc_pages.check(options.page, noise_study.PART if noise else PART)  # before the flights, not after
    if noise:
        picture = _pictures(options) / "rudder_activity.png"
        with progress_bar(console) as bar:
            study = noise_study.fly(
                options.mission, options.vehicle, options.sea, partial(_flown, bar, options.workers)
            )
        noise_study.draw(study, picture)
        _write(options.out / "rudder_activity.json", noise_study.record(study))
        if options.page is not None:
            doc_pages.renew(options.page, noise_study.PART, noise_study.markdown(study))
        console.print(noise_study.table(study))
        wrote(console, picture, "the table as a picture")
        return EXIT_DONE
    return _trials(options, console)


def fly(job: Job) -> Trial:
    """Fly one seed here and now.

    Raises:
        ConfigurationError: a file that cannot be used.
    """
    scenario = _plan(job).scenario()
    return judge(engine.track(scenario), scenario.path, job.params, job.seed)


def _flown(
    bar: Progress, workers: int, what: str, work: Callable[[Any], Any], items: Sequence[Any]
) -> list[Any]:
    """`pool.tracked`, with the laws compiled before."""
    task = bar.add_task("compiling the laws (once for each version of them)", total=None)
    engine.compile_once(at_sea=True)
    bar.remove_task(task)
    return tracked(bar, workers, what, work, items)


def _plan(job: Job) -> Plan:
    return mission_plan.make(Options(**job._asdict()), Path())


def _trials(options: argparse.Namespace, console: Console) -> int:
    seeds = range(options.first, options.first + options.seeds)
    jobs = [
        Job(options.mission, options.vehicle, params, options.sea, seed)
        for seed in seeds
        for params in options.params
    ]
    for job in jobs[: len(options.params)]:  # a mistake is told before the pool starts
        _plan(job)
    with progress_bar(console) as bar:
        trials = _flown(bar, options.workers, "flying", fly, jobs)
    rows = together(trials, options.limit, options.flown)
    record = {
        "mission": options.mission,
        "vehicle": options.vehicle,
        "sea": options.sea,
        "seeds": [seeds.start, seeds.stop - 1],
        "limit_m": options.limit,
        "least_flown_share": options.flown,
        "together": [dataclasses.asdict(row) for row in rows],
        "trials": [dataclasses.asdict(trial) for trial in trials],
    }
    target = options.out / f"{Path(options.sea).stem}.json"
    _write(target, record)
    if options.page is not None:
        doc_pages.renew(options.page, PART, _markdown(rows))
    console.print(_table(rows, options))
    worst = max(trials, key=lambda trial: (not trial.completed, trial.largest_distance))
    wrote(console, target, "every flight")
    files = {"mission": options.mission, "vehicle": options.vehicle, "params": worst.params}
    again = to_type("mission.py", **files, sea=options.sea, seed=worst.seed)
    go_on(console, "The worst one over ROS", again)
    return EXIT_DONE if all(row.within == row.flights for row in rows) else EXIT_FAILED


_COLUMNS: tuple[tuple[str, Callable[[Together], str]], ...] = (
    ("completed", lambda row: f"{row.completed} of {row.flights}"),
    ("flown: worst", lambda row: percent(row.flown_share)),
    ("largest (m): median", lambda row: f"{row.median['largest_distance']:.2f}"),
    ("worst", lambda row: f"{row.worst['largest_distance']:.2f}"),
    ("corner: worst", lambda row: f"{row.worst['largest_at_corners']:.2f}"),
    ("rms: median", lambda row: f"{row.median['rms_distance']:.2f}"),
    ("odometry off: worst", lambda row: f"{row.worst['navigation_error']:.2f}"),
    ("rudder (°/m): median", lambda row: f"{row.median['rudder_travel']:.2f}"),
    ("rms rate (°/s)", lambda row: f"{row.median['rudder_rate']:.1f}"),
)


def _table(rows: Sequence[Together], options: argparse.Namespace) -> Table:
    mission, water = Path(options.mission).stem, Path(options.sea).stem
    title = f"{mission} in {water}: true distances, limit {options.limit:g} m, flown {percent(options.flown)}"
    table = Table(title=title, title_justify="left")
    table.add_column("gains")
    for heading, _ in _COLUMNS:
        table.add_column(heading, justify="right", min_width=len("50 of 50"))
    for row in rows:
        color = "green" if row.within == row.flights else "red"
        table.add_row(f"[{color}]{row.params}[/]", *(cell(row) for _, cell in _COLUMNS))
    return table


def _markdown(rows: Sequence[Together]) -> str:
    cells = [
        [f"`{row.params.removesuffix('.yaml')}.yaml`", *(cell(row) for _, cell in _COLUMNS)] for row in rows
    ]
    return doc_pages.markdown_table(["gains", *(heading for heading, _ in _COLUMNS)], cells)


def _write(file: Path, record: Any) -> None:
    """Strict JSON; what is not known (a corner where there is none) becomes null."""
    text = json.dumps(without_nan(record), indent=2, allow_nan=False)
    write_text(file, text + "\n")


def _pictures(options: argparse.Namespace) -> Path:
    """Where they go: beside the page that shows them, or where everything goes."""
    if options.page is None:
        return Path(options.out)
    images: Path = options.page.parent / "images"
    make_directory(images, "--page")
    return images


if __name__ == "__main__":
    raise SystemExit(main())
