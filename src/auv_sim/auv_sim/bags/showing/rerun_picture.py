"""The picture of recorded and new commands."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from auv_sim.bags.content.rerun_pilot import Answers
from auv_sim.views.plot_style import BLUE, INK, ORANGE, PATH, save, style


def draw(found: Answers, png: Path) -> None:
    """Draw rudder, its difference and thrust over time, 1400 x 900 pixels."""
    figure = Figure(figsize=(14.0, 9.0), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    rows = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": (2.0, 1.2, 1.0)})
    time = found.t - found.t[0]
    recorded, new = (np.degrees(side["rudder_cmd"]) for side in (found.recorded, found.new))
    style(rows[0], "rudder command (°)")
    rows[0].plot(time, recorded, color=PATH, linewidth=4.0, label="recorded")
    rows[0].plot(time, new, color=BLUE, linewidth=1.3, label="new")
    style(rows[1], "new − recorded (°)")
    rows[1].plot(time, new - recorded, color=ORANGE, linewidth=1.2)
    style(rows[2], "thrust command (N)")
    rows[2].plot(time, found.recorded["thrust_cmd"], color=PATH, linewidth=4.0, label="recorded")
    rows[2].plot(time, found.new["thrust_cmd"], color=BLUE, linewidth=1.3, label="new")
    for axes in (rows[0], rows[2]):
        axes.legend(loc="upper right", ncols=2, frameon=False)
    rows[2].set_xlabel("time since the first odometry (s)", color=INK)
    figure.suptitle(
        "The same situations, commanded again", x=0.06, ha="left", fontsize=15, color=INK, fontweight="bold"
    )
    figure.align_ylabels(rows)
    figure.subplots_adjust(left=0.06, right=0.985, top=0.93, bottom=0.06, hspace=0.1)
    save(figure, png, dpi=100)
