"""The picture of recorded and new commands."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from numpy.typing import NDArray

from auv_sim.bags.content.rerun_pilot import Answers
from auv_sim.views.plot_style import BLUE, INK, ORANGE, PATH, save, style

_FINS = (("rudder_cmd", "rudder"), ("sternplane_cmd", "stern planes"))


def draw(found: Answers, png: Path) -> None:
    """Draw the fins, their differences and thrust over time, 1400 pixels wide."""
    fins = [(name, label) for name, label in _FINS if name in found.new]
    figure = Figure(figsize=(14.0, 2.6 + 6.4 * len(fins)), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    ratios = (*(2.0, 1.2) * len(fins), 1.0)
    rows = figure.subplots(len(ratios), 1, sharex=True, gridspec_kw={"height_ratios": ratios})
    time = found.t - found.t[0]
    for k, (name, label) in enumerate(fins):
        recorded, new = (np.degrees(side[name]) for side in (found.recorded, found.new))
        _both(rows[2 * k], time, recorded, new, f"{label} command (°)")
        style(rows[2 * k + 1], "new − recorded (°)")
        rows[2 * k + 1].plot(time, new - recorded, color=ORANGE, linewidth=1.2)
    _both(rows[-1], time, found.recorded["thrust_cmd"], found.new["thrust_cmd"], "thrust command (N)")
    for axes in (*rows[: 2 * len(fins) : 2], rows[-1]):
        axes.legend(loc="upper right", ncols=2, frameon=False)
    rows[-1].set_xlabel("time since the first odometry (s)", color=INK)
    figure.suptitle(
        "The same situations, commanded again", x=0.06, ha="left", fontsize=15, color=INK, fontweight="bold"
    )
    figure.align_ylabels(rows)
    figure.subplots_adjust(left=0.06, right=0.985, top=0.93, bottom=0.06, hspace=0.1)
    save(figure, png, dpi=100)


def _both(axes: Axes, time: NDArray[np.float64], recorded: Any, new: Any, label: str) -> None:
    style(axes, label)
    axes.plot(time, recorded, color=PATH, linewidth=4.0, label="recorded")
    axes.plot(time, new, color=BLUE, linewidth=1.3, label="new")
