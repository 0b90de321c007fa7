"""The identification as one picture: intervals, innovations, whiteness, left-out manoeuvres."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from auv_sim.own_vehicle.identify.combinations import COUNT, SYMBOLS
from auv_sim.own_vehicle.identify.hull_abilities import Ability
from auv_sim.own_vehicle.identify.identification import Identified
from auv_sim.own_vehicle.identify.innovations import Channels, filtered, flown
from auv_sim.own_vehicle.identify.intervals import REACH
from auv_sim.own_vehicle.identify.predictions import Prediction, starts_of
from auv_sim.own_vehicle.identify.results.identification_tables import IDENTIFIED, whiteness
from auv_sim.own_vehicle.identify.unknowns import GYRO
from auv_sim.views.plot_style import BLUE, GREEN, INK, MUTED, ORANGE, RED, save, style

_COLOURS = (BLUE, GREEN, ORANGE)
#: Lags of the autocorrelation.
_LAGS = 20


def draw_identification(
    found: Identified,
    abilities: Sequence[Ability],
    left_out: Channels | None,
    predictions: Sequence[Prediction],
    title: str,
    png: Path,
) -> None:
    """Draw and write the picture.

    Args:
        found: the identification.
        abilities: speed, pole and radii.
        left_out: recordings that were left out.
        predictions: of them.
        title: names of vehicle and recordings.
        png: the file.
    """
    figure = Figure(figsize=(14.0, 11.0), layout="constrained")
    figure.suptitle(title, color=INK, fontsize=13, x=0.01, ha="left")
    grid = figure.add_gridspec(4, 3, height_ratios=[1.35, 1.0, 1.0, 1.0])
    _intervals(figure.add_subplot(grid[0, :2]), found)
    _facts(figure.add_subplot(grid[0, 2]), found, abilities, predictions)
    for channel in range(3):
        _innovations(figure.add_subplot(grid[1, channel]), found, channel)
        _autocorrelation(figure.add_subplot(grid[2, channel]), found, channel)
    _left_out(figure.add_subplot(grid[3, :]), found, left_out)
    save(figure, png, dpi=110)


def _intervals(axes: Axes, found: Identified) -> None:
    share = 100.0 * REACH * found.spread.deviations[:COUNT] / np.abs(found.physical[:COUNT])
    unseen = 100.0 * REACH * np.linalg.norm(found.spread.systematic, axis=0)[:COUNT]
    unseen = unseen / np.abs(found.physical[:COUNT])
    strong = share < 100.0 * REACH * IDENTIFIED
    places = np.arange(COUNT)
    kinds = (strong, BLUE, "95 % interval"), (~strong, MUTED, "too wide: not identified")
    for rows, colour, label in kinds:
        axes.bar(places[rows], share[rows], color=colour, width=0.7, label=label)
    axes.bar(places, np.minimum(unseen, share), color=ORANGE, width=0.7, label="of it systematic")
    axes.set_yscale("log")
    axes.set_ylim(0.2, 400.0)
    axes.set_xticks(places, SYMBOLS, rotation=45, ha="right")
    axes.axhline(100.0 * REACH * IDENTIFIED, color=RED, linewidth=0.9, linestyle="--")
    style(axes, "± % of the value")
    axes.legend(frameon=False, fontsize=9, loc="upper left", ncols=3)


def _facts(
    axes: Axes, found: Identified, abilities: Sequence[Ability], predictions: Sequence[Prediction]
) -> None:
    axes.axis("off")
    rows = [(a.name, f"{a.value:.3g} ± {REACH * a.deviation:.2g} {a.unit}") for a in abilities]
    rows += [
        (f"left out, over {p.horizon:g} s", f"yaw rate {100.0 * p.error:.1f} % off")
        for p in predictions
        if p.starts
    ]
    for row, (name, text) in enumerate(rows):
        y = 0.95 - 0.13 * row
        axes.text(0.0, y, name, color=MUTED, fontsize=10, transform=axes.transAxes)
        axes.text(0.52, y, text, color=INK, fontsize=10, transform=axes.transAxes)


def _innovations(axes: Axes, found: Identified, channel: int) -> None:
    rows = found.channels.rows == channel
    time = np.concatenate([passage.rows for passage in found.channels.passages])[rows]
    axes.plot(time - time[0], found.estimate.residuals[rows], ".", color=_COLOURS[channel], markersize=1.5)
    axes.set_ylim(-5.0, 5.0)
    axes.set_xlabel("s", color=INK)
    style(axes, "innovation / deviation")
    name = list(whiteness(found))[channel].name
    axes.set_title(name, color=INK, fontsize=10, loc="left")


def _autocorrelation(axes: Axes, found: Identified, channel: int) -> None:
    own = found.estimate.residuals[found.channels.rows == channel]
    scale = max(float(np.mean(own * own)), 1e-12)
    lags = np.arange(1, _LAGS + 1)
    values = [float(np.mean(own[lag:] * own[:-lag])) / scale for lag in lags]
    axes.bar(lags, values, color=_COLOURS[channel], width=0.6)
    bound = REACH / math.sqrt(max(own.size, 1))
    axes.axhspan(-bound, bound, color=MUTED, alpha=0.25, linewidth=0)
    axes.set_ylim(-0.3, 0.3)
    axes.set_xticks(range(0, _LAGS + 1, 5))
    axes.set_xlabel("lag, samples (band: white noise)", color=INK)
    style(axes, "autocorrelation")


def _left_out(axes: Axes, found: Identified, left_out: Channels | None) -> None:
    style(axes, "yaw rate, deg/s")
    axes.set_xlabel("s", color=INK)
    if left_out is None:
        axes.text(0.5, 0.5, "no manoeuvre was left out", color=MUTED, ha="center", transform=axes.transAxes)
        return
    passage = left_out.passages[0]
    states = filtered(passage, left_out, found.physical)
    times, grid = passage.times, passage.grid
    measured = grid.rate_row >= 0
    zero = times[0]
    rate = np.degrees(grid.rate[measured] - found.physical[GYRO])
    axes.plot(times[:-1][measured] - zero, rate, color=MUTED, linewidth=2.2, label="measured")
    options: dict[str, Any] = {"color": RED, "linewidth": 1.0}
    for number, (first, length) in enumerate(starts_of(passage, 10.0)[::5]):
        track = flown(passage, left_out, found.physical, first, length, states[first])
        label = "predicted over 10 s by the commands alone" if number == 0 else None
        moments = times[first + 1 : first + 1 + length] - zero
        axes.plot(moments, np.degrees(track[:, 2]), label=label, **options)
    axes.legend(frameon=False, fontsize=9, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    axes.set_title("left-out manoeuvres", color=INK, fontsize=10, loc="left")
