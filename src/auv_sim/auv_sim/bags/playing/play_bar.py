"""Position and keys of a replay, in one line."""

from __future__ import annotations

import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

#: Period of updates, s of wall time.
_PERIOD = 0.1
#: The keys and their actions.
KEYS = "space pause, s step, q end"


class PlayBar:
    """Shows state and position, and with a keyboard the keys. Without a terminal, only the end.

    Args:
        console: to draw on.
        length: of the selection, s.
        keys: whether there is a keyboard.
    """

    def __init__(self, console: Console, length: float, keys: bool) -> None:
        columns = [
            TextColumn("{task.description}"),
            BarColumn(bar_width=20),
            TextColumn("{task.completed:.1f} of {task.total:.1f} s"),
        ]
        self._progress = Progress(
            *columns, *([TextColumn(f"[dim]{KEYS}[/dim]")] if keys else []), console=console
        )
        self._task = self._progress.add_task("playing", total=length)
        self._shown = -_PERIOD

    def show(self, seconds: float, paused: bool, at_once: bool = False) -> None:
        """Move to a position, s since the beginning; at most ten times a second unless `at_once`."""
        now = time.monotonic()
        if at_once or now - self._shown >= _PERIOD:
            self._shown = now
            word = "paused " if paused else "playing"
            self._progress.update(self._task, completed=seconds, description=word)

    def __enter__(self) -> PlayBar:
        self._progress.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._progress.stop()
