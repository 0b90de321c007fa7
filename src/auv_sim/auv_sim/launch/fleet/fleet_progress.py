"""The progress of a fleet on the terminal."""

from __future__ import annotations

import math
from collections.abc import Mapping

from rich.console import Console
from rich.markup import escape

from auv_path_following.curves.composite import CompositePath
from auv_sim.launch.progress_display import Bars, place_on


class FleetProgress(Bars):
    """A bar for each vehicle along its path.

    Args:
        paths: vehicle -> its path.
        console: where to draw.
        quiet: draw nothing.
    """

    def __init__(self, paths: Mapping[str, CompositePath], console: Console, quiet: bool = False) -> None:
        super().__init__(console=console, quiet=quiet)
        self._paths = paths
        self._tasks = {
            label: self._bar.add_task(f"{label}: starting the nodes", total=path.length)
            for label, path in paths.items()
        }

    def waiting_for(self, what: str) -> None:
        """Show what the fleet waits for, at its first vehicle."""
        self._bar.update(next(iter(self._tasks.values())), description=f"waiting for {what:.60}")

    def update(self, label: str, s: float, mission_time: float, wall_time: float, ended: str) -> None:
        """Show one vehicle's progress: s of Eq. (1), times (s), how it has ended (empty: it has not)."""
        path = self._paths[label]
        i, flown = place_on(path, s)
        speed = mission_time / wall_time if wall_time > 0.0 else 0.0
        text = f"{label}: subpath {i + 1}/{path.n}  {mission_time:6.1f} s  x{speed:.0f}  {ended}"
        self._bar.update(self._tasks[label], total=path.length, completed=flown, description=text)

    def update_other(
        self, label: str, name: str, length: float, to_go: float, mission_time: float, state: str
    ) -> None:
        """Show another mission than the planned one: name, length and rest of its path (m), time (s)."""
        flown = min(max(length - to_go, 0.0), length) if math.isfinite(to_go) else 0.0
        text = f"{label}: {name} {flown:.0f}/{length:.0f} m  {mission_time:6.1f} s  {state}"
        self._bar.update(self._tasks[label], total=length, completed=flown, description=escape(text))
