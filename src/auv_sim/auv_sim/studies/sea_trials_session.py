"""What `scripts/sea_trials.py` does: fly a mission with many seeds, or the noise study; print the result."""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.progress import Progress
from rich.table import Table

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.strict_json import without_nan
from auv_path_following import vehicle
from auv_sim.command_line import EXIT_DONE, EXIT_FAILED, make_directory, to_type
from auv_sim.flight import closed_loop
from auv_sim.flight.batch import engine
from auv_sim.flight.flown_share import percent
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.studies import noise_study
from auv_sim.studies.pool import tracked
from auv_sim.studies.trials import Together, Trial, judge, together
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, progress_bar, wrote
from auv_sim.views import doc_pages

#: Names of the table's parts of the page: of vehicles in the plane, and of those that dive.
PART, SPATIAL_PART = "trials", "spatial trials"


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
        part = SPATIAL_PART if vehicle.load(options.vehicle).dives else PART
        doc_pages.check(options.page, noise_study.PART if noise else part)  # before the flights, not after
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
    scenario = _scenario(job)
    run = closed_loop.fly(scenario) if scenario.vehicle.dives else engine.track(scenario)
    return judge(run, scenario.path, job.params, job.seed)


def _scenario(job: TrialJob) -> Scenario:
    """Return the flight of a job.

    Raises:
        ConfigurationError: a file that cannot be used.
    """
    return mission_plan.make(Options(**job._asdict()), Path()).scenario()


def _flown(
    bar: Progress, workers: int, what: str, work: Callable[[Any], Any], items: Sequence[Any]
) -> list[Any]:
    """Compile the laws, then run `pool.tracked`."""
    task = bar.add_task("compiling the laws (once for each version of them)", total=None)
    engine.compile_once(at_sea=True)
    bar.remove_task(task)
    return tracked(bar, workers, what, work, items)


def _trials(options: argparse.Namespace, console: Console) -> int:
    seeds = range(options.first, options.first + options.seeds)
    jobs = [
        TrialJob(options.mission, options.vehicle, params, options.sea, seed)
        for seed in seeds
        for params in options.params
    ]
    # A mistake is reported before the pool starts.
    scenarios = [_scenario(job) for job in jobs[: len(options.params)]]
    dives = scenarios[0].vehicle.dives
    with progress_bar(console) as bar:
        fly_all = tracked if dives else _flown
        trials = fly_all(bar, options.workers, "flying", fly, jobs)
    rows = together(trials, options.limit, options.flown, options.depth_limit)
    record = {
        "mission": options.mission,
        "vehicle": options.vehicle,
        "sea": options.sea,
        "seeds": [seeds.start, seeds.stop - 1],
        "limit_m": options.limit,
        "depth_limit_m": options.depth_limit if dives else None,
        "least_flown_share": options.flown,
        "together": [dataclasses.asdict(row) for row in rows],
        "trials": [dataclasses.asdict(trial) for trial in trials],
    }
    target = options.out / f"{Path(options.sea).stem}.json"
    _write(target, record)
    if options.page is not None:
        doc_pages.renew(options.page, SPATIAL_PART if dives else PART, _markdown(rows))
    console.print(_table(rows, options))
    worst = max(trials, key=lambda trial: (not trial.completed, trial.largest_distance))
    wrote(console, target, "every flight")
    if not dives:
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
#: Further columns for a vehicle that dives.
_IN_DEPTH: tuple[tuple[str, Callable[[Together], str]], ...] = (
    ("depth off (m): median", lambda row: f"{row.median['largest_depth_error']:.2f}"),
    ("depth off: worst", lambda row: f"{row.worst['largest_depth_error']:.2f}"),
    ("planes (°/m): median", lambda row: f"{row.median['planes_travel']:.2f}"),
)


def _columns(rows: Sequence[Together]) -> tuple[tuple[str, Callable[[Together], str]], ...]:
    return _COLUMNS + _IN_DEPTH if math.isfinite(rows[0].worst["largest_depth_error"]) else _COLUMNS


def _table(rows: Sequence[Together], options: argparse.Namespace) -> Table:
    mission, water = Path(options.mission).stem, Path(options.sea).stem
    title = f"{mission} in {water}: true distances, limit {options.limit:g} m, flown {percent(options.flown)}"
    columns = _columns(rows)
    table = headed_table(title, ("gains",), [heading for heading, _ in columns], min_width=len("50 of 50"))
    for row in rows:
        color = "green" if row.within == row.flights else "red"
        table.add_row(f"[{color}]{row.params}[/]", *(cell(row) for _, cell in columns))
    return table


def _markdown(rows: Sequence[Together]) -> str:
    columns = _columns(rows)
    lines = [
        [f"`{row.params.removesuffix('.yaml')}.yaml`", *(cell(row) for _, cell in columns)] for row in rows
    ]
    return doc_pages.markdown_table(["gains", *(heading for heading, _ in columns)], lines)


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
