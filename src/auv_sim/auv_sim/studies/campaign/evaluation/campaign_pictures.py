"""Draws a campaign: where it succeeds, the spread of its figures, and what they depend on."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation import statistics
from auv_sim.studies.campaign.evaluation.summary import Summary, column, figure_label, rounds_of
from auv_sim.views.plot_style import BLUE, GREEN, GRID, INK, MUTED, ORANGE, RED, save, style

#: Of the start and of the current; other parameters have those of their files.
UNITS = {
    "distance": "m", "bearing_deg": "deg", "ahead": "m", "starboard": "m", "heading_deg": "deg",
    "surge": "m/s", "speed": "m/s", "course_deg": "deg", "north": "m/s", "east": "m/s",
    "below": "m", "pitch_deg": "deg", "down": "m/s",
}  # fmt: skip
_BINS = 12


def draw(plan: StudyPlan, table: pa.Table, summary: Summary, directory: Path) -> list[Path]:
    """Draw the pictures for which the study has data.

    Returns:
        their files.
    """
    drawn = {"distribution.png": _distribution(plan, table, summary)}
    varied = [name for name in summary.explained if _varies(table, name)]
    axes = plan.study.axes or tuple(name for name in varied if plan.study.vary[name].is_numeric)[:2]
    if axes:
        drawn["success.png"] = _success(plan, table, summary, axes)
    if varied:
        drawn["sensitivity.png"] = _sensitivity(plan, table, summary, varied[:12])
    files = []
    for name, figure in drawn.items():
        FigureCanvasAgg(figure)
        save(figure, directory / name, dpi=110)
        files.append(directory / name)
    return files


def label(name: str) -> str:
    """Return a parameter's name with its unit, if it has one of its own."""
    unit = UNITS.get(name.rpartition(".")[2], "") if name.startswith(("initial.", "current.")) else ""
    return f"{name} [{unit}]" if unit else name


def _varies(table: pa.Table, name: str) -> bool:
    return len(np.unique(column(table, name))) > 1


def _headed(plan: StudyPlan, summary: Summary, size: tuple[float, float]) -> Figure:
    figure = Figure(figsize=size, layout="constrained")
    p = summary.success
    figure.suptitle(
        f"{plan.study.name}: {summary.runs} flights, success {100 * p.value:.2f} %"
        f" ({100 * p.low:.2f} to {100 * p.high:.2f})",
        color=INK, fontsize=12, parse_math=False,
    )  # fmt: skip
    return figure


def _distribution(plan: StudyPlan, table: pa.Table, summary: Summary) -> Figure:
    figure = _headed(plan, summary, (11.0, 4.6))
    completed = column(table, "completed").astype(bool)
    names = list(dict.fromkeys([summary.judge, "late_largest_distance"]))
    for place, name in zip(figure.subplots(1, len(names), squeeze=False)[0], names, strict=True):
        values = column(table, name)[completed]
        values = values[np.isfinite(values)]
        style(place, "share of the completed flights")
        place.set_xlabel(figure_label(name), color=INK)
        if not values.size:
            place.text(0.5, 0.5, "no completed flight", transform=place.transAxes, ha="center", color=MUTED)
            continue
        low, high = float(values.min()), float(values.max())
        wide = low > 0.0 and high > 10.0 * low
        edges = np.geomspace(low, high, 41) if wide else np.linspace(low, high + 1e-12, 41)
        place.hist(values, edges, weights=np.full(values.size, 1.0 / values.size), color=BLUE, alpha=0.35)
        if wide:
            place.set_xscale("log")
            _plain_ticks(place.xaxis)
        beside = place.twinx()
        beside.plot(np.sort(values), np.arange(1, values.size + 1) / values.size, color=INK, linewidth=1.4)
        beside.set_ylim(0.0, 1.02)
        beside.set_ylabel("share up to here (line)", color=INK)
        for side in ("top", "left", "bottom"):
            beside.spines[side].set_visible(False)
        for at, color, text in ((0.5, GREEN, "median"), (0.95, ORANGE, "95 %")):
            value = float(np.quantile(values, at))
            place.axvline(value, color=color, linewidth=1.4, label=f"{text} {value:.3g}")
        place.legend(frameon=False, fontsize=9, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)
    return figure


def _plain_ticks(axis: Any) -> None:
    """Label a logarithmic axis with 0.02, 0.05, 0.1 instead of powers."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _success(plan: StudyPlan, table: pa.Table, summary: Summary, axes: tuple[str, ...]) -> Figure:
    success = column(table, "success").astype(bool)
    if len(axes) == 1:
        figure = _headed(plan, summary, (7.5, 4.8))
        place = figure.subplots()
        _share_over(place, column(table, axes[0]), success, rounds_of(plan, table))
        place.set_xlabel(label(axes[0]), color=INK)
        return figure
    figure = _headed(plan, summary, (12.5, 5.2))
    left, right = figure.subplots(1, 2)
    x, y = (column(table, name) for name in axes)
    (x_edges, i), (y_edges, j) = _binned(x), _binned(y)
    judged = column(table, summary.judge)
    share, median, largest = (np.full((len(y_edges) - 1, len(x_edges) - 1), np.nan) for _ in range(3))
    for row in range(share.shape[0]):
        for col in range(share.shape[1]):
            here = (i == col) & (j == row)
            if here.any():
                share[row, col] = success[here].mean()
                if np.isfinite(judged[here]).any():
                    median[row, col], largest[row, col] = np.nanmedian(judged[here]), np.nanmax(judged[here])
    if np.nanmin(share) < np.nanmax(share):
        _map_of_shares(left, x_edges, y_edges, share)
    else:  # the same everywhere is one number, which the title has
        mesh = left.pcolormesh(x_edges, y_edges, largest, cmap="viridis")
        figure.colorbar(mesh, ax=left, label=f"largest of {figure_label(summary.judge)}")
    failed = ~success
    if 0 < failed.sum() <= 2000:
        left.plot(x[failed], y[failed], "x", color=INK, markersize=4, label=f"{int(failed.sum())} failed")
        left.legend(frameon=True, fontsize=9, loc="upper right")
    mesh = right.pcolormesh(x_edges, y_edges, median, cmap="viridis")
    figure.colorbar(mesh, ax=right, label=f"median of {figure_label(summary.judge)}")
    for place in (left, right):
        style(place, label(axes[1]))
        place.grid(visible=False)
        place.set_xlabel(label(axes[0]), color=INK)
    return figure


def _map_of_shares(place: Any, x_edges: Any, y_edges: Any, share: Any) -> None:
    lowest = float(np.nanmin(share))
    floor = 0.0 if lowest < 0.5 else 0.5 if lowest < 0.9 else 0.9
    mesh = place.pcolormesh(x_edges, y_edges, share, cmap="RdYlGn", vmin=floor, vmax=1.0)
    place.get_figure().colorbar(mesh, ax=place, label="share of successes")


def _binned(values: Any) -> tuple[Any, Any]:
    """Return edges and the bin of each value: a bin for each value of a grid, else equally wide ones."""
    levels = np.unique(values)
    if len(levels) <= 2 * _BINS:
        middle = 0.5 * (levels[1:] + levels[:-1])
        half = 0.5 * (levels[1] - levels[0]) if len(levels) > 1 else 0.5
        edges = np.array([levels[0] - half, *middle, levels[-1] + half])
    else:
        edges = np.linspace(levels[0], levels[-1], _BINS + 1)
    return edges, np.clip(np.searchsorted(edges, values, side="right") - 1, 0, len(edges) - 2)


def _share_over(place: Any, x: Any, success: Any, rounds: Any) -> None:
    edges, owner = _binned(x)
    rows = []
    for number in range(len(edges) - 1):
        here = owner == number
        if here.any():
            estimate = statistics.share_of_rounds(success[here], rounds[here])
            rows.append((0.5 * (edges[number] + edges[number + 1]), *estimate))
    at, value, low, high = np.array(rows).T
    style(place, "share of successes, with 95 % intervals")
    place.errorbar(at, value, [value - low, high - value], color=BLUE, marker="o", markersize=4, capsize=3)
    place.set_ylim(min(0.9, float(low.min()) - 0.02), 1.005)


def _sensitivity(plan: StudyPlan, table: pa.Table, summary: Summary, names: list[str]) -> Figure:
    numbers = [name for name in names if plan.study.vary[name].is_numeric]
    columns = min(4, len(numbers) + 1)
    rows = math.ceil((len(numbers) + 1) / columns)
    figure = _headed(plan, summary, (max(3.6 * columns, 8.0), 3.2 * rows + 0.6))
    places = figure.subplots(rows, columns, squeeze=False).ravel()
    bars = places[0]
    style(bars, "")
    shares = [np.nan_to_num(summary.explained[name]) for name in names]
    bars.barh(range(len(names)), shares, color=BLUE)
    for place, name in enumerate(names):
        if math.isnan(summary.explained[name]):
            bars.text(0.0, place, " too few flights to judge", va="center", color=MUTED, fontsize=8)
    bars.set_yticks(range(len(names)), [name.split(".", 1)[-1] for name in names], fontsize=8)
    bars.invert_yaxis()
    bars.set_xlim(0.0, max(1.0, *shares) if max(shares) > 0.5 else max(0.1, 1.15 * max(shares)))
    bars.set_xlabel("share of the variance explained alone", color=INK, fontsize=9)
    judged, success = column(table, summary.judge), column(table, "success").astype(bool)
    known = judged[np.isfinite(judged)]
    low, high = np.quantile(known, [0.0, 0.995]) if known.size else (0.0, 1.0)
    for place, name in zip(places[1:], numbers, strict=False):
        _dependence(place, column(table, name), judged, success)
        place.set_xlabel(label(name), color=INK, fontsize=9)
        if low > 0.0 and high > 10.0 * low:
            place.set_yscale("log")
            _plain_ticks(place.yaxis)
        place.set_ylim(low if low > 0.0 else 0.0, max(high, low + 1e-9))
    if numbers:
        places[1].set_ylabel(figure_label(summary.judge), color=INK)
    for place in places[len(numbers) + 1 :]:
        place.set_visible(False)
    return figure


def _dependence(place: Any, x: Any, judged: Any, success: Any) -> None:
    style(place, "")
    thin = slice(None, None, max(1, len(x) // 2000))
    for rows, color in ((success, MUTED), (~success, RED)):
        place.plot(x[thin][rows[thin]], judged[thin][rows[thin]], ".", color=color, markersize=2, alpha=0.5)
    edges, owner = _binned(x)
    rows = []
    for number in range(len(edges) - 1):
        here = judged[owner == number]
        here = here[np.isfinite(here)]
        if here.size:
            rows.append((0.5 * (edges[number] + edges[number + 1]), *np.quantile(here, [0.1, 0.5, 0.9])))
    if rows:
        at, low, middle, high = np.array(rows).T
        place.fill_between(at, low, high, color=BLUE, alpha=0.2, linewidth=0)
        place.plot(at, middle, color=BLUE, linewidth=1.8)
    place.grid(color=GRID)
