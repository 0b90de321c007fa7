"""The right half of the overview: signals over time."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.run_record import Column, Run, SpatialRun
from auv_sim.views.labels import Labels
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, PATH, RED, style

#: Most switches that are drawn; more would cover the panels.
_MOST_SWITCHES = 200
#: A bottom farther below than this multiple of the greatest depth is cut off.
_BOTTOM_SHOWN = 2.0


def distance(axes: Axes, time: Column, flown: SpatialRun, path: SpatialPath) -> None:
    """Draw the distance to a path in three dimensions, and guidance's errors, Eq. (3D-12)."""
    style(axes, "distance (m)")
    x, y = flown.track
    away = path.distance(x, y, flown.depth, flown.subpath(path.n))
    label = "true distance to the path" if np.isfinite(flown.x_true).any() else "distance to the path"
    axes.fill_between(time, away, color=PATH, alpha=0.6, linewidth=0.0, label=label)
    _line(axes, time, flown.ye, BLUE, "ye (starboard positive)")
    _line(axes, time, flown.ze, ORANGE, "ze (below positive)")
    _spread(axes, 0.1)
    _legend(axes)


def depth(axes: Axes, time: Column, flown: SpatialRun, path: SpatialPath | None) -> None:
    """Draw depth, requested depth, the path's depth, surface and bottom; depth increases downwards."""
    style(axes, "depth (m)")
    columns = [flown.depth, flown.depth_d]
    if path is not None:
        columns.append(path.closest(*flown.track, flown.depth, flown.subpath(path.n))[1])
        _line(axes, time, columns[-1], PATH, "path", width=5.0)
    _line(axes, time, flown.depth_d, ORANGE, "requested")
    _line(axes, time, flown.depth, BLUE, "true depth" if np.isfinite(flown.z_true).any() else "depth")
    known = np.concatenate(columns)
    known = known[np.isfinite(known)]
    deepest = max(1.0, float(known.max())) if known.size else 1.0
    highest = min(0.0, float(known.min())) if known.size else 0.0
    bottom = flown.bottom
    _line(axes, time, bottom, INK, "bottom", width=2.0)
    if np.isfinite(bottom).any():
        deepest = max(deepest, min(float(np.nanmax(bottom)), _BOTTOM_SHOWN * deepest))
    axes.axhline(0.0, color=GREEN, linewidth=1.0, linestyle=(0, (4, 3)), label="surface")
    margin = 0.1 * (deepest - highest)
    axes.set_ylim(deepest + margin, highest - margin)
    _legend(axes)


def angle_errors(axes: Axes, time: Column, flown: SpatialRun) -> None:
    """Draw wrap(psi - psi_d) and theta - theta_d."""
    style(axes, "error (°)")
    _line(axes, time, np.degrees(flown.psi_e), BLUE, "heading psi − psi_d")
    _line(axes, time, np.degrees(flown.theta_e), ORANGE, "pitch theta − theta_d")
    _spread(axes, 1.0)
    _legend(axes)


def sternplanes(axes: Axes, time: Column, flown: SpatialRun, limit: float | None) -> None:
    """Draw the angle of the stern planes; limit in rad."""
    style(axes, "stern planes (°)")
    _line(axes, time, np.degrees(flown.sternplanes_cmd), ORANGE, "commanded")
    _line(axes, time, np.degrees(flown.sternplanes), BLUE, "measured (bow down positive)")
    _limits(axes, limit)
    _spread(axes, 1.0)
    _legend(axes)


def cross_track(axes: Axes, time: Column, flown: Run, path: CompositePath) -> None:
    """Draw the distance to the path, and guidance's cross-track error, Eq. (20)."""
    style(axes, "distance (m)")
    distance = path.distance(*flown.track, flown.subpath(path.n))
    label = "true distance to the path" if np.isfinite(flown.x_true).any() else "distance to the path"
    axes.fill_between(time, distance, color=PATH, alpha=0.6, linewidth=0.0, label=label)
    _line(axes, time, flown.ye, BLUE, "cross-track error ye (starboard positive)")
    _spread(axes, 0.1)
    _legend(axes)


def heading_error(axes: Axes, time: Column, flown: Run) -> None:
    """Draw wrap(psi - psi_d)."""
    style(axes, "heading error (°)")
    _line(axes, time, np.degrees(flown.psi_e), BLUE, "psi − psi_d")
    _spread(axes, 1.0)
    _legend(axes)


def rudder(axes: Axes, time: Column, flown: Run, limit: float | None) -> None:
    """Draw the rudder angle; limit in rad."""
    style(axes, "rudder (°)")
    _line(axes, time, np.degrees(flown.rudder_cmd), ORANGE, "commanded")
    _line(axes, time, np.degrees(flown.rudder), BLUE, "measured (port positive)")
    _limits(axes, limit)
    _spread(axes, 1.0)
    _legend(axes)


def rudder_rate(axes: Axes, time: Column, flown: Run, limit: float | None) -> None:
    """Draw the rate between rows of the measured rudder, or of the command; limit in rad/s."""
    style(axes, "rudder rate (°/s)")
    rudder = flown.rudder if np.isfinite(flown.rudder).any() else flown.rudder_cmd
    if time.size > 1:
        rate = np.diff(rudder) / np.diff(time)
        _line(axes, time[1:], np.degrees(rate), BLUE, "")
    _limits(axes, limit)
    _spread(axes, 1.0)
    _legend(axes)


def current(axes: Axes, time: Column, flown: Run) -> None:
    """Draw the current estimate, Eq. (35), against the truth where a simulator recorded it."""
    style(axes, "current (m/s)")
    _line(axes, time, flown.Vx_true, PATH, "true", width=5.0)
    _line(axes, time, flown.Vy_true, PATH, "", width=5.0)
    _line(axes, time, flown.Vx_est, BLUE, "estimate, north Vx")
    _line(axes, time, flown.Vy_est, ORANGE, "estimate, east Vy")
    if isinstance(flown, SpatialRun):
        _line(axes, time, flown.Vz_true, PATH, "", width=5.0)
        _line(axes, time, flown.Vz_est, GREEN, "estimate, down Vz")
    _spread(axes, 0.05)
    _legend(axes)


def switches(rows: list[Axes], time: Column, flown: Run, path: CompositePath | SpatialPath) -> None:
    """Draw light lines where a subpath begins, and the subpaths' numbers in the top panel."""
    subpath = flown.subpath(path.n)
    starts = [0.0, *time[1:][np.diff(subpath) > 0]]
    numbers = [int(subpath[0]), *subpath[1:][np.diff(subpath) > 0]]
    for axes in rows:
        if len(starts) <= _MOST_SWITCHES:
            axes.vlines(
                starts[1:], 0.0, 1.0, transform=axes.get_xaxis_transform(), colors=MUTED, linewidth=0.7,
                alpha=0.5, zorder=0,
            )  # fmt: skip
        axes.set_xlim(0.0, float(time[-1]) or 1.0)
    labels = Labels(rows[0])
    top = rows[0].get_ylim()[1]
    spans = zip(starts, [*starts[1:], float(time[-1])], numbers, strict=True)
    for start, end, number in sorted(spans, key=lambda span: span[0] - span[1])[:_MOST_SWITCHES]:
        at = (0.5 * (start + end), top)
        labels.write(str(number + 1), at, (0.0, -8.0), 10, color=MUTED, fontweight="bold")


def _limits(axes: Axes, limit: float | None) -> None:
    if limit is not None:
        for degrees, label in ((math.degrees(limit), "limit"), (-math.degrees(limit), "")):
            axes.axhline(degrees, color=RED, linewidth=1.0, linestyle=(0, (4, 3)), label=label)


def _line(axes: Axes, time: Column, values: Column, color: str, label: str, width: float = 1.2) -> None:
    if np.isfinite(values).any():
        axes.plot(time, values, color=color, linewidth=width, label=label)


def _legend(axes: Axes) -> None:
    handles, _ = axes.get_legend_handles_labels()
    if handles:
        axes.legend(
            loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=5, fontsize=9, frameon=False, borderpad=0.0
        )


def _spread(axes: Axes, least: float) -> None:
    """Leave room above for the legend, and limit the magnification of noise."""
    low, high = axes.get_ylim()
    lacking = max(0.0, least - (high - low)) / 2.0
    axes.set_ylim(low - lacking, high + lacking + 0.08 * (high - low))
