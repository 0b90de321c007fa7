"""`scripts/campaign.py`: fly a study, go on with one that was interrupted, fly one of its runs again."""

from __future__ import annotations

import argparse
import math
import os
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table

from auv_msgs_py.settings import user_files
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError, SuiteError
from auv_path_following import config_files
from auv_sim.command_line import EXIT_DONE, Parser, at_least_one, command, say, to_type
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.flight.flown_share import percent
from auv_sim.studies.campaign import campaign_pictures, campaign_replay, runner
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.statistics import Estimate
from auv_sim.studies.campaign.store import RESULTS, Store
from auv_sim.studies.campaign.summary import TOLD, Summary, figure_label, summarise
from auv_sim.studies.pool import WorkerDied
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

_POINTS = 40


def parser() -> argparse.ArgumentParser:
    """The command line."""
    p = Parser(
        prog="campaign.py",
        description="Fly a study: many missions with parameters drawn from distributions or grids.",
        epilog="Interrupted or killed, the same command goes on where it was.",
        allow_abbrev=False,
    )
    shipped = ", ".join(config_files.shipped("studies"))
    p.add_argument("study", metavar="STUDY", help=f"file, directory of a campaign, or one of: {shipped}")
    p.add_argument("--out", type=Path, metavar="DIR", help="campaign directory (default: campaigns/STUDY)")
    p.add_argument("--workers", type=at_least_one, metavar="N", help="processes (default: one for each core)")
    p.add_argument(
        "--chunk", type=at_least_one, metavar="N", help="runs that are handed out and kept together"
    )
    p.add_argument(
        "--dask", nargs="?", const="", metavar="ADDRESS",
        help="through Dask: a scheduler such as tcp://host:8786; without one a cluster on this machine",
    )  # fmt: skip
    p.add_argument("--replay-run", type=_number, metavar="K", help="fly run K (from 0) again, and draw it")
    p.add_argument("--graph", action="store_true", help="with --replay-run: over ROS 2, recorded")
    p.add_argument("--quiet", action="store_true", help="print nothing unless something goes wrong")
    return p


def _number(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"found '{text}', expected the number of a run, from 0")
    return int(text)


@command("campaign")
def main(argv: Sequence[str] | None = None) -> int:
    """Fly; returns the exit code: 0 done, 1 failed, 2 bad input, 130 interrupted."""
    options = parser().parse_args(argv)
    try:
        if options.graph and options.replay_run is None:
            raise ConfigurationError("--graph", "without --replay-run", "--replay-run K with it")
        store = _store(options)
        if options.replay_run is not None:
            return campaign_replay.replay(store, options.replay_run, options.graph, terminal(options.quiet))
        return _fly(store, options)
    except WorkerDied as error:
        raise SuiteError(f"{error}. What was flown is kept. Go on:  {_again(argv)}") from None
    except KeyboardInterrupt:
        raise KeyboardInterrupt(
            f"\ncampaign interrupted; what was flown is kept. Go on:  {_again(argv)}"
        ) from None


def _again(argv: Sequence[str] | None) -> str:
    return to_type("campaign.py", *(argv if argv is not None else sys.argv[1:]))


def _store(options: argparse.Namespace) -> Store:
    given = user_files.from_home(options.study)
    if user_files.is_directory(given):
        return Store(given)
    plan = StudyPlan(config_files.find("studies", options.study).absolute())
    for notice in plan.notices:
        say(f"notice {notice}", error=True)
    return Store((options.out or Path("campaigns") / plan.source.stem).absolute(), plan)


def _fly(store: Store, options: argparse.Namespace) -> int:
    console, plan = terminal(options.quiet), store.plan
    console.print(
        f"[bold]{escape(plan.study.name)}[/bold]: {plan.runs} flights"
        + (f", {len(plan.points)} points of the grids" if plan.grids else "")
        + (f"\n  {escape(plan.study.description)}" if plan.study.description else "")
    )
    size = options.chunk or (50 if COMPILED else 2)
    with store.alone():
        chunks = store.missing(size)
        if chunks and not store.same_code:
            raise ConfigurationError(
                str(store.directory), "a campaign begun with another version", "a new directory: --out DIR"
            )
        _fly_chunks(store, chunks, options, console)
        table = store.finish()
        summary = summarise(plan, table)
        write_text(store.directory / "summary.json", summary.to_json())
        drawn = campaign_pictures.draw(plan, table, summary, store.directory)
    _show(store, summary, drawn, console)
    return EXIT_DONE


def _fly_chunks(store: Store, chunks: list[range], options: argparse.Namespace, console: Console) -> None:
    if not chunks:
        return
    if not COMPILED:
        console.print(
            "[yellow]Numba is not installed: this takes many times as long, see docs/performance.md[/yellow]"
        )
    else:
        with console.status("compiling the laws (once for each version of them)"):
            engine.compile_once(bool(store.plan.study.sea))
    workers = options.workers or os.cpu_count() or 1
    if options.dask is None:
        results = runner.on_this_machine(store, chunks, workers)
    else:
        results = runner.through_dask(store, chunks, workers, options.dask)
    total, left = store.plan.runs, sum(map(len, chunks))
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        TimeRemainingColumn(), TextColumn("{task.fields[facts]}"), console=console, disable=options.quiet,
    )  # fmt: skip
    flown = good = seconds = 0.0
    began = time.monotonic()
    with bar:
        task = bar.add_task("flying", total=total, completed=total - left, facts="starting")
        for runs, table in results:
            store.keep(runs, table)
            flown += len(runs)
            good += sum(table.column("success").to_pylist())
            seconds += sum(table.column("duration").to_pylist())
            wall = time.monotonic() - began
            facts = (
                f"success {100 * good / flown:.1f} %  {flown / wall:.1f}/s  x{seconds / wall:.0f} real time"
            )
            bar.update(task, advance=len(runs), facts=facts)


def _show(store: Store, summary: Summary, drawn: list[Path], console: Console) -> None:
    console.print(f"\nsuccess    {_percent(summary.success)}\ncompleted  {_percent(summary.completed)}")
    console.print(
        f"flown      {_percent(summary.flown)}: at least {percent(store.plan.study.flown)} of the path\n"
    )
    if summary.points:
        console.print(_points(store.plan, summary))
    console.print(_figures(summary))
    told = [f"{name} {100 * value:.0f} %" for name, value in summary.explained.items() if value >= 0.005]
    if told:
        console.print(f"what explains {summary.judge} by itself: {', '.join(told[:6])}\n", soft_wrap=True)
    unknown = [name for name, value in summary.explained.items() if math.isnan(value)]
    if unknown:
        console.print(f"too few flights to tell: {', '.join(unknown)}\n", soft_wrap=True)
    for path, what in (
        (store.directory / RESULTS, "every run: its parameters and its figures"),
        (store.directory / "summary.json", "the figures above, for programs"),
        *((path, "") for path in drawn),
    ):
        wrote(console, path, what)
    again = to_type("campaign.py", store.directory, replay_run=summary.worst[0])
    go_on(console, "Fly the worst run again", again)


def _figures(summary: Summary) -> Table:
    table = Table(title="completed flights, with 95 % confidence intervals", title_justify="left")
    table.add_column("figure")
    for heading in ("mean", "median", "95 % of flights below", "largest"):
        table.add_column(heading, justify="right")
    for name in dict.fromkeys((*TOLD, summary.judge)):
        spread = summary.figures[name]
        cells = [_estimate(value) for value in (spread.mean, spread.median, spread.p95)]
        table.add_row(escape(figure_label(name)), *cells, f"{spread.largest:.4g}")
    return table


def _points(plan: StudyPlan, summary: Summary) -> Table:
    table = Table(title="points of the grids", title_justify="left")
    for name in plan.grids:
        table.add_column(name)
    for heading in ("flights", "success", escape(f"mean {figure_label(summary.judge)}")):
        table.add_column(heading, justify="right")
    best = sorted(summary.points, key=lambda point: (-point.success.value, point.judged.value))
    shown = summary.points if len(summary.points) <= _POINTS else best[:_POINTS]
    for point in shown:
        cells = [
            f"{value:.4g}" if isinstance(value, float) else escape(str(value))
            for value in point.values.values()
        ]
        table.add_row(*cells, str(point.runs), _percent(point.success), _estimate(point.judged))
    if len(shown) < len(summary.points):
        table.caption = f"the best {_POINTS} of {len(summary.points)}; all are in summary.json"
    return table


def _percent(estimate: Estimate) -> str:
    return f"{100 * estimate.value:.2f} % ({100 * estimate.low:.2f} to {100 * estimate.high:.2f})"


def _estimate(estimate: Estimate) -> str:
    return f"{estimate.value:.4g} ({estimate.low:.4g} to {estimate.high:.4g})"


if __name__ == "__main__":
    raise SystemExit(main())
