"""What `scripts/benchmark.py` does: measure, compare with another checkout, print, renew the page."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.checks.benchmark import against, console_cost, figures_page, fleet_cost, machine, sheets
from auv_sim.checks.benchmark.measures import (
    dimensions,
    graph_speed,
    law_speed,
    operation,
    recorder_cost,
)
from auv_sim.checks.benchmark.scale import FULL, QUICK, Scale
from auv_sim.command_line import EXIT_DONE, make_directory, to_type
from auv_sim.terminal import console, go_on, wrote
from auv_sim.views import doc_pages

Tick = Callable[[str], None]


def _simulation(scale: Scale, tick: Tick) -> dict[str, Any]:
    return {
        "closed_loop": law_speed.closed_loop_figures(scale, tick),
        "batch": law_speed.batch_figures(scale, tick),
    }


#: Section -> its measurement, and how many ticks of the progress bar it takes.
_SECTIONS: dict[str, tuple[Callable[[Scale, Tick], dict[str, Any]], Callable[[Scale], int]]] = {
    "lockstep": (graph_speed.lockstep_figures, lambda scale: 10 * scale.rounds),
    "dimensions": (dimensions.dimension_figures, lambda scale: 4 * scale.rounds + 2),
    "fleet": (fleet_cost.fleet_figures, lambda scale: 4 * scale.rounds),
    "latency": (graph_speed.latency_figures, lambda _: 3),
    "operation": (operation.abort_figures, lambda _: 1),
    "console": (console_cost.console_figures, lambda _: 1),
    "simulation": (_simulation, lambda scale: 1 + len(law_speed.vehicles(scale))),
    "start_up": (graph_speed.start_up_figures, lambda scale: scale.rounds),
    "subpaths": (law_speed.subpath_figures, lambda scale: len(scale.subpaths)),
    "recording": (recorder_cost.topic_figures, lambda scale: len(scale.topics)),
}


def measure(options: argparse.Namespace) -> int:
    """Measure, print, and renew the page as the command line asks; return the exit code.

    Raises:
        ConfigurationError: an option, the page or the other checkout cannot be used.
    """
    if options.write_docs:
        if options.only:
            raise ConfigurationError(
                "--write-docs", "together with --only", "all sections, the page needs them"
            )
        doc_pages.check(options.page, figures_page.PART)  # before minutes of measuring, not after
        make_directory(options.images, "--images")
    out = console()
    figures = _measured(options, out)
    found = sheets.sheets(figures)
    out.print(", ".join(f"{name} {value}" for name, value in figures["machine"].items()), soft_wrap=True)
    sheets.show(found, out)
    if options.json is not None:
        write_text(options.json, json.dumps(figures, indent=2) + "\n")
        wrote(out, options.json, "all figures")
    if options.write_docs:
        figures_page.renew(options.page, options.images, figures, found)
        wrote(out, options.page, f"renewed, with {options.images / figures_page.PICTURE}")
    else:
        go_on(out, "Measure everything and renew the page", to_type("benchmark.py", write_docs=True))
    return EXIT_DONE


def _measured(options: argparse.Namespace, out: Console) -> dict[str, Any]:
    """Measure the chosen sections under a progress bar: section -> its figures."""
    scale = QUICK if options.quick else FULL
    chosen = options.only or ([] if options.against and not options.write_docs else list(_SECTIONS))
    theirs = against.interpreter_of(options.against) if options.against is not None else ""
    figures: dict[str, Any] = {"machine": machine.describe(), "load": machine.load(), "quick": options.quick}
    total = sum(_SECTIONS[name][1](scale) for name in chosen) + (against.ticks(scale) if theirs else 0)
    columns = (BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=out, transient=True) as bar:
        task = bar.add_task("", total=total)
        begun = 0

        def tick(text: str) -> None:
            nonlocal begun
            bar.update(task, completed=begun, description=text)
            begun += 1

        for name in chosen:
            figures[name] = _SECTIONS[name][0](scale, tick)
        if theirs:
            figures["against"] = against.figures(scale, tick, theirs)
    return figures
