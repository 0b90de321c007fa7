"""Several runs in one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_path_following.curves.composite import CompositePath
from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import Run
from auv_sim.views.plot_style import BLUE, GREEN, INK, ORANGE, PATH, RED, save, style

_COLOURS = (BLUE, ORANGE, GREEN, RED, "#7b4fa3", "#8a6d3b", "#2b8c9e", "#55606b")


def draw(flights: list[RecordedMission], labels: list[str], png: Path) -> None:
    """Draw tracks over the path, and signals over s, so that runs of different speed coincide.

    Track and distance are the true ones where recorded, with the odometry's beside them.

    Raises:
        OSError: the picture cannot be written.
    """
    figure = Figure(figsize=(16.0, 9.5), dpi=100, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    tracks, rows = _axes(figure)
    drawn: set[str] = set()
    for k, (flight, label) in enumerate(zip(flights, labels, strict=True)):
        run, mission = flight.run, flight.mission
        if run is None or mission is None:
            continue
        if mission.name not in drawn:
            drawn.add(mission.name)
            x, y, _ = mission.path.polyline(1.0)
            tracks.plot(y, x, color=PATH, linewidth=6.0, solid_capstyle="round", zorder=1)
        colour = _COLOURS[k % len(_COLOURS)]
        _draw_run(tracks, rows, under_way(run, mission.path.n), mission.path, colour, label)
    tracks.set_aspect("equal", adjustable="datalim")
    tracks.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, frameon=False)
    for axes in rows[:-1]:
        axes.tick_params(labelbottom=False)
    rows[-1].set_xlabel("path parameter s (subpath k runs from k − 1 to k)", color=INK)
    save(figure, png)


def _axes(figure: Figure) -> tuple[Axes, list[Axes]]:
    """Return the axes of the map and of the four signals."""
    grid = figure.add_gridspec(4, 2, width_ratios=(1.0, 1.15))
    tracks = figure.add_subplot(grid[:, 0])
    style(tracks, "north x (m)")
    tracks.set_xlabel("east y (m)", color=INK)
    rows = [figure.add_subplot(grid[0, 1])]
    rows += [figure.add_subplot(grid[k, 1], sharex=rows[0]) for k in range(1, 4)]
    names = ("distance to the path (m)", "heading error (°)", "rudder (°)", "current estimate (m/s)")
    for axes, name in zip(rows, names, strict=True):
        style(axes, name)
    return tracks, rows


def _draw_run(
    tracks: Axes, rows: list[Axes], flown: Run, path: CompositePath, colour: str, label: str
) -> None:
    """Draw one run: its track, and its signals over s."""
    look: dict[str, Any] = {"color": colour, "linewidth": 1.3, "label": label}
    x, y = flown.track
    index = flown.subpath(path.n)
    tracks.plot(y, x, **look)
    distance = path.distance(x, y, index)
    if np.isfinite(flown.x_true).any():
        odometry = {**look, "linewidth": 0.9, "linestyle": (0, (2, 2)), "label": f"{label}, by its odometry"}
        tracks.plot(flown.y, flown.x, **odometry)
        rows[0].plot(flown.s, path.distance(flown.x, flown.y, index), **odometry)
    rudder = flown.rudder if np.isfinite(flown.rudder).any() else flown.rudder_cmd
    signals = (
        distance,
        np.degrees(flown.psi_e),
        np.degrees(rudder),
        np.hypot(flown.Vx_est, flown.Vy_est),
    )
    for axes, values in zip(rows, signals, strict=True):
        axes.plot(flown.s, values, **look)
