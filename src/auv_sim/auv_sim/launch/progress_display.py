"""The progress of a mission on the terminal."""

from __future__ import annotations

import math
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, ProgressColumn, TaskProgressColumn, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bar

from auv_path_following.curves.composite import CompositePath
from auv_sim.terminal import console as terminal


def place_on(path: CompositePath, s: float) -> tuple[int, float]:
    """Return the subpath (from 0) at s of Eq. (1), and the length of path before s, m."""
    i = min(int(s), path.n - 1)
    return i, path.length - path.distance_to_go(i, min(s - i, 1.0))


class Bars:
    """Bars on the terminal, drawn from entering the context until leaving it."""

    def __init__(self, *columns: ProgressColumn, console: Console, quiet: bool) -> None:
        first = TextColumn("{task.description}"), BarColumn(), TaskProgressColumn()
        self._bar = Bar(*first, *columns, console=console, disable=quiet)

    def __enter__(self) -> Self:
        self._bar.__enter__()
        return self

    def say(self, text: str, needed: bool = False) -> None:
        """Print lines above the bars.

        Args:
            text: to print.
            needed: print them with `--quiet` too.
        """
        shown = terminal() if needed and self._bar.console.quiet else self._bar.console
        shown.print(escape(text), highlight=False, soft_wrap=True)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.__exit__(kind, error, trace)


class ProgressDisplay(Bars):
    """A bar along the path: subpath, s, distance to the path, speed relative to real time.

    Args:
        path: the path being flown.
        console: where to draw.
        quiet: draw nothing.
    """

    def __init__(self, path: CompositePath, console: Console, quiet: bool = False) -> None:
        super().__init__(TimeElapsedColumn(), console=console, quiet=quiet)
        self._path = path
        self._task = self._bar.add_task("starting the nodes", total=path.length)

    def waiting_for(self, what: str) -> None:
        """Show what the mission waits for."""
        self._bar.update(self._task, description=f"waiting for {what}")

    def update_other(self, name: str, length: float, to_go: float, ye: float, mission_time: float) -> None:
        """Show a mission that was set in flight, of which only name and length of path (m) are known."""
        flown = min(max(length - to_go, 0.0), length) if math.isfinite(to_go) else 0.0
        text = f"{name} {flown:.0f}/{length:.0f} m  off {abs(ye):5.2f} m  {mission_time:6.1f} s"
        self._bar.update(self._task, total=length, completed=flown, description=escape(text))

    def update(self, s: float, ye: float, mission_time: float, wall_time: float) -> None:
        """Show the vehicle's progress: s of Eq. (1), cross-track error (m), times (s)."""
        i, flown = place_on(self._path, s)
        segment = self._path.segments[i]
        speed = mission_time / wall_time if wall_time > 0.0 else 0.0
        text = (
            f"subpath {i + 1}/{self._path.n} {segment.kind:<16.16} s {s:5.2f}  off {abs(ye):5.2f} m  "
            f"{mission_time:6.1f} s  x{speed:.0f}"
        )
        self._bar.update(self._task, total=self._path.length, completed=flown, description=text)
