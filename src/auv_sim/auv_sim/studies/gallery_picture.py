"""One picture of a mission flown without and with a current: tracks and distances to the path."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_path_following.curves.outline import polygon
from auv_path_following.missions.mission_file import Mission
from auv_sim.flight.run_record import Run
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, save, style

_LOOKS = {"none": (BLUE, "no current"), "current": (ORANGE, "in the current")}


def draw(
    mission: Mission, runs: Mapping[str, Run], current: tuple[float, float], title: str, png: Path
) -> None:
    """Draw the picture, 1100 x 640 pixels.

    Args:
        mission: what was flown.
        runs: the rows under way, "none" and "current".
        current: of the second one (north, east), m/s.
        title: what the picture shows.
        png: the file to write.
    """
    figure = Figure(figsize=(11.0, 6.4), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(
        1, 2, width_ratios=(1.25, 1.0), left=0.065, right=0.985, top=0.87, bottom=0.09, wspace=0.17
    )
    figure.text(0.065, 0.95, title, fontsize=16, fontweight="bold", color=INK, va="center")
    left, right = figure.add_subplot(grid[0]), figure.add_subplot(grid[1])
    _tracks(left, mission, runs, current)
    _distances(right, mission, runs)
    save(figure, png)


def _tracks(axes: Axes, mission: Mission, runs: Mapping[str, Run], current: tuple[float, float]) -> None:
    style(axes, "north x (m)")
    axes.set_xlabel("east y (m)", color=INK)
    outlines = [polygon(segment, 0.05) for segment in mission.path.segments]
    x, y = (np.concatenate(axis) for axis in zip(*outlines, strict=True))
    axes.plot(y, x, color=PATH, linewidth=6.0, solid_capstyle="round", label="path")
    if mission.waypoints:
        north, east = zip(*mission.waypoints, strict=True)
        axes.plot(east, north, "x", color=MUTED, markersize=7, label="waypoints")
    for name, run in runs.items():
        color, label = _LOOKS[name]
        axes.plot(run.y, run.x, color=color, linewidth=1.4, label=label)
    Vx, Vy = current
    strength = float(np.hypot(Vx, Vy))
    axes.quiver(
        0.06, 0.93, Vy / strength, Vx / strength, transform=axes.transAxes, angles="uv", pivot="middle",
        scale_units="inches", scale=2.2, units="inches", width=0.03, color=GREEN,
    )  # fmt: skip
    axes.text(
        0.11, 0.93, f"{strength:.2f} m/s", transform=axes.transAxes, color=GREEN, fontsize=9, va="center"
    )
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.05)
    axes.legend(
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4, fontsize=9, frameon=False, borderpad=0.1
    )


def _distances(axes: Axes, mission: Mission, runs: Mapping[str, Run]) -> None:
    style(axes, "distance to the path (m)")
    axes.set_xlabel("distance flown (m)", color=INK)
    largest = 0.0
    for name, run in runs.items():
        color, _ = _LOOKS[name]
        distance = mission.path.distance(run.x, run.y, run.subpath(mission.path.n))
        flown = np.concatenate(([0.0], np.cumsum(np.hypot(np.diff(run.x), np.diff(run.y)))))
        rms = float(np.sqrt(np.nanmean(distance**2)))
        most = float(np.nanmax(distance))
        largest = max(largest, most)
        axes.plot(flown, distance, color=color, linewidth=1.2, label=f"rms {rms:.3f}, largest {most:.2f} m")
    axes.set_ylim(0.0, 1.08 * largest)
    axes.set_xlim(left=0.0)
    axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, fontsize=8.5, frameon=False, borderpad=0.1,
        handlelength=1.2, columnspacing=1.2,
    )  # fmt: skip
