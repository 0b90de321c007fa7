"""Several runs in one picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_sim.bags.content.recorded_mission import RecordedMission
from auv_sim.flight.metrics import under_way
from auv_sim.flight.path_cells import metres_of
from auv_sim.flight.run_record import Column, Run, SpatialRun
from auv_sim.views.plot_style import BLUE, GREEN, INK, ORANGE, PATH, RED, save, style

_COLOURS = (BLUE, ORANGE, GREEN, RED, "#7b4fa3", "#8a6d3b", "#2b8c9e", "#55606b")
#: The rows; two more where every run is in three dimensions.
_DISTANCE, _DEPTH, _DEPTH_ERROR = "distance to the path (m)", "depth (m)", "depth error (m, below +)"
_OTHERS = ("heading error (°)", "rudder (°)", "current estimate (m/s)")


def draw(flights: list[RecordedMission], labels: list[str], png: Path) -> None:
    """Draw tracks over the path, and signals over the length of path and over time.

    Over the length of path, runs of different speed coincide. Track and distance are the true ones where
    recorded, with the odometry's beside them.

    Raises:
        OSError: the picture cannot be written.
    """
    dive = all(flight.spatial is not None for flight in flights)
    names = (_DISTANCE, *((_DEPTH, _DEPTH_ERROR) if dive else ()), *_OTHERS)
    figure = Figure(figsize=(20.0, 9.5 + 2.5 * dive), dpi=100, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    tracks, columns = _axes(figure, names)
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
        look = {"color": _COLOURS[k % len(_COLOURS)], "linewidth": 1.3, "label": label}
        _draw_run(tracks, columns, flown, _signals(flight, flown, dive), look)
    tracks.set_aspect("equal", adjustable="datalim")
    tracks.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, frameon=False)
    if dive:
        columns[0][1].invert_yaxis()  # with the other column's, which shares it
    save(figure, png)


def _axes(figure: Figure, names: tuple[str, ...]) -> tuple[Axes, tuple[list[Axes], list[Axes]]]:
    """Return the axes of the map, and those of the signals over the length of path and over time."""
    grid = figure.add_gridspec(len(names), 3, width_ratios=(1.0, 0.9, 0.9))
    tracks = figure.add_subplot(grid[:, 0])
    style(tracks, "north x (m)")
    tracks.set_xlabel("east y (m)", color=INK)
    columns: tuple[list[Axes], list[Axes]] = [], []
    for j, (column, over) in enumerate(zip(columns, ("length of path (m)", "time (s)"), strict=True)):
        for k, name in enumerate(names):
            beside = columns[0][k] if j else None
            axes = figure.add_subplot(grid[k, 1 + j], sharex=column[0] if k else None, sharey=beside)
            style(axes, name if j == 0 else "")
            axes.tick_params(labelbottom=k + 1 == len(names), labelleft=j == 0)
            column.append(axes)
        column[0].set_title(f"over {over.split(' (', maxsplit=1)[0]}", fontsize=11, color=INK, loc="left")
        column[-1].set_xlabel(over, color=INK)
    return tracks, columns


class _Signals:
    """The rows of one run, and what they are drawn over; `by_odometry` is None without a known truth."""

    def __init__(self, rows: list[Column], way: Column, time: Column, by_odometry: Column | None) -> None:
        self.rows, self.over, self.by_odometry = rows, (way, time), by_odometry


def _signals(flight: RecordedMission, flown: Run, dive: bool) -> _Signals:
    """Return the signals of the rows under way."""
    mission, spatial = flight.mission, flight.spatial
    assert mission is not None
    path = mission.path
    x, y = flown.track
    index = flown.subpath(path.n)
    if spatial is not None and isinstance(flown, SpatialRun):
        distance, depth = spatial.closest(x, y, flown.depth, flown.subpath(spatial.n))
        vertical = [flown.depth, flown.depth - depth] if dive else []
    else:
        distance, vertical = path.distance(x, y, index), []
    rudder = flown.rudder if np.isfinite(flown.rudder).any() else flown.rudder_cmd
    rows = [
        distance,
        *vertical,
        np.degrees(flown.psi_e),
        np.degrees(rudder),
        np.hypot(flown.Vx_est, flown.Vy_est),
    ]
    is_known = bool(np.isfinite(flown.x_true).any()) and spatial is None
    own = path.distance(flown.x, flown.y, index) if is_known else None
    time = flown.t - flown.t[0] if flown.steps else flown.t
    return _Signals(rows, metres_of(spatial or path, flown.s), time, own)


def _draw_run(
    tracks: Axes, columns: tuple[list[Axes], list[Axes]], flown: Run, signals: _Signals, look: dict[str, Any]
) -> None:
    """Draw one run: its track, and its signals."""
    x, y = flown.track
    tracks.plot(y, x, **look)
    odometry = {
        **look,
        "linewidth": 0.9,
        "linestyle": (0, (2, 2)),
        "label": f"{look['label']}, by its odometry",
    }
    if np.isfinite(flown.x_true).any():
        tracks.plot(flown.y, flown.x, **odometry)
    for column, over in zip(columns, signals.over, strict=True):
        if signals.by_odometry is not None:
            column[0].plot(over, signals.by_odometry, **odometry)
        for axes, values in zip(column, signals.rows, strict=True):
            axes.plot(over, values, **look)
