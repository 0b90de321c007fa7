"""The picture of a dive: track and path in three dimensions, and the depth over the length of path."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Line3DCollection

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.metrics import under_way
from auv_sim.flight.path_cells import metres_of
from auv_sim.flight.run_record import Column, SpatialRun
from auv_sim.views import signal_panels as panels
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, RED, save, style

#: Most points of the track that are drawn in three dimensions.
_POINTS = 3000
#: Share of the values that the colours resolve; larger ones have the last colour.
_RESOLVED = 98.0
#: Depths are drawn larger than horizontal distances by one of these, so that they take a third of the extent.
_STRETCHES = (1.0, 2.0, 5.0, 10.0, 20.0)
_SHARE = 0.35
#: The lesser horizontal extent is drawn at least as this share of the larger one.
_LEAST_WIDTH = 0.35


def draw(run: SpatialRun, path: CompositePath, spatial: SpatialPath | None, png: Path, title: str) -> None:
    """Draw the picture, 1600 x 1000 pixels.

    Args:
        run: the flown mission.
        path: its path, NED.
        spatial: the same in three dimensions; None for a flight at an altitude.
        png: the file to write.
        title: mission and vehicle.
    """
    flown = under_way(run, path.n)
    if not isinstance(flown, SpatialRun) or not flown.steps:
        return
    figure = Figure(figsize=(16.0, 10.0), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.05, 0.957, title, fontsize=18, fontweight="bold", color=INK, va="center", parse_math=False)
    away = _error(flown, path, spatial)
    _in_space(figure, flown, spatial, away)
    grid = figure.add_gridspec(
        3, 1, height_ratios=(1.6, 1.0, 1.0), left=0.56, right=0.985, top=0.87, bottom=0.07
    )
    rows = [figure.add_subplot(grid[0])]
    rows += [figure.add_subplot(grid[k], sharex=rows[0]) for k in (1, 2)]
    _profile(rows, flown, spatial, metres_of(spatial or path, flown.s))
    for axes in rows[:-1]:
        axes.tick_params(labelbottom=False)
    rows[-1].set_xlabel("length of path (m)", color=INK)
    figure.align_ylabels(rows)
    save(figure, png, dpi=100)


def _error(flown: SpatialRun, path: CompositePath, spatial: SpatialPath | None) -> Column:
    """Return the distance to the path; in the plane for a flight at an altitude."""
    if spatial is None:
        return path.distance(*flown.track, flown.subpath(path.n))
    return spatial.distance(*flown.track, flown.depth, flown.subpath(spatial.n))


def _in_space(figure: Figure, flown: SpatialRun, spatial: SpatialPath | None, away: Column) -> None:
    """Draw the left half: east to the right, north away, depth down, the track coloured by its distance."""
    axes: Any = figure.add_axes((-0.01, 0.1, 0.47, 0.78), projection="3d")
    assert isinstance(axes, Axes3D)
    x, y = flown.track
    every = max(1, flown.steps // _POINTS)
    points = np.column_stack((y, x, flown.depth))[::every]
    lines = [points]
    if spatial is not None:
        north, east, depth, _ = spatial.polyline(1.0)
        axes.plot(east, north, depth, color=PATH, linewidth=5.0, solid_capstyle="round", label="path")
        lines.append(np.column_stack((east, north, depth)))
    if np.isfinite(flown.bottom).any():
        axes.plot(y, x, flown.bottom, color="#8a6d3b", linewidth=1.6, label="bottom")
        lines.append(np.column_stack((y, x, flown.bottom)))
    stretch = _scale(axes, np.concatenate(lines))
    segments = np.stack((points[:-1], points[1:]), axis=1)
    limit = max(float(np.nanpercentile(away, _RESOLVED)), 1e-3)
    track = Line3DCollection(segments, cmap="viridis", linewidths=2.2)
    track.set_array(away[::every][1:])
    track.set_clim(0.0, limit)
    axes.add_collection3d(track)
    for row, marker, color, label in ((0, "^", GREEN, "start"), (-1, "s", RED, "end")):
        axes.plot([y[row]], [x[row]], [flown.depth[row]], marker, color=color, markersize=9, label=label)
    place = figure.add_axes((0.1, 0.085, 0.3, 0.018))
    bar = figure.colorbar(track, cax=place, orientation="horizontal", extend="max")
    plane = "distance" if spatial is not None else "horizontal distance"
    bar.set_label(f"{plane} to the path (m), largest {np.nanmax(away):.2f}", color=INK)
    if stretch > 1.0:
        note = f"depths drawn {stretch:g} times as large"
        figure.text(0.27, 0.875, note, fontsize=10, color=MUTED, va="center")
    axes.legend(loc="upper left", bbox_to_anchor=(0.08, 1.04), ncols=2, frameon=False)


def _scale(axes: Axes3D, points: Any) -> float:
    """Set limits and scales for points (east, north, depth); return how much larger depths are drawn."""
    low, high = np.nanmin(points, axis=0), np.nanmax(points, axis=0)
    size = high - low
    size[:2] = np.maximum(size[:2] * 1.08, _LEAST_WIDTH * size[:2].max() + 1.0)
    middle = 0.5 * (low + high)
    deepest = max(float(high[2]) * 1.05, 1.0)
    highest = min(0.0, float(low[2]))
    ideal = _SHARE * float(np.hypot(*size[:2])) / (deepest - highest)
    stretch = max((one for one in _STRETCHES if one <= ideal), default=1.0)
    axes.set_xlim(middle[0] - 0.5 * size[0], middle[0] + 0.5 * size[0])
    axes.set_ylim(middle[1] - 0.5 * size[1], middle[1] + 0.5 * size[1])
    axes.set_zlim(deepest, highest)
    axes.set_box_aspect((size[0], size[1], stretch * (deepest - highest)), zoom=0.9)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_major_locator(MaxNLocator(5))
    axes.set_xlabel("east (m)", color=INK, labelpad=12.0)
    axes.set_ylabel("north (m)", color=INK, labelpad=12.0)
    axes.set_zlabel("depth (m)", color=INK)
    corners = np.array([[-1, -1], [-1, 1], [1, 1], [1, -1], [-1, -1]]) * 0.5 * size[:2] + middle[:2]
    axes.plot(
        corners[:, 0],
        corners[:, 1],
        np.zeros(5),
        color=GREEN,
        linewidth=1.2,
        linestyle=(0, (4, 3)),
        label="surface",
    )
    axes.view_init(elev=24.0, azim=-62.0)
    return stretch


def _profile(rows: list[Axes], flown: SpatialRun, spatial: SpatialPath | None, way: Column) -> None:
    """Draw the right half over the length of path: depth, depth error, pitch."""
    panels.depth(rows[0], way, flown, spatial)
    style(rows[1], "depth error (m)")
    if spatial is not None:
        depth, label = spatial.closest(*flown.track, flown.depth, flown.subpath(spatial.n))[1], "path's"
    else:
        depth, label = flown.depth_d, "requested one"
    rows[1].fill_between(
        way, flown.depth - depth, color=PATH, alpha=0.6, linewidth=0.0, label=f"depth less the {label}"
    )
    if spatial is not None:
        rows[1].plot(way, flown.ze, color=ORANGE, linewidth=1.2, label="ze (below positive)")
    rows[1].invert_yaxis()
    style(rows[2], "pitch (°)")
    rows[2].plot(way, np.degrees(flown.theta_d), color=PATH, linewidth=4.0, label="desired")
    rows[2].plot(way, np.degrees(flown.theta), color=BLUE, linewidth=1.3, label="flown (bow up positive)")
    for axes in rows[1:]:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=3, fontsize=9, frameon=False)
