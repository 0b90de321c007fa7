"""A flown program in one picture: track, heading and yaw rate, fins and thrust, and of a diver its depth."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

from auv_sim.own_vehicle.manoeuvres.manoeuvre_run import ManoeuvreRow

mpl.use("Agg")

from matplotlib.figure import Figure

_COLOURS = ("#1f77b4", "#d62728", "#2ca02c")


def draw(rows: Sequence[ManoeuvreRow], title: str, thrust_unit: str, dives: bool, file: Path) -> None:
    """Draw the rows of a program into a PNG file.

    Args:
        rows: at least one.
        title: of the picture.
        thrust_unit: symbol.
        dives: whether the vehicle has stern planes.
        file: to write.
    """
    t, leg = np.array([row.t for row in rows]), np.array([row.leg for row in rows])
    n = np.array([row.navigation for row in rows])
    fins = np.array([row.command for row in rows])
    panels = 4 if dives else 3
    figure = Figure(figsize=(12.0, 2.1 * panels + 0.6), layout="constrained")
    grid = figure.add_gridspec(panels, 2, width_ratios=(1.0, 1.6))
    track = figure.add_subplot(grid[:, 0])
    track.plot(n[:, 1], n[:, 0], color=_COLOURS[0], linewidth=1.2)
    track.plot(n[0, 1], n[0, 0], "o", color="black", markersize=5)
    track.annotate("start", (n[0, 1], n[0, 0]), textcoords="offset points", xytext=(6, -12), fontsize=8)
    track.set(xlabel="east, m", ylabel="north, m", aspect="equal")
    axes = [figure.add_subplot(grid[k, 1]) for k in range(panels)]
    _series(axes[0], t, [(np.degrees(np.unwrap(n[:, 5])), "heading, deg")])
    _series(axes[1], t, [(np.degrees(n[:, 7]), "yaw rate, deg/s")])
    angles = [(np.degrees(fins[:, 0]), "rudder, deg")]
    if dives:
        angles.append((np.degrees(fins[:, 1]), "stern planes, deg"))
        _series(axes[3], t, [(n[:, 2], "depth, m")])
        axes[3].invert_yaxis()
        _beside(axes[3], t, np.degrees(n[:, 4]), "pitch, deg")
    _series(axes[2], t, angles)
    largest = 1.6 * max(float(fins[:, 2].max()), 1e-9)
    _beside(axes[2], t, fins[:, 2], f"thrust, {thrust_unit}", (0.0, largest))
    for axis in axes:
        for begin in t[np.flatnonzero(np.diff(leg)) + 1]:
            axis.axvline(begin, color="0.85", linewidth=0.8, zorder=0)
        axis.set_xlim(t[0], t[-1])
    axes[-1].set_xlabel("time, s")
    figure.suptitle(title, fontsize=11)
    figure.savefig(file, dpi=110)


def _beside(axis: Any, t: Any, values: Any, label: str, limits: tuple[float, float] | None = None) -> None:
    """Draw a dashed line on a second axis at the right."""
    other = axis.twinx()
    other.plot(t, values, color="0.45", linewidth=0.9, linestyle="--")
    other.set_ylabel(f"{label} (dashed)", fontsize=8, color="0.35")
    other.tick_params(labelsize=8, colors="0.35")
    if limits is not None:
        other.set_ylim(*limits)


def _series(axis: Any, t: Any, series: list[tuple[Any, str]]) -> None:
    for (values, label), colour in zip(series, _COLOURS, strict=False):
        axis.plot(t, values, color=colour, linewidth=1.0, label=label)
    axis.legend(loc="lower right", bbox_to_anchor=(1.0, 0.97), ncols=2, frameon=False, fontsize=8)
    axis.grid(alpha=0.3)
