"""One picture of a planned mission: the path on north-east axes, below it curvature, depth and slope."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_msgs_py.values.types import NO_CURRENT, Current
from auv_path_following.curves.outline import look, polygon
from auv_path_following.mission_check.flyable import Findings
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.mission_check.depth_panels import draw_depths
from auv_sim.views.labels import arrow
from auv_sim.views.plot_style import AREA, BLUE, GREEN, HALO, INK, MUTED, ORANGE, PATH, RED, save, style

CONTINUITY = {"G0": RED, "G1": ORANGE, "G2": GREEN}
_MEANING = {"G0": "corner", "G1": "curvature jumps", "G2": "smooth"}
#: More joints or waypoints than this are drawn small and without numbers.
_FEW = 60
_ERROR = 0.05
#: Distance of a text from its line, as a share of the largest curvature.
_TEXT_GAP = 0.03


def draw(
    mission: Mission, findings: Findings, vehicle: Vehicle, png: Path, current: Current = NO_CURRENT
) -> None:
    """Draw the plan, 1200 x 1300 pixels; with depths 1200 x 1600.

    Args:
        mission: what is planned.
        findings: of its check.
        vehicle: whose bounds are drawn.
        png: the file to write.
        current: that it was checked in, drawn as an arrow.
    """
    is_spatial = mission.spatial is not None
    figure = Figure(figsize=(12.0, 16.0 if is_spatial else 13.0), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    margins = {"left": 0.08, "right": 0.97, "top": 0.91 if is_spatial else 0.885, "bottom": 0.06}
    heights = (2.7, 0.8, 1.0, 0.8) if is_spatial else (2.7, 1.0)
    grid = figure.add_gridspec(len(heights), 1, height_ratios=heights, hspace=0.16, **margins)
    _headline(figure, mission, findings, vehicle.name)
    _map(figure.add_subplot(grid[0]), mission, current)
    below = figure.add_subplot(grid[1])
    _curvature(below, mission, findings, vehicle.name)
    if is_spatial:
        depth, slope = (figure.add_subplot(grid[k], sharex=below) for k in (2, 3))
        draw_depths(depth, slope, mission, findings, vehicle)
        for axes in (below, depth):
            axes.set_xlabel("")
            axes.tick_params(labelbottom=False)
        slope.set_xlabel("horizontal length along the path (m)", color=INK)
    save(figure, png)


def _headline(figure: Figure, mission: Mission, findings: Findings, vehicle_name: str) -> None:
    path = mission.path
    state, color = ("flyable", GREEN) if not findings.refusals else ("refused", RED)
    if not findings.refusals and findings.warnings:
        count = len(findings.warnings)
        state, color = f"flyable, {count} warning{'s' if count > 1 else ''}", ORANGE
    figure.text(
        0.08, 0.965, mission.name, fontsize=18, fontweight="bold", color=INK, va="center", parse_math=False
    )
    figure.text(0.97, 0.965, state, fontsize=14, fontweight="bold", color=color, va="center", ha="right")
    times = mission.path.n // max(mission.once, 1)
    length = path.length if mission.spatial is None else mission.spatial.length
    facts = [f"{path.n} subpaths", f"{length:.1f} m", f"{findings.speed:.2f} m/s through the water"]
    if times > 1:
        facts.insert(0, f"{times} times round")
    if np.isfinite(findings.duration):
        facts.append(f"{findings.duration:.0f} s")
    line = "   ·   ".join([*facts, vehicle_name])
    figure.text(0.08, 0.935, line, fontsize=12, color=MUTED, va="center", parse_math=False)


def _map(axes: Axes, mission: Mission, current: Current) -> None:
    style(axes, "north x (m)")
    axes.set_xlabel("east y (m)", color=INK)
    once = mission.path.segments[: mission.once]
    outlines = [polygon(segment, _ERROR) for segment in once]
    x, y = (np.concatenate(axis) for axis in zip(*outlines, strict=True))
    few = len(once) <= _FEW
    _areas(axes, mission)
    _waypoints(axes, mission, few)
    axes.plot(y, x, color=BLUE, linewidth=2.4 if few else 1.0, label="path", zorder=3)
    _joints(axes, mission, few)
    _ends(axes, mission)
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.06)
    arrow(axes, "current", current.Vx, current.Vy, mission.path)
    axes.legend(
        loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=7, fontsize=9, frameon=False, borderpad=0.1
    )


def _waypoints(axes: Axes, mission: Mission, few: bool) -> None:
    if not mission.waypoints:
        return
    north, east = zip(*mission.waypoints, strict=True)
    axes.plot(
        east, north, "--x" if few else "--", color=MUTED, linewidth=0.9, markersize=7, label="waypoints",
        zorder=2,
    )  # fmt: skip
    if len(mission.waypoints) <= _FEW // 2:
        for number, (n, e) in enumerate(mission.waypoints, start=1):
            axes.annotate(
                str(number), (e, n), xytext=(7, 7), textcoords="offset points", color=MUTED, fontsize=10,
                path_effects=HALO, zorder=7,
            )  # fmt: skip


def _joints(axes: Axes, mission: Mission, few: bool) -> None:
    joints = mission.path.joints[: max(mission.once - 1, 0)]
    for name, color in CONTINUITY.items():
        these = [joint for joint in joints if joint.geometric == name]
        if these:
            axes.plot(
                [j.y for j in these], [j.x for j in these], "o", color=color, markersize=7 if few else 2.5,
                markeredgecolor="white", markeredgewidth=0.8 if few else 0.0, linestyle="none", zorder=4,
                label=f"joint {name}: {_MEANING[name]}",
            )  # fmt: skip


def _areas(axes: Axes, mission: Mission) -> None:
    """Draw the surveyed polygon filled and the geofence as a dashed outline."""
    if mission.area:
        north, east = zip(*mission.area, strict=True)
        axes.fill(
            east, north, facecolor=AREA, edgecolor=PATH, linewidth=1.0, label="surveyed area", zorder=0.5
        )
    if mission.geofence:
        north, east = zip(*mission.geofence, mission.geofence[0], strict=True)
        axes.plot(east, north, color=RED, linewidth=1.2, linestyle=(0, (6, 3)), label="geofence", zorder=1)


def _ends(axes: Axes, mission: Mission) -> None:
    start, end = mission.path.evaluate(0, 0.0), mission.path.evaluate(mission.path.n - 1, 1.0)
    axes.annotate(
        "", (start.y, start.x), xytext=(26 * np.sin(start.chi), 26 * np.cos(start.chi)),
        textcoords="offset points", zorder=6,
        arrowprops={"arrowstyle": "<-", "color": INK, "linewidth": 2.0},
    )  # fmt: skip
    axes.annotate(
        "start", (start.y, start.x), xytext=(-14 * np.sin(start.chi), -14 * np.cos(start.chi)),
        textcoords="offset points", color=INK, fontsize=10, ha="center", va="center", path_effects=HALO,
    )  # fmt: skip
    axes.plot(end.y, end.x, "s", color=INK, markersize=7, markeredgecolor="white", zorder=5, label="end")


def _curvature(axes: Axes, mission: Mission, findings: Findings, vehicle_name: str) -> None:
    style(axes, "curvature (1/m)")
    axes.set_xlabel("distance along the path (m)", color=INK)
    distance, kappa, done = [], [], 0.0
    for segment in mission.path.segments[: mission.once]:
        t, point = look(segment)
        speed = np.asarray(point.speed)
        steps = np.concatenate(([0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(t))))
        # The sum is close; the segment's own length keeps the error from adding up.
        distance.append(done + steps * (segment.length / steps[-1]))
        kappa.append(np.asarray(point.kappa))
        done += segment.length
    axes.plot(np.concatenate(distance), np.concatenate(kappa), color=BLUE, linewidth=1.4)
    limit = 1.0 / findings.turn.radius
    for sign in (1.0, -1.0):
        axes.axhline(sign * limit, color=RED, linewidth=1.4, linestyle="--")
    turn = f"radius {findings.turn.radius:.2f} m, {findings.turn.source}"
    look_of: dict[str, Any] = {"transform": axes.get_yaxis_transform(), "parse_math": False}
    text = f"tightest turn of {vehicle_name}: {turn}"
    largest = max(limit, float(np.abs(np.concatenate(kappa)).max()))
    gap = _TEXT_GAP * largest
    axes.text(0.995, limit + gap, text, color=RED, fontsize=10, ha="right", va="bottom", **look_of)
    axes.text(0.005, gap - limit, "to port", color=MUTED, fontsize=9, va="bottom", **look_of)
    axes.text(0.005, limit - gap, "to starboard", color=MUTED, fontsize=9, va="top", **look_of)
    axes.set_ylim(-1.25 * largest, 1.25 * largest)
    axes.set_xlim(0.0, done)
