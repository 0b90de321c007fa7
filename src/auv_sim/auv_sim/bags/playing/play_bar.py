"""Where a replay is and what its keys do, in one line that stays where it is."""

from __future__ import annotations

import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn

#: How often the line changes, s of wall time.
_PERIOD = 0.1
#: What the keys do, for people.
KEYS = "space pause, s step, q end"


class PlayBar:
    """Shows state and position; with a keyboard, the keys too. Where there is no terminal, only the end.

    Args:
        console: where to.
        length: of what is played, s.
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
