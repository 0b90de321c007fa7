"""Several runs in one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.flight.metrics import under_way
from auv_sim.views.plot_style import BLUE, GREEN, INK, ORANGE, PATH, RED, save, style

_COLOURS = (BLUE, ORANGE, GREEN, RED, "#7b4fa3", "#8a6d3b", "#2b8c9e", "#55606b")


def draw(flights: list[RecordedMission], labels: list[str], png: Path) -> None:
    """Tracks over the path, and signals over s, so that runs of different speed lie on each other.

    Track and distance are the true ones, where they were recorded, with the odometry's beside them.

    Raises:
        OSError: the picture cannot be written.
    """
    figure = Figure(figsize=(16.0, 9.5), dpi=100, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.add_gridspec(4, 2, width_ratios=(1.0, 1.15))
    tracks = figure.add_subplot(grid[:, 0])
    style(tracks, "north x (m)")
    tracks.set_xlabel("east y (m)", color=INK)
    rows = [figure.add_subplot(grid[0, 1])]
    rows += [figure.add_subplot(grid[k, 1], sharex=rows[0]) for k in range(1, 4)]
    names = ("distance to the path (m)", "heading error (°)", "rudder (°)", "current estimate (m/s)")
    for axes, name in zip(rows, names, strict=True):
        style(axes, name)
    drawn: set[str] = set()
    for k, (flight, label) in enumerate(zip(flights, labels, strict=True)):
        run, mission = flight.run, flight.mission
        if run is None or mission is None:
            continue
        if mission.name not in drawn:
            drawn.add(mission.name)
            x, y, _ = mission.path.polyline(1.0)
            tracks.plot(y, x, color=PATH, linewidth=6.0, solid_capstyle="round", zorder=1)
        flown = under_way(run, mission.path.n)
        look: dict[str, Any] = {"color": _COLOURS[k % len(_COLOURS)], "linewidth": 1.3, "label": label}
        x, y = flown.track
        index = flown.subpath(mission.path.n)
        tracks.plot(y, x, **look)
        distance = mission.path.distance(x, y, index)
        if np.isfinite(flown.x_true).any():
            assumed = {
                **look,
                "linewidth": 0.9,
                "linestyle": (0, (2, 2)),
                "label": f"{label}, by its odometry",
            }
            tracks.plot(flown.y, flown.x, **assumed)
            rows[0].plot(flown.s, mission.path.distance(flown.x, flown.y, index), **assumed)
        rudder = flown.rudder if np.isfinite(flown.rudder).any() else flown.rudder_cmd
        signals = (
            distance,
            np.degrees(flown.psi_e),
            np.degrees(rudder),
            np.hypot(flown.Vx_est, flown.Vy_est),
        )
        for axes, values in zip(rows, signals, strict=True):
            axes.plot(flown.s, values, **look)
    tracks.set_aspect("equal", adjustable="datalim")
    tracks.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, frameon=False)
    for axes in rows[:-1]:
        axes.tick_params(labelbottom=False)
    rows[-1].set_xlabel("path parameter s (subpath k runs from k − 1 to k)", color=INK)
    save(figure, png)
