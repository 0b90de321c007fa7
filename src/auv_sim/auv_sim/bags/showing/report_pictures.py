"""The report's pictures: for a mission the overview and its two halves, and a dive; else the track alone."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import SpatialRun
from auv_sim.views import dive_picture, overview
from auv_sim.views.plot_style import BLUE, INK, ORANGE, save, style
from auv_sim.views.signal_rows import FinLimits, draw_rows, limits_of, rows_of
from auv_sim.views.track_panel import track


def pictures(flight: RecordedMission, directory: Path, title: str) -> list[Path]:
    """Draw the pictures that the recording allows; return the files."""
    run, mission, summary = flight.run, flight.mission, flight.summary
    if run is None or not run.steps:
        return []
    if mission is None or summary is None:
        return [_draw(directory / "track.png", lambda figure: _track_alone(figure, flight))]
    limits = limits_of(flight.vehicle) if flight.vehicle is not None else FinLimits()
    spatial = flight.spatial
    flown = under_way(run, mission.path.n)
    whole = directory / "overview.png"
    overview.draw(run, mission.path, summary, whole, title, limits=limits, spatial=spatial)

    def map_only(figure: Figure) -> None:
        track(figure.add_subplot(), flown, mission.path, summary.missed)

    def signals(figure: Figure) -> None:
        rows = list(figure.subplots(rows_of(flown), 1, sharex=True))
        draw_rows(rows, flown, mission.path, spatial, limits)
        rows[-1].set_xlabel("time since the start (s)", color=INK)
        figure.align_ylabels(rows)

    files = [whole, _draw(directory / "track.png", map_only), _draw(directory / "signals.png", signals)]
    if isinstance(run, SpatialRun):
        files.append(directory / "dive.png")
        dive_picture.draw(run, mission.path, spatial, files[-1], title)
    return files


def _track_alone(figure: Figure, flight: RecordedMission) -> None:
    run = flight.run
    assert run is not None
    axes = figure.add_subplot()
    style(axes, "north x (m)")
    axes.set_xlabel("east y (m)", color=INK)
    x, y = run.track
    if np.isfinite(run.x_true).any():
        axes.plot(run.y, run.x, color=ORANGE, linewidth=0.8, label="odometry")
    axes.plot(y, x, color=BLUE, linewidth=1.6, label="track")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, frameon=False)
    axes.set_aspect("equal", adjustable="datalim")


def _draw(png: Path, content: Callable[[Figure], None]) -> Path:
    figure = Figure(figsize=(12.0, 9.0), dpi=100, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    content(figure)
    save(figure, png)
    return png
