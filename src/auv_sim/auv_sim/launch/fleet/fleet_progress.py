"""The progress of a fleet on the terminal."""

from __future__ import annotations

from collections.abc import Mapping
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, TaskProgressColumn, TextColumn
from rich.progress import Progress as Bar

from auv_path_following.curves.composite import CompositePath


class FleetProgress:
    """A bar for each vehicle along its path.

    Args:
        paths: vehicle -> its path.
        console: where to draw.
        quiet: draw nothing.
    """

    def __init__(self, paths: Mapping[str, CompositePath], console: Console, quiet: bool = False) -> None:
        self._paths = paths
        self._bar = Bar(
            TextColumn("{task.description}"),
            BarColumn(),
            TaskProgressColumn(),
            console=console,
            disable=quiet,
        )
        self._tasks = {
            label: self._bar.add_task(f"{label}: starting the nodes", total=path.length)
            for label, path in paths.items()
        }

    def __enter__(self) -> FleetProgress:
        self._bar.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._bar.__exit__(kind, error, trace)

    def waiting_for(self, what: str) -> None:
        """Show what the fleet waits for, at its first vehicle."""
        self._bar.update(next(iter(self._tasks.values())), description=f"waiting for {what:.60}")

    def update(self, label: str, s: float, mission_time: float, wall_time: float, ended: str) -> None:
        """Show one vehicle's progress: s of Eq. (1), times (s), how it has ended (empty: it has not)."""
        path = self._paths[label]
        i = min(int(s), path.n - 1)
        flown = path.length - path.distance_to_go(i, min(s - i, 1.0))
        speed = mission_time / wall_time if wall_time > 0.0 else 0.0
        text = f"{label}: subpath {i + 1}/{path.n}  {mission_time:6.1f} s  x{speed:.0f}  {ended}"
        self._bar.update(self._tasks[label], completed=flown, description=text)
