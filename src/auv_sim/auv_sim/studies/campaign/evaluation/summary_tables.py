"""A campaign's summary in the terminal."""

from __future__ import annotations

import math

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from auv_sim.flight.flown_share import percent
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation.statistics import Estimate
from auv_sim.studies.campaign.evaluation.summary import Summary, figure_label
from auv_sim.terminal import headed_table

#: Most rows of the table of points.
_POINTS = 40
#: Least share of the variance that is listed, and most parameters listed.
_LEAST_EXPLAINED, _MOST_LISTED = 0.005, 6


def show(plan: StudyPlan, summary: Summary, console: Console) -> None:
    """Print success, grid points, figures, and the parameters that explain the judged figure."""
    console.print(f"\nsuccess    {_percent(summary.success)}\ncompleted  {_percent(summary.completed)}")
    console.print(f"flown      {_percent(summary.flown)}: at least {percent(plan.study.flown)} of the path\n")
    if summary.points:
        console.print(_points(plan, summary))
    console.print(_figures(summary))
    listed = [
        f"{name} {100 * value:.0f} %"
        for name, value in summary.explained.items()
        if value >= _LEAST_EXPLAINED
    ]
    if listed:
        console.print(
            f"what explains {summary.judge} alone: {', '.join(listed[:_MOST_LISTED])}\n", soft_wrap=True
        )
    unknown = [name for name, value in summary.explained.items() if math.isnan(value)]
    if unknown:
        console.print(f"too few flights to judge: {', '.join(unknown)}\n", soft_wrap=True)


def _figures(summary: Summary) -> Table:
    title = "completed flights, with 95 % confidence intervals"
    table = headed_table(title, ("figure",), ("mean", "median", "95 % of flights below", "largest"))
    for name, spread in summary.figures.items():
        cells = [_estimate(value) for value in (spread.mean, spread.median, spread.p95)]
        table.add_row(escape(figure_label(name)), *cells, f"{spread.largest:.4g}")
    return table


def _points(plan: StudyPlan, summary: Summary) -> Table:
    numbers = ("flights", "success", escape(f"mean {figure_label(summary.judge)}"))
    table = headed_table("points of the grids", plan.grids, numbers)
    best = sorted(summary.points, key=lambda point: (-point.success.value, point.judged.value))
    shown = summary.points if len(summary.points) <= _POINTS else best[:_POINTS]
    for point in shown:
        cells = [
            f"{value:.4g}" if isinstance(value, float) else escape(str(value))
            for value in point.values.values()
        ]
        table.add_row(*cells, str(point.runs), _percent(point.success), _estimate(point.judged))
    if len(shown) < len(summary.points):
        table.caption = f"the best {_POINTS} of {len(summary.points)}; all are in summary.json"
    return table


def _percent(estimate: Estimate) -> str:
    return f"{100 * estimate.value:.2f} % ({100 * estimate.low:.2f} to {100 * estimate.high:.2f})"


def _estimate(estimate: Estimate) -> str:
    return f"{estimate.value:.4g} ({estimate.low:.4g} to {estimate.high:.4g})"
