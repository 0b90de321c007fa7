"""The overview of a flown mission: the track over the path, and signals over time."""

from __future__ import annotations

import math
from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_sim.flight.figures.mission_summary import MissionSummary, SpatialMissionSummary
from auv_sim.flight.flown_share import percent
from auv_sim.flight.metrics import under_way
from auv_sim.flight.run_record import Run
from auv_sim.views.plot_style import INK, MUTED, fact, save
from auv_sim.views.signal_rows import NO_LIMITS, FinLimits, draw_rows, rows_of
from auv_sim.views.track_panel import table, track

_SIZE_INCHES = (16.0, 10.0)
_DOTS_PER_INCH = 100
#: Longest line of facts in letters of 12 points that fits the width.
_HEADLINE = 180


def draw(
    run: Run,
    path: CompositePath,
    summary: MissionSummary,
    png: Path,
    title: str,
    *,
    limits: FinLimits = NO_LIMITS,
    spatial: SpatialPath | None = None,
    command: str = "",
) -> None:
    """Draw the overview, 1600 x 1000 pixels.

    Args:
        run: the flown mission.
        path: the path of that mission, NED.
        summary: its figures, for the headline.
        png: the file to write.
        title: mission and vehicle.
        limits: of the fins, drawn where given.
        spatial: the path in three dimensions, for a run of a vehicle that dives.
        command: the command that flies this mission again, printed below the picture.
    """
    figure = Figure(figsize=_SIZE_INCHES, dpi=_DOTS_PER_INCH, facecolor="white")
    FigureCanvasAgg(figure)
    margins = {"left": 0.05, "right": 0.985, "top": 0.875, "bottom": 0.06}
    grid = figure.add_gridspec(rows_of(run), 2, width_ratios=(1.0, 1.12), wspace=0.12, hspace=0.22, **margins)
    flown = under_way(run, path.n)
    _headline(figure, summary, title)
    left = grid[:, 0].subgridspec(2, 1, height_ratios=(2.5, 1.0), hspace=0.18)
    track(figure.add_subplot(left[0]), flown, path, summary.missed)
    table(figure.add_subplot(left[1]), summary)
    _signals(figure, grid, flown, path, spatial, limits)
    figure.text(
        0.05, 0.018, command, fontsize=10, family="monospace", color=MUTED, va="center", parse_math=False
    )
    save(figure, png, dpi=_DOTS_PER_INCH)


def _signals(
    figure: Figure,
    grid: GridSpec,
    flown: Run,
    path: CompositePath,
    spatial: SpatialPath | None,
    limits: FinLimits,
) -> None:
    """Draw the panels of the right half."""
    rows = [figure.add_subplot(grid[0, 1])]
    rows += [figure.add_subplot(grid[k, 1], sharex=rows[0]) for k in range(1, rows_of(flown))]
    draw_rows(rows, flown, path, spatial, limits)
    for axes in rows[:-1]:
        axes.tick_params(labelbottom=False)
    rows[-1].set_xlabel("time since the start (s)", color=INK)
    figure.align_ylabels(rows)


def _headline(figure: Figure, summary: MissionSummary, title: str) -> None:
    facts = [
        "end of the path reached" if summary.completed else "end of the path not reached",
        "" if math.isnan(summary.flown_share) else f"{percent(summary.flown_share)} of the path flown",
        fact(summary.duration, "{:.1f} s"),
        fact(summary.distance_covered, "{:.1f} m"),
        fact(summary.rms_distance, "rms distance {:.3f} m"),
        fact(summary.largest_distance, "largest {:.2f} m"),
        *_depth_facts(summary),
        fact(summary.navigation_error, "odometry off by {:.2f} m at most"),
        fact(summary.current_estimate_error, "current estimate within {:.4f} m/s"),
    ]
    figure.text(0.05, 0.957, title, fontsize=18, fontweight="bold", color=INK, va="center", parse_math=False)
    line = "   ·   ".join(text for text in facts if text)
    size = min(12.0, 12.0 * _HEADLINE / len(line))  # the longest lines, of flights at sea, in smaller letters
    figure.text(0.05, 0.921, line, fontsize=size, color=MUTED, va="center")


def _depth_facts(summary: MissionSummary) -> tuple[str, ...]:
    if not isinstance(summary, SpatialMissionSummary):
        return ()
    return (
        fact(summary.rms_depth_error, "depth rms {:.3f} m"),
        fact(summary.largest_depth_error, "largest {:.2f} m"),
    )
