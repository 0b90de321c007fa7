"""The panels of a plan in three dimensions: depth and slope over the horizontal length of the path."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from auv_path_following.mission_check.depth_survey import DepthSurvey, survey_of
from auv_path_following.mission_check.depths import DepthBounds, bounds_of
from auv_path_following.mission_check.flyable import Findings
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle
from auv_sim.views.plot_style import AREA, BLUE, HALO, MUTED, RED, style

#: More knots than this are not marked.
_FEW = 60


def draw_depths(depth: Axes, slope: Axes, mission: Mission, findings: Findings, vehicle: Vehicle) -> None:
    """Draw one lap: depth with surface and deepest place allowed, slope with its bound, refused places.

    Args:
        depth, slope: the panels, above one another.
        mission: with a path in three dimensions.
        findings: of its check.
        vehicle: whose bounds are drawn, if it dives.
    """
    if mission.spatial is None:
        return
    survey = survey_of(mission.spatial, mission.once)
    bounds = bounds_of(mission, vehicle, findings.speed) if vehicle.dives else None
    _depth(depth, survey, bounds)
    _slope(slope, survey, bounds)
    for way in {finding.way for finding in findings.refusals if math.isfinite(finding.way)}:
        for axes in (depth, slope):
            axes.axvline(way, color=RED, linewidth=8.0, alpha=0.18, zorder=1)
    knots = [knot for knot in mission.spatial.knots if knot.way <= survey.way[-1] + 1e-6]
    if len(knots) <= 60:
        depth.plot(
            *zip(*knots, strict=True), "o", color=BLUE, markersize=5, markeredgecolor="white", zorder=4
        )


def _depth(axes: Axes, survey: DepthSurvey, bounds: DepthBounds | None) -> None:
    style(axes, "depth (m)")
    axes.plot(survey.way, survey.z, color=BLUE, linewidth=1.8, zorder=3)
    axes.fill_between(survey.way, survey.z, 0.0, color=AREA, alpha=0.5, linewidth=0.0, zorder=0.5)
    axes.axhline(0.0, color=MUTED, linewidth=1.2)
    deepest = float(survey.z.max())
    bottom = 1.15 * max(deepest, 1.0)
    axes.set_ylim(bottom, -0.08 * bottom)
    place: dict[str, Any] = {"transform": axes.get_yaxis_transform(), "fontsize": 9, "path_effects": HALO}
    axes.text(0.995, 0.0, "surface", color=MUTED, ha="right", va="bottom", **place)
    if bounds is None:
        return
    if bounds.surface > 0.0:
        axes.axhline(bounds.surface, color=MUTED, linewidth=1.0, linestyle=":")
    if bounds.deepest <= 1.5 * deepest:
        axes.set_ylim(1.15 * max(deepest, bounds.deepest), -0.08 * bottom)
        axes.axhline(bounds.deepest, color=RED, linewidth=1.4, linestyle="--")
        text = f"largest depth {bounds.deepest:g} m"
        axes.text(0.995, bounds.deepest, text, color=RED, ha="right", va="top", **place)


def _slope(axes: Axes, survey: DepthSurvey, bounds: DepthBounds | None) -> None:
    style(axes, "slope (deg)")
    degrees = np.degrees(survey.gamma)
    axes.plot(survey.way, degrees, color=BLUE, linewidth=1.4, zorder=3)
    largest = float(np.abs(degrees).max())
    place: dict[str, Any] = {"transform": axes.get_yaxis_transform(), "fontsize": 9, "path_effects": HALO}
    if bounds is not None:
        limit = math.degrees(bounds.slope)
        largest = max(largest, abs(limit))
        for sign in (1.0, -1.0):
            axes.axhline(sign * limit, color=RED, linewidth=1.4, linestyle="--")
        text = f"steepest slope {limit:.1f} deg (largest pitch {math.degrees(bounds.steepest):.1f} deg)"
        axes.text(0.995, 1.04 * limit, text, color=RED, ha="right", va="bottom", **place)
    axes.axhline(0.0, color=MUTED, linewidth=0.8)
    axes.set_ylim(-1.4 * max(largest, 1.0), 1.4 * max(largest, 1.0))
    axes.text(0.005, 0.96, "up", color=MUTED, va="top", fontsize=9, transform=axes.transAxes)
    axes.text(0.005, 0.04, "down", color=MUTED, va="bottom", fontsize=9, transform=axes.transAxes)
