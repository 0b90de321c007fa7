"""What `scripts/fault_matrix.py` does: spoil a flight row by row and print the reactions."""

from __future__ import annotations

import argparse
import json
import math
import os
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

from rich.console import Console
from rich.table import Table

from auv_msgs_py.contract import topics
from auv_msgs_py.settings.result_files import write_text
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.checks.faults.expectations import QUICK, TABLE, chosen
from auv_sim.checks.faults.fault_row import Expectation, Flight
from auv_sim.command_line import (
    EXIT_DONE,
    EXIT_FAILED,
    make_directory,
    to_type,
)
from auv_sim.launch.processes.domains import domain_for, variables_of
from auv_sim.terminal import console as terminal
from auv_sim.terminal import go_on, headed_table, number_cell, progress_bar

if TYPE_CHECKING:
    from auv_sim.checks.faults.row_judge import RowResult  # rclpy, only when it is needed


def run(arguments: argparse.Namespace, not_default: Mapping[str, Any]) -> int:
    """Fly what the command line asks for.

    Args:
        arguments: the command line's options.
        not_default: those of them that differ from their defaults.

    Returns:
        The exit code.
    """
    if arguments.list:
        print("\n".join(row.name for row in TABLE))
        return EXIT_DONE
    if arguments.hostile is not None and (arguments.rows or arguments.full or arguments.json):
        raise ConfigurationError("--hostile", "together with rows or --json", "it alone")
    rows = _rows(arguments)
    if arguments.out is not None:
        make_directory(arguments.out, new=True)
    with domain_for(arguments.domain) as domain:
        os.environ |= variables_of(domain)
        return _spoil(rows, arguments, not_default)


def _spoil(rows: list[Expectation], arguments: argparse.Namespace, not_default: Mapping[str, Any]) -> int:
    """Fly the rows, or the siege, in the ROS domain of the environment; return the exit code."""
    console = terminal()
    with tempfile.TemporaryDirectory(prefix="auv-faults-") as scratch:
        if arguments.hostile is not None:
            directory = arguments.out or Path(scratch)
            return _besiege(directory, arguments.speed, arguments.hostile, console)
        results = _run(rows, arguments.out or Path(scratch), arguments.speed, console)
    good = sum(result.good for result in results)
    if arguments.json is not None:
        from auv_sim.checks.faults.row_judge import as_data

        record = {"speed": arguments.speed, "good": good, "rows": [as_data(result) for result in results]}
        write_text(arguments.json, json.dumps(record, indent=2) + "\n")
    if not arguments.full and not arguments.rows:
        again = to_type("fault_matrix.py", full=True, speed=not_default.get("speed"))
        go_on(console, f"All {len(TABLE)} rows", again)
    return EXIT_DONE if good == len(results) == len(rows) else EXIT_FAILED


def _rows(arguments: argparse.Namespace) -> list[Expectation]:
    if arguments.full:
        return list(TABLE)
    try:
        return chosen(tuple(arguments.rows) or QUICK)
    except KeyError as error:
        raise ConfigurationError("ROW", str(error), "a name that --list prints") from None


def _run(rows: list[Expectation], directory: Path, speed: float, console: Console) -> list[RowResult]:
    from auv_sim.checks.faults.matrix import Matrix  # rclpy, only when it is needed
    from auv_sim.checks.faults.simulator_restart import kill_simulator

    begin = time.monotonic()
    results: list[RowResult] = []
    with progress_bar(console, disable=not console.is_terminal) as bar:
        task = bar.add_task("spoiling", total=len(rows))

        def show(result: RowResult) -> None:
            bar.update(task, advance=1, description=result.row.name)
            if not result.good:
                console.print(f"{result.row.name}: {'; '.join(result.wrong)}", style="red", highlight=False)

        simulator = [row for row in rows if row.place == topics.PLANT and row.fault == "kill"]
        others = [row for row in rows if row not in simulator]
        for flight in get_args(Flight):
            if spoiled := [row for row in others if row.flight == flight]:
                here = directory if flight == "plane" else directory / flight
                results += Matrix(here, speed, show, flight).run(spoiled)
        for row in simulator:
            results.append(kill_simulator(row, directory / "simulator", speed))
            show(results[-1])
    console.print(_table(results))
    console.print(summary(results, time.monotonic() - begin, speed), highlight=False)
    return results


def summary(results: Sequence[RowResult], seconds: float, speed: float) -> str:
    """Return the last line: how many rows are good, and how many of those only with the machine's allowance.

    Args:
        results: of all rows that were flown.
        seconds: that they took, of wall time.
        speed: of the simulator, times real time.
    """
    late = sum(result.good and result.is_late for result in results)
    allowed = f" ({late} within the allowance for a busy machine)" if late else ""
    return (
        f"{sum(result.good for result in results)} of {len(results)} rows as docs/safety.md says{allowed},"
        f" in {seconds:.0f} s of wall time at {speed:g} times real time"
    )


def _besiege(directory: Path, speed: float, seconds: float, console: Console) -> int:
    from auv_sim.checks.faults.siege import besiege  # rclpy, only when it is needed

    with progress_bar(console, disable=not console.is_terminal) as bar:
        task = bar.add_task("under attack", total=round(seconds))
        found = besiege(
            directory, speed, seconds, lambda share: bar.update(task, completed=round(share * seconds))
        )
    headings = ("process", "grew by (MB)", "topics named in /diagnostics")
    table = headed_table(f"{seconds:g} s beside a hostile node", headings)
    for name, grown in found.growth.items():
        table.add_row(name, f"{grown:.1f}", ", ".join(sorted(found.named.get(name, ()))))
    console.print(table)
    console.print(
        f"{found.refused} messages refused, rudder at most {math.degrees(found.largest_rudder):.1f} degrees",
        highlight=False,
    )
    for text in found.wrong:
        console.print(text, style="red", highlight=False, markup=False)
    return EXIT_FAILED if found.wrong else EXIT_DONE


def _table(results: list[RowResult]) -> Table:
    numbers = ("after (s)", "at most", "stopped (s)", "at most")
    title = "What failed, and what was done about it"
    table = headed_table(title, ("place", "fault", "noticed by"), numbers)
    table.add_column("mission")
    table.add_column("")
    place = ""
    for result in results:
        row = result.row
        if place and row.place != place:
            table.add_section()
        fault = row.fault + (", then abort" if row.then_abort else "")
        table.add_row(
            row.place if row.place != place else "", fault, row.noticed_by or "-",
            number_cell(result.noticed, 2),
            f"{row.within:g}{' wall' if row.wall else ''}" if row.noticed_by else "-",
            number_cell(result.safe, 2), f"{row.safe:g}" if row.safe else "-", row.outcome,
            "[green]ok[/green]" if result.good else f"[red]{'; '.join(result.wrong)}[/red]",
        )  # fmt: skip
        place = row.place
    return table
