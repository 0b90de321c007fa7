"""The left half of the overview: the track over the path as in the paper, and its figures."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from auv_msgs_py.values.angles import wrap
from auv_path_following.curves.composite import CompositePath
from auv_sim.flight.figures.mission_summary import MissionSummary, SpatialMissionSummary, farthest
from auv_sim.flight.flown_share import Stretch
from auv_sim.flight.path_cells import cells_of, middles_of
from auv_sim.flight.run_record import Run
from auv_sim.views.labels import Labels, arrow
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, RED, fact, style

_TABLE_ROWS = 9
#: Most joints that are labelled with their kind; of the subpaths the longest are numbered.
_FEW, _NUMBERS = 30, 60
#: Least jump of the course at a corner, rad.
_STRAIGHT = 1e-3
#: The table's columns: left edge of the first, right edges of the others.
_TABLE_COLUMNS = (0.0, 0.33, 0.49, 0.64, 0.83, 1.0)
_SPATIAL_COLUMNS = (0.0, 0.31, 0.41, 0.53, 0.64, 0.74, 0.87, 1.0)


def track(axes: Axes, flown: Run, path: CompositePath, missed: Sequence[Stretch] = ()) -> None:
    """Draw the track over the path: north up, east right, equal scales.

    Args:
        axes: where to draw.
        flown: the rows under way.
        path: with numbered subpaths and joints.
        missed: stretches of path that were not flown, marked on it.
    """
    style(axes, "north x (m)")
    axes.set_xlabel("east y (m)", color=INK)
    path_x, path_y, _ = path.polyline(1.0)
    axes.plot(path_y, path_x, color=PATH, linewidth=6.0, solid_capstyle="round", label="path")
    _mark(axes, path, missed)
    x, y = flown.track
    if np.isfinite(flown.x_true).any():
        axes.plot(flown.y, flown.x, color=ORANGE, linewidth=0.8, label="odometry")
    axes.plot(y, x, color=BLUE, linewidth=1.6, label="track")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.07)
    axes.plot(
        [joint.y for joint in path.joints], [joint.x for joint in path.joints], "o", color="white",
        markeredgecolor=INK, markersize=6 if len(path.joints) <= _FEW else 3, zorder=4, linestyle="none",
    )  # fmt: skip
    if flown.steps:
        for row, marker, size, color, label in ((0, "^", 12, GREEN, "start"), (-1, "s", 9, RED, "end")):
            axes.plot(
                y[row], x[row], marker, color=color, markersize=size, markeredgecolor="white",
                zorder=5, linestyle="none", label=label,
            )  # fmt: skip
        _current_arrow(axes, flown, path)
    _numbers(axes, path)
    axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=6, fontsize=10, frameon=False, borderpad=0.2
    )


def _mark(axes: Axes, path: CompositePath, missed: Sequence[Stretch]) -> None:
    """Mark stretches on the path."""
    cells = cells_of(path)
    middles, label = middles_of(cells), "missed"
    for stretch in missed:
        x, y = cells.cells[(middles > stretch.begin) & (middles < stretch.end), :2].T
        axes.plot(y, x, color=RED, linewidth=6.0, alpha=0.45, solid_capstyle="round", label=label)
        label = ""


def _numbers(axes: Axes, path: CompositePath) -> None:
    """Number the subpaths to port and name the joints to starboard, corners first, where there is room."""
    labels = Labels(axes)
    by_importance = sorted(path.joints, key=lambda joint: joint.geometric != "G0")
    few = len(path.joints) <= _FEW
    for joint in by_importance if few else ():
        text = f"{joint.index}–{joint.index + 1} {joint.geometric}"
        color = RED if joint.geometric == "G0" else MUTED
        before, point = path.evaluate(joint.index - 1, 1.0), path.evaluate(joint.index, 0.0)
        turn = wrap(point.chi - before.chi)
        # Outside of a corner; without a jump of the course, to starboard.
        side = -18.0 if turn > _STRAIGHT else 18.0
        labels.write(text, (point.y, point.x), _beside(before.chi + 0.5 * turn, side), 8, color=color)
    longest_first = sorted(range(path.n), key=lambda k: -path.segments[k].length)
    for k in longest_first[:_NUMBERS]:
        point = path.segments[k].evaluate(0.35)
        look = {"color": MUTED, "fontweight": "bold"}
        labels.write(str(k + 1), (point.y, point.x), _beside(point.chi, -14.0), 12, **look)


def _beside(chi: float, points: float) -> tuple[float, float]:
    """Return an offset on the page to starboard of a course (to port when negative), points."""
    return points * math.cos(chi), -points * math.sin(chi)


def _current_arrow(axes: Axes, flown: Run, path: CompositePath) -> None:
    """Draw the mean current: its direction as an arrow of fixed length, its strength in words."""
    for name, Vx, Vy in (
        ("current", flown.Vx_true, flown.Vy_true),
        ("estimated current", flown.Vx_est, flown.Vy_est),
    ):
        if np.isfinite(Vx).any():
            arrow(axes, name, float(np.nanmean(Vx)), float(np.nanmean(Vy)), path)
            return


def table(axes: Axes, summary: MissionSummary) -> None:
    """Write the figures of each subpath; of many, those farthest from the path."""
    axes.set_axis_off()
    subpaths, head = summary.subpaths, "subpath"
    if len(subpaths) > _TABLE_ROWS:
        subpaths = tuple(farthest(subpaths, _TABLE_ROWS))
        head = f"farthest {_TABLE_ROWS} of {len(summary.subpaths)}"
    columns: list[tuple[str, str, str]] = [
        ("time (s)", "duration", "{:.1f}"),
        ("rms dist. (m)", "rms_distance", "{:.3f}"),
        ("largest (m)", "largest_distance", "{:.3f}"),
        ("rms heading (°)", "rms_heading_error", "{:.2f}"),
        ("rudder (°/m)", "rudder_travel_per_metre", "{:.2f}"),
    ]
    edges: tuple[float, ...] = _TABLE_COLUMNS
    if isinstance(summary, SpatialMissionSummary):
        edges = _SPATIAL_COLUMNS
        columns = [
            ("time (s)", "duration", "{:.1f}"),
            ("rms (m)", "rms_distance", "{:.3f}"),
            ("largest (m)", "largest_distance", "{:.3f}"),
            ("depth (m)", "rms_depth_error", "{:.3f}"),
            ("psi_e (°)", "rms_heading_error", "{:.2f}"),
            ("rudder (°/m)", "rudder_travel_per_metre", "{:.2f}"),
            ("planes (°/m)", "sternplane_travel_per_metre", "{:.2f}"),
        ]
    heads = (head, *(title for title, _, _ in columns))
    rows = [
        (f"{k.number}  {k.kind}", *(fact(getattr(k, name), form) or "–" for _, name, form in columns))
        for k in subpaths
    ]
    size = 10 if edges is _TABLE_COLUMNS else 9
    look: dict[str, Any] = {"va": "top", "fontsize": size, "transform": axes.transAxes}
    for column, head in enumerate(heads):
        look["ha"] = "left" if column == 0 else "right"
        axes.text(edges[column], 1.0, head, color=MUTED, **look)
        for row, cells in enumerate(rows, start=1):
            axes.text(edges[column], 1.0 - row / (_TABLE_ROWS + 1), cells[column], color=INK, **look)
