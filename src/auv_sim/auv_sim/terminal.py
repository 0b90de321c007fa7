"""Output of the commands: tables, progress, files written, the next command."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterable
from typing import Any

from rich.console import Console, ConsoleOptions, RenderableType
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.segment import Segment
from rich.table import Table

from auv_msgs_py.values.errors import printable_lines
from auv_sim.command_line import discard_output


class SafeConsole(Console):
    """A console that escapes control characters from files, and continues when its reader has gone."""

    def render(self, renderable: RenderableType, options: ConsoleOptions | None = None) -> Iterable[Segment]:
        """Spell out control characters (terminal escapes from files); rich's own colours stay."""
        for segment in super().render(renderable, options):
            if segment.control or segment.text.isprintable():
                yield segment
            else:
                yield segment._replace(text=printable_lines(segment.text))

    def on_broken_pipe(self) -> None:
        """Continue silently: under `| head -1`, too, a mission flies to its end."""
        self.quiet = True
        discard_output()


def console(quiet: bool = False, **options: Any) -> Console:
    """Return a console as wide as the terminal; in a pipe or a file, wide enough for the widest table."""
    free = not sys.stdout.isatty() and "COLUMNS" not in os.environ
    options = {"width": 140 if free else None, "highlight": False} | options
    return SafeConsole(quiet=quiet, **options)


def headed_table(
    title: str, texts: Iterable[str], numbers: Iterable[str] = (), **number_column: Any
) -> Table:
    """Return an empty table.

    Args:
        title: above it, at the left.
        texts: headings of the first columns.
        numbers: headings of the columns behind them, which are aligned to the right.
        number_column: further options of `rich.table.Table.add_column` for those.
    """
    table = Table(title=title, title_justify="left")
    for heading in texts:
        table.add_column(heading)
    for heading in numbers:
        table.add_column(heading, justify="right", **number_column)
    return table


def number_cell(value: float, digits: int) -> str:
    """Return a number for a table; NaN is a dash."""
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


def wrote(console: Console, path: object, what: str) -> None:
    """Print a path that was written, and its purpose; the path may look like markup."""
    console.print(f"  {escape(str(path))}  [dim]{escape(what)}[/dim]", soft_wrap=True, highlight=False)


def go_on(console: Console, words: str, line: str) -> None:
    """Print the next command, ready to be copied, and its purpose."""
    console.print(f"\n{words}:  {line}", soft_wrap=True, highlight=False, markup=False)


def progress_bar(console: Console, disable: bool = False) -> Progress:
    """Return a progress bar: task, count of total, elapsed time."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=console, disable=disable)


def steps_in(bar: Progress) -> Callable[[int, int, str], None]:
    """Return a callback that shows progress in a bar; it takes steps done, steps in all, present work."""
    task = bar.add_task("reading", total=None)

    def update(done: int, total: int, what: str) -> None:
        bar.update(task, completed=done, total=total, description=what)

    return update
