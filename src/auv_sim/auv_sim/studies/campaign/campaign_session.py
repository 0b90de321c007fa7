"""What `scripts/campaign.py` does: fly what is missing of a campaign and sum it up, or replay one run."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
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

from auv_msgs_py.settings import user_files
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError, SuiteError
from auv_path_following import config_files
from auv_sim.command_line import EXIT_DONE, say, to_type
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.compiled import COMPILED
from auv_sim.studies.campaign import campaign_replay, runner
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation import campaign_pictures, summary_tables
from auv_sim.studies.campaign.evaluation.summary import Summary, summarise
from auv_sim.studies.campaign.store import RESULTS, Store
from auv_sim.studies.pool import WorkerDied
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, wrote

#: Runs of a chunk, with Numba and without.
_CHUNK, _CHUNK_UNCOMPILED = 50, 2


def run(options: argparse.Namespace, again: str) -> int:
    """Fly the campaign, or repeat one of its runs.

    Args:
        options: the command line's.
        again: the command that continues the campaign.

    Returns:
        The exit code.

    Raises:
        ConfigurationError: the study, its directory or an option cannot be used.
        SuiteError: a worker process died.
    """
    if options.graph and options.replay_run is None:
        raise ConfigurationError("--graph", "without --replay-run", "--replay-run K with it")
    store = _store(options)
    if options.replay_run is not None:
        return campaign_replay.replay(store, options.replay_run, options.graph, terminal(options.quiet))
    try:
        return _fly(store, options)
    except WorkerDied as error:
        raise SuiteError(f"{error}. Finished chunks are kept. Go on:  {again}") from None


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
    with store.alone():
        chunks = store.missing(options.chunk or (_CHUNK if COMPILED else _CHUNK_UNCOMPILED))
        if chunks and not store.same_code:
            raise ConfigurationError(
                str(store.directory), "a campaign begun with another version", "a new directory: --out DIR"
            )
        if chunks:
            _keep(store, _flown(store, chunks, options, console), sum(map(len, chunks)), console)
        table = store.finish()
        summary = summarise(plan, table)
        write_text(store.directory / "summary.json", summary.to_json())
        drawn = campaign_pictures.draw(plan, table, summary, store.directory)
    summary_tables.show(plan, summary, console)
    _go_on(store, summary, drawn, console)
    return EXIT_DONE


def _flown(
    store: Store, chunks: list[range], options: argparse.Namespace, console: Console
) -> Iterator[tuple[range, pa.Table]]:
    """Compile the laws once, then start the workers; yield each chunk with its table."""
    if COMPILED:
        with console.status("compiling the laws (once for each version of them)"):
            engine.compile_once(bool(store.plan.study.sea), dives=store.plan.dives)
    else:
        console.print(
            "[yellow]Numba is not installed: this takes many times as long, see docs/performance.md[/yellow]"
        )
    workers = options.workers or os.cpu_count() or 1
    if options.dask is None:
        return runner.on_this_machine(store, chunks, workers)
    return runner.through_dask(store, chunks, workers, options.dask)


def _keep(store: Store, results: Iterator[tuple[range, pa.Table]], left: int, console: Console) -> None:
    """Keep each chunk as it is finished, under a progress bar; `left` runs are to come."""
    total = store.plan.runs
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        TimeRemainingColumn(), TextColumn("{task.fields[facts]}"), console=console, disable=console.quiet,
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


def _go_on(store: Store, summary: Summary, drawn: list[Path], console: Console) -> None:
    for path, what in (
        (store.directory / RESULTS, "every run: its parameters and its figures"),
        (store.directory / "summary.json", "the figures above, for programs"),
        *((path, "") for path in drawn),
    ):
        wrote(console, path, what)
    again = to_type("campaign.py", store.directory, replay_run=summary.worst[0])
    go_on(console, "Fly the worst run again", again)
