"""The left half of the overview: the track over the path as the paper draws it, and its figures."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.segment import PathPoint
from auv_sim.analysis.metrics import MissionSummary
from auv_sim.analysis.plot_style import BLUE, GREEN, HALO, INK, MUTED, ORANGE, PATH, RED, fact, style
from auv_sim.analysis.run import Run

_TABLE_ROWS = 9
#: Where the table's columns stand: the left edge of the first, the right edges of the others.
_TABLE_COLUMNS = (0.0, 0.33, 0.49, 0.64, 0.83, 1.0)


def track(axes: Axes, flown: Run, path: CompositePath) -> None:
    """North up, east right, equal scales; subpaths and joints numbered, the current as an arrow."""
    style(axes, "north x (m)")
    axes.set_xlabel("east y (m)", color=INK)
    path_x, path_y, _ = path.polyline(1.0)
    axes.plot(path_y, path_x, color=PATH, linewidth=6.0, solid_capstyle="round", label="path")
    x, y = flown.track
    if np.isfinite(flown.x_true).any():
        axes.plot(flown.y, flown.x, color=ORANGE, linewidth=0.8, label="odometry")
    axes.plot(y, x, color=BLUE, linewidth=1.6, label="track")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.07)
    for k, segment in enumerate(path.segments):
        _beside(axes, segment.evaluate(0.35), -14.0, str(k + 1), color=MUTED, fontsize=12, fontweight="bold")
    for joint in path.joints:
        axes.plot(joint.y, joint.x, "o", color="white", markeredgecolor=INK, markersize=6, zorder=4)
        label = f"{joint.index}–{joint.index + 1} {joint.geometric}"
        color = RED if joint.geometric == "G0" else MUTED
        _beside(axes, path.evaluate(joint.index, 0.0), 18.0, label, color=color, fontsize=8)
    if flown.steps:
        for row, marker, size, color, label in ((0, "^", 12, GREEN, "start"), (-1, "s", 9, RED, "end")):
            axes.plot(
                y[row], x[row], marker, color=color, markersize=size, markeredgecolor="white",
                zorder=5, linestyle="none", label=label,
            )  # fmt: skip
        _current_arrow(axes, flown)
    axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=5, fontsize=10, frameon=False, borderpad=0.2
    )


def _beside(axes: Axes, p: PathPoint, points: float, text: str, **look: Any) -> None:
    """Write beside a point of the path, `points` to starboard (to port when negative)."""
    offset = points * math.cos(p.chi), -points * math.sin(p.chi)
    axes.annotate(
        text, (p.y, p.x), xytext=offset, textcoords="offset points", ha="center", va="center",
        path_effects=HALO, **look,
    )  # fmt: skip


def _current_arrow(axes: Axes, flown: Run) -> None:
    """A mean current as an arrow of fixed length: its direction is drawn, its strength is written."""
    for name, Vx, Vy in (
        ("current", flown.Vx_true, flown.Vy_true),
        ("estimated current", flown.Vx_est, flown.Vy_est),
    ):
        if np.isfinite(Vx).any():
            north, east = float(np.nanmean(Vx)), float(np.nanmean(Vy))
            strength = float(np.hypot(north, east))
            if strength < 1e-3:
                return
            # In inches, and along the screen: axes of unequal sides must not bend its direction.
            axes.quiver(
                0.08, 0.1, east / strength, north / strength, transform=axes.transAxes, angles="uv",
                pivot="middle", scale_units="inches", scale=1.6, units="inches", width=0.035, color=GREEN,
            )  # fmt: skip
            axes.text(
                0.14, 0.1, f"{name}\n{strength:.2f} m/s", transform=axes.transAxes, color=GREEN, fontsize=10,
                va="center",
            )  # fmt: skip
            return


def table(axes: Axes, summary: MissionSummary) -> None:
    """The figures of each subpath; left empty when there are too many to be legible."""
    axes.set_axis_off()
    if len(summary.subpaths) > _TABLE_ROWS:
        return
    heads = ("subpath", "time (s)", "rms dist. (m)", "largest (m)", "rms heading (°)", "rudder (°/m)")
    rows = [
        (
            f"{k.number}  {k.kind}",
            k.duration,
            k.rms_distance,
            k.largest_distance,
            k.rms_heading_error,
            k.rudder_travel_per_metre,
        )
        for k in summary.subpaths
    ]
    forms = ("{:.1f}", "{:.3f}", "{:.3f}", "{:.2f}", "{:.2f}")
    look: dict[str, Any] = {"va": "top", "fontsize": 10, "transform": axes.transAxes}
    for column, head in enumerate(heads):
        look["ha"] = "left" if column == 0 else "right"
        axes.text(_TABLE_COLUMNS[column], 1.0, head, color=MUTED, **look)
        for row, cells in enumerate(rows, start=1):
            cell = cells[column]
            text = cell if isinstance(cell, str) else (fact(cell, forms[column - 1]) or "–")
            axes.text(_TABLE_COLUMNS[column], 1.0 - row / (_TABLE_ROWS + 1), text, color=INK, **look)
