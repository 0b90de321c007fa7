"""The picture of a fleet: all tracks, and the distances between the vehicles over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.run_record import Run
from auv_sim.flight.separation import Separation, closest_over_time
from auv_sim.views.plot_style import BLUE, GREEN, HALO, INK, MUTED, ORANGE, PATH, RED, save, style

_COLOURS = (BLUE, ORANGE, GREEN, RED)
#: Distance between the points of a path, m.
_SPACING = 1.0
#: At most this many pairs have a line each; of more, the least distance is drawn.
_MOST_PAIRS = 6


def draw(
    runs: Mapping[str, Run], paths: Mapping[str, CompositePath], pairs: Sequence[Separation], png: Path,
    title: str,
) -> None:  # fmt: skip
    """Draw the picture, 1600 x 900 pixels.

    Args:
        runs: vehicle -> its recording.
        paths: vehicle -> its path, NED.
        pairs: the distance of each pair.
        png: the file to write.
        title: the fleet's name.
    """
    figure = Figure(figsize=(16.0, 9.0), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.05, 0.95, title, fontsize=18, fontweight="bold", color=INK, va="center", parse_math=False)
    grid = figure.add_gridspec(1, 2, left=0.05, right=0.985, top=0.9, bottom=0.08, wspace=0.14)
    _tracks(figure.add_subplot(grid[0]), runs, paths, pairs)
    _distances(figure.add_subplot(grid[1]), pairs)
    save(figure, png)


def _tracks(
    axes: Axes, runs: Mapping[str, Run], paths: Mapping[str, CompositePath], pairs: Sequence[Separation]
) -> None:
    for k, (label, run) in enumerate(runs.items()):
        path, colour = paths[label], _COLOURS[k % len(_COLOURS)]
        north, east, _ = path.polyline(_SPACING)
        axes.plot(east, north, color=PATH, linewidth=4.0, zorder=1)
        axes.plot(run.y, run.x, color=colour, linewidth=1.4, label=label, zorder=2)
        axes.plot(run.y[:1], run.x[:1], "o", color=colour, zorder=3)
    met = min((pair for pair in pairs if len(pair.t)), key=lambda pair: pair.closest[0], default=None)
    if met is not None:
        distance, at = met.closest
        ends = [
            (np.interp(at, run.t, run.y), np.interp(at, run.t, run.x))
            for run in map(runs.get, met.vehicles)
            if run
        ]
        axes.plot(*zip(*ends, strict=True), "D-", color=INK, markersize=4, linewidth=1.0, zorder=4)
        axes.annotate(
            f"closest: {distance:.1f} m at {at:.0f} s", ends[0], (8, 8), textcoords="offset points",
            color=INK, path_effects=HALO, zorder=5,
        )  # fmt: skip
    axes.set_aspect("equal", adjustable="datalim")
    style(axes, "north (m)")
    axes.set_xlabel("east (m)", color=INK)
    axes.legend(frameon=False)


def _distances(axes: Axes, pairs: Sequence[Separation]) -> None:
    if len(pairs) <= _MOST_PAIRS:
        for k, pair in enumerate(pairs):
            axes.plot(pair.t, pair.distance, label=" and ".join(pair.vehicles), linewidth=1.4, zorder=2 + k)
    if len(pairs) > 1:
        t, least = closest_over_time(list(pairs))
        axes.plot(t, least, color=MUTED, linewidth=3.0, alpha=0.5, label="closest of all", zorder=1)
    style(axes, "distance between vehicles (m)")
    axes.set_xlabel("time (s)", color=INK)
    axes.set_ylim(bottom=0.0)
    axes.legend(frameon=False)
