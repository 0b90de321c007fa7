"""Sums a campaign up in a few figures with their confidence intervals."""

from __future__ import annotations

import dataclasses
import json
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pyarrow as pa

from auv_sim.flight.batch.flight_figures import UNITS
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation import statistics
from auv_sim.studies.campaign.evaluation.statistics import Estimate
from auv_sim.studies.campaign.run_table import flown_enough

#: The figures in every summary.
SUMMED_UP = (
    "flown_share",
    "rms_distance",
    "largest_distance",
    "late_rms_distance",
    "late_largest_distance",
    "time_to_path",
    "duration",
    "rms_heading_error",
    "rudder_travel_per_metre",
    "rms_rudder_rate",
    "saturated",
    "current_estimate_error",
)
#: Further ones of studies with a vehicle that dives.
SUMMED_UP_IN_DEPTH = (
    "rms_depth_error",
    "largest_depth_error",
    "steady_rms_depth_error",
    "steady_largest_depth_error",
    "largest_pitch",
    "sternplane_travel_per_metre",
)


@dataclass(frozen=True)
class Spread:
    """One figure over all completed flights."""

    mean: Estimate
    median: Estimate
    p95: Estimate
    largest: float


@dataclass(frozen=True)
class Point:
    """One point of the grids: its values, its flights, and the judged figure there."""

    values: dict[str, Any]
    runs: int
    success: Estimate
    completed: Estimate
    judged: Estimate


@dataclass(frozen=True)
class Summary:
    """A whole campaign.

    Attributes:
        name: of the study.
        runs: flown.
        success, completed, flown: shares of the flights that succeeded, that reached the end of the path, and
            that did so with enough of it flown; with grids over all points.
        figures: by name, over the completed flights; with grids of all points.
        judge: the figure that `points` and `explained` are about.
        explained: share of its variance that each varied parameter explains alone, the largest first; NaN
            with too few rounds.
        points: of the grids; empty without any.
        worst: numbers of the worst runs: failed ones, then those with the largest judged figure.
    """

    name: str
    runs: int
    success: Estimate
    completed: Estimate
    flown: Estimate
    figures: dict[str, Spread]
    judge: str
    explained: dict[str, float]
    points: tuple[Point, ...]
    worst: tuple[int, ...]

    def to_json(self) -> str:
        """Return strict JSON, indented; NaN becomes null."""
        return json.dumps(_plain(dataclasses.asdict(self)), indent=2, allow_nan=False) + "\n"


def summarise(plan: StudyPlan, table: pa.Table) -> Summary:
    """Sum up a campaign.

    Args:
        plan: the study.
        table: its runs in order, as `store.Store.finish` gives them.
    """
    study = plan.study
    completed = column(table, "completed").astype(bool)
    success = column(table, "success").astype(bool)
    judged = column(table, study.judge)
    rounds = rounds_of(plan, table)
    figures = {
        name: _spread(column(table, name)[completed], rounds[completed] if plan.grids else None, study.seed)
        for name in summed_up(plan)
    }
    explained = {name: _explained(plan, column(table, name), judged, name) for name in study.vary}
    order = np.lexsort((column(table, "run"), -np.nan_to_num(judged, nan=np.inf), success))
    return Summary(
        name=study.name,
        runs=table.num_rows,
        success=statistics.share_of_rounds(success, rounds),
        completed=statistics.share_of_rounds(completed, rounds),
        flown=statistics.share_of_rounds(
            completed & flown_enough(study, column(table, "flown_share")), rounds
        ),
        figures=figures,
        judge=study.judge,
        explained=dict(sorted(explained.items(), key=lambda item: -np.nan_to_num(item[1]))),
        points=tuple(_points(plan, success, completed, judged)) if plan.grids else (),
        worst=tuple(int(run) for run in order[:5]),
    )


def summed_up(plan: StudyPlan) -> tuple[str, ...]:
    """Return the figures in a study's summary."""
    more = SUMMED_UP_IN_DEPTH if plan.dives else ()
    return tuple(dict.fromkeys((*SUMMED_UP, *more, plan.study.judge)))


def column(table: pa.Table, name: str) -> Any:
    """Return a column as an array; what is missing is NaN."""
    return table.column(name).to_numpy()


def figure_label(name: str) -> str:
    """Return a figure's name for people, with its unit."""
    words = name.replace("_", " ")
    return f"{words} [{UNITS[name]}]" if name in UNITS else words


def rounds_of(plan: StudyPlan, table: pa.Table) -> Any:
    """Return the round of each run: the runs of a round share what is drawn."""
    return column(table, "run") // len(plan.points)


def _explained(plan: StudyPlan, parameter: Any, judged: Any, name: str) -> float:
    if not plan.study.vary[name].is_numeric:
        parameter = np.unique(parameter, return_inverse=True)[1].astype(np.float64)  # words: which one
    points = len(plan.points)
    figure = judged.reshape(-1, points)
    if name in plan.grids:
        return statistics.explained_by_grid(parameter[:points], figure)
    return statistics.explained(parameter[::points], figure)


def _points(plan: StudyPlan, success: Any, completed: Any, judged: Any) -> list[Point]:
    points = []
    for number, values in enumerate(plan.points):
        mine = slice(number, None, len(plan.points))
        runs = len(success[mine])
        points.append(
            Point(
                values=dict(zip(plan.grids, values, strict=True)),
                runs=runs,
                success=statistics.share(int(success[mine].sum()), runs),
                completed=statistics.share(int(completed[mine].sum()), runs),
                judged=statistics.mean(judged[mine][completed[mine]]),
            )
        )
    return points


def _spread(values: Any, rounds: Any, seed: int) -> Spread:
    known = values[np.isfinite(values)]
    return Spread(
        mean=statistics.mean(values, rounds),
        median=statistics.quantile(values, 0.5, seed, rounds),
        p95=statistics.quantile(values, 0.95, seed, rounds),
        largest=float(known.max()) if known.size else math.nan,
    )


def _plain(value: Any) -> Any:
    if isinstance(value, Estimate):
        return _plain(value._asdict())
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
