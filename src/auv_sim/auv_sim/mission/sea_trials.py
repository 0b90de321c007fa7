"""`scripts/sea_trials.py`: one mission in one sea with many seeds, without ROS, on all cores."""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import sys
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from auv_msgs_py.errors import ConfigurationError, SuiteError
from auv_path_following import config_files
from auv_sim import closed_loop
from auv_sim.analysis.metrics import without_nan
from auv_sim.analysis.trials import Together, Trial, judge, together
from auv_sim.command_line import (
    EXIT_BAD_INPUT,
    EXIT_DONE,
    EXIT_FAILED,
    EXIT_INTERRUPTED,
    Parser,
    positive,
    whole,
)
from auv_sim.command_line import console as terminal
from auv_sim.mission import noise_study, plan
from auv_sim.mission.plan import Options, Plan
from auv_sim.pool import each

BEGIN, END = "<!-- trials: begin -->", "<!-- trials: end -->"


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
    p.add_argument("--mission", default=plan.DEFAULT_MISSION, metavar="FILE", help="default: %(default)s")
    p.add_argument("--vehicle", default=plan.DEFAULT_VEHICLE, metavar="FILE", help="default: %(default)s")
    p.add_argument(
        "--params",
        nargs="+",
        default=[plan.DEFAULT_PARAMS, "rough"],
        metavar="FILE",
        help="gains to compare (default: robust rough)",
    )
    seas = ", ".join(config_files.shipped("seas"))
    p.add_argument("--sea", default="rough", metavar="FILE", help=f"file or one of: {seas} (default: rough)")
    p.add_argument("--seeds", type=_count, default=50, metavar="N", help="how many (default 50)")
    p.add_argument("--first", type=whole, default=0, metavar="N", help="the first seed (default 0)")
    p.add_argument(
        "--limit", type=positive, default=2.5, metavar="M", help="largest true distance to the path (2.5 m)"
    )
    p.add_argument(
        "--study",
        choices=("noise",),
        help="instead: rudder activity against the level of noise, as a picture and a table",
    )
    p.add_argument("--workers", type=_count, default=os.cpu_count() or 1, metavar="N", help="processes (all)")
    p.add_argument(
        "--out",
        type=Path,
        default=Path("sea_trials"),
        metavar="DIR",
        help="where to write (default: sea_trials)",
    )
    p.add_argument("--page", type=Path, metavar="FILE", help="renew the table on this page (docs/sea.md)")
    return p


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"found '{text}', expected a whole number of at least 1")
    return int(text)


def main(argv: Sequence[str] | None = None) -> int:
    """Returns the exit code: 0 all within the limit, 1 not, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    console = terminal()
    try:
        _directory(options.out)
        noise = options.study == "noise"
        _parts(options.page, *((noise_study.BEGIN, noise_study.END) if noise else (BEGIN, END)))
        if noise:
            with _progress(console) as bar:
                study = noise_study.fly(
                    options.mission, options.vehicle, options.sea, partial(_tracked, bar, options)
                )
            noise_study.draw(study, options.out / "rudder_activity.png")
            _write(options.out / "rudder_activity.json", noise_study.record(study))
            _renew(options.page, noise_study.BEGIN, noise_study.END, noise_study.markdown(study))
            console.print(noise_study.table(study))
            console.print(f"Picture: {options.out / 'rudder_activity.png'}", highlight=False)
            return EXIT_DONE
        return _trials(options, console)
    except ConfigurationError as error:
        print(error, file=sys.stderr)
        return EXIT_BAD_INPUT
    except SuiteError as error:
        print(f"sea trials failed: {error}", file=sys.stderr)
        return EXIT_FAILED
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED


def fly(job: Job) -> Trial:
    """Fly one seed here and now.

    Raises:
        ConfigurationError: a file that cannot be used.
    """
    scenario = _plan(job).scenario()
    return judge(closed_loop.fly(scenario), scenario.path, Path(job.params).stem, job.seed)


def _plan(job: Job) -> Plan:
    return plan.make(Options(**job._asdict()), Path())


def _trials(options: argparse.Namespace, console: Console) -> int:
    seeds = range(options.first, options.first + options.seeds)
    jobs = [
        Job(options.mission, options.vehicle, params, options.sea, seed)
        for seed in seeds
        for params in options.params
    ]
    for job in jobs[: len(options.params)]:  # a mistake is told before the pool starts
        _plan(job)
    with _progress(console) as bar:
        trials = _tracked(bar, options, "flying", fly, jobs)
    rows = together(trials, options.limit)
    record = {
        "mission": options.mission,
        "vehicle": options.vehicle,
        "sea": options.sea,
        "seeds": [seeds.start, seeds.stop - 1],
        "limit_m": options.limit,
        "together": [dataclasses.asdict(row) for row in rows],
        "trials": [dataclasses.asdict(trial) for trial in trials],
    }
    target = options.out / f"{Path(options.sea).stem}.json"
    _write(target, record)
    _renew(options.page, BEGIN, END, _markdown(rows))
    console.print(_table(rows, options))
    worst = max(trials, key=lambda trial: (not trial.completed, trial.largest_distance))
    console.print(f"  {target}  [dim]every flight[/dim]", highlight=False, soft_wrap=True)
    console.print(
        f"\nThe worst one over ROS:  python3 scripts/mission.py --mission {options.mission}"
        f" --params {worst.params} --sea {options.sea} --seed {worst.seed}",
        highlight=False,
        soft_wrap=True,
    )
    return EXIT_DONE if all(row.within == row.flights for row in rows) else EXIT_FAILED


_COLUMNS: tuple[tuple[str, Callable[[Together], str]], ...] = (
    ("completed", lambda row: f"{row.completed} of {row.flights}"),
    ("largest (m): median", lambda row: f"{row.median['largest_distance']:.2f}"),
    ("worst", lambda row: f"{row.worst['largest_distance']:.2f}"),
    ("corner: worst", lambda row: f"{row.worst['largest_at_corners']:.2f}"),
    ("rms: median", lambda row: f"{row.median['rms_distance']:.2f}"),
    ("odometry off: worst", lambda row: f"{row.worst['navigation_error']:.2f}"),
    ("rudder (°/m): median", lambda row: f"{row.median['rudder_travel']:.2f}"),
    ("rms rate (°/s)", lambda row: f"{row.median['rudder_rate']:.1f}"),
)


def _table(rows: Sequence[Together], options: argparse.Namespace) -> Table:
    title = (
        f"{Path(options.mission).stem} in {Path(options.sea).stem}: true distances, limit {options.limit:g} m"
    )
    table = Table(title=title, title_justify="left")
    table.add_column("gains")
    for heading, _ in _COLUMNS:
        table.add_column(heading, justify="right")
    for row in rows:
        color = "green" if row.within == row.flights else "red"
        table.add_row(f"[{color}]{row.params}[/]", *(cell(row) for _, cell in _COLUMNS))
    return table


def _markdown(rows: Sequence[Together]) -> str:
    lines = [["gains", *(heading for heading, _ in _COLUMNS)], ["---", *["---:"] * len(_COLUMNS)]]
    lines += [[f"`{row.params}.yaml`", *(cell(row) for _, cell in _COLUMNS)] for row in rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _write(file: Path, record: Any) -> None:
    """Strict JSON; what is not known (a corner where there is none) becomes null."""
    text = json.dumps(without_nan(record), indent=2, allow_nan=False)
    file.write_text(text + "\n", encoding="utf-8")


def _parts(page: Path | None, begin: str, end: str) -> tuple[str, str]:
    """What stands before and behind the page's table; asked once before the flights, not only after."""
    if page is None:
        return "", ""
    text = page.read_text(encoding="utf-8") if page.is_file() else ""
    if begin not in text or end not in text:
        found = f"{page} without a table to renew"
        raise ConfigurationError("--page", found, f"a page with {begin} and {end}")
    return text.split(begin)[0], text.split(end)[1]


def _renew(page: Path | None, begin: str, end: str, table: str) -> None:
    before, after = _parts(page, begin, end)
    if page is not None:
        page.write_text(f"{before}{begin}\n{table}\n{end}{after}", encoding="utf-8")


def _directory(out: Path) -> None:
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        found, expected = f"{out} ({error.strerror})", "a directory that can be made"
        raise ConfigurationError("--out", found, expected) from None


def _progress(console: Console) -> Progress:
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=console)


def _tracked(
    bar: Progress, options: argparse.Namespace, what: str, work: Callable[[Any], Any], items: Sequence[Any]
) -> list[Any]:
    """`work` on each item with a bar; results in order."""
    task = bar.add_task(what, total=len(items))
    results: list[Any] = [None] * len(items)
    for index, result in each(work, items, options.workers, lambda: bar.advance(task)):
        results[index] = result
    return results


if __name__ == "__main__":
    raise SystemExit(main())
