"""What `scripts/sea_trials.py` does: fly a mission with many seeds, or the noise study; print the result."""

from __future__ import annotations

import argparse
import dataclasses
import json
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, make_directory, to_type
from auv_sim.flight.batch import engine
from auv_sim.flight.flown_share import percent
from auv_sim.flight.metrics import without_nan
from auv_sim.launch import mission_plan
from auv_sim.launch.mission_plan import Plan
from auv_sim.launch.options import Options
from auv_sim.studies import noise_study
from auv_sim.studies.pool import tracked
from auv_sim.studies.trials import Together, Trial, judge, together
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, progress_bar, wrote
from auv_sim.views import doc_pages

#: Name of the table's part of the page.
PART = "trials"


class TrialJob(NamedTuple):
    """One flight: names of files, and the seed."""

    mission: str
    vehicle: str
    params: str
    sea: str
    seed: int


def run(options: argparse.Namespace) -> int:
    """Fly the trials or the noise study; return the exit code."""
    console = terminal()
    make_directory(options.out)
    noise = options.study == "noise"
    if options.page is not None:
        doc_pages.check(options.page, noise_study.PART if noise else PART)  # before the flights, not after
    return _noise(options, console) if noise else _trials(options, console)


def _noise(options: argparse.Namespace, console: Console) -> int:
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


def fly(job: TrialJob) -> Trial:
    """Fly one seed in this process.

    Raises:
        ConfigurationError: a file that cannot be used.
    """
    scenario = _plan(job).scenario()
    return judge(engine.track(scenario), scenario.path, job.params, job.seed)


def _flown(
    bar: Progress, workers: int, what: str, work: Callable[[Any], Any], items: Sequence[Any]
) -> list[Any]:
    """Compile the laws, then run `pool.tracked`."""
    task = bar.add_task("compiling the laws (once for each version of them)", total=None)
    engine.compile_once(at_sea=True)
    bar.remove_task(task)
    return tracked(bar, workers, what, work, items)


def _plan(job: TrialJob) -> Plan:
    return mission_plan.make(Options(**job._asdict()), Path())


def _trials(options: argparse.Namespace, console: Console) -> int:
    seeds = range(options.first, options.first + options.seeds)
    jobs = [
        TrialJob(options.mission, options.vehicle, params, options.sea, seed)
        for seed in seeds
        for params in options.params
    ]
    for job in jobs[: len(options.params)]:  # report a mistake before the pool starts
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
_HEADS = [heading for heading, _ in _COLUMNS]


def _table(rows: Sequence[Together], options: argparse.Namespace) -> Table:
    mission, water = Path(options.mission).stem, Path(options.sea).stem
    title = f"{mission} in {water}: true distances, limit {options.limit:g} m, flown {percent(options.flown)}"
    table = headed_table(title, ("gains",), _HEADS, min_width=len("50 of 50"))
    for row in rows:
        color = "green" if row.within == row.flights else "red"
        table.add_row(f"[{color}]{row.params}[/]", *(cell(row) for _, cell in _COLUMNS))
    return table


def _markdown(rows: Sequence[Together]) -> str:
    lines = [
        [f"`{row.params.removesuffix('.yaml')}.yaml`", *(cell(row) for _, cell in _COLUMNS)] for row in rows
    ]
    return doc_pages.markdown_table(["gains", *_HEADS], lines)


def _write(file: Path, record: Any) -> None:
    """Write strict JSON; NaN (a corner's figure where there is no corner) becomes null."""
    text = json.dumps(without_nan(record), indent=2, allow_nan=False)
    write_text(file, text + "\n")


def _pictures(options: argparse.Namespace) -> Path:
    """Return the folder for pictures: images/ beside the page, or --out without a page."""
    if options.page is None:
        return Path(options.out)
    images: Path = options.page.parent / "images"
    make_directory(images, "--page")
    return images
