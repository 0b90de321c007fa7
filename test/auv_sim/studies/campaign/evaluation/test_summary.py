"""Summaries of tables whose truth is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation import statistics
from auv_sim.studies.campaign.evaluation.summary import SUMMED_UP, Summary, figure_label, summarise
from auv_sim.studies.campaign.study_file import FIGURES

STUDY = """\
version: 1
name: trial
runs: {runs}
vary:
  autopilot.nism.k1: {{grid: [0.2, 0.4, 0.6, 0.8]}}
  autopilot.nism.k3: {{grid: [0.2, 0.4]}}
  guidance.law: {{grid: [ailos, los]}}
  initial.starboard: {{uniform: [-15, 15]}}
  initial.heading_deg: {{uniform: [-180, 180]}}
"""


def summed(folder: Path, runs: int) -> Summary:
    """Flights that a start beside the path, k1 and the law decide, the heading and k3 not."""
    (folder / "trial.yaml").write_text(STUDY.format(runs=runs), encoding="utf-8")
    plan = StudyPlan(folder / "trial.yaml")
    rows = [plan.values(run) for run in range(plan.runs)]
    columns = {name: np.array([row[name] for row in rows]) for name in plan.study.vary}
    figure = 20.0 + columns["initial.starboard"] + 5.0 * columns["autopilot.nism.k1"]
    figure += 2.0 * (columns["guidance.law"] == "los")
    figures = dict.fromkeys((*SUMMED_UP, plan.study.judge), figure)
    flags = dict.fromkeys(("success", "completed"), np.ones(plan.runs, dtype=bool))
    return summarise(plan, pa.table({"run": np.arange(plan.runs)} | columns | flags | figures))


def test_points_of_a_grid_do_not_count_as_draws(tmp_path: Path) -> None:
    summary = summed(tmp_path, 20)
    assert summary.runs == 320 and summary.success == statistics.share(20, 20)
    # Twenty starts tell nothing of what starts do; what they share out among the grid's values they do tell.
    assert np.isnan([summary.explained[f"initial.{name}"] for name in ("starboard", "heading_deg")]).all()
    assert summary.explained["autopilot.nism.k3"] == 0.0 < summary.explained["autopilot.nism.k1"] < 0.1
    assert 0.0 < summary.explained["guidance.law"] < 0.1
    spread = summary.figures["rms_distance"]
    # 30/sqrt(12) m of scatter from start to start, in 20 of them.
    assert spread.mean.high - spread.mean.value == pytest.approx(2.09 * 8.66 / np.sqrt(20.0), rel=0.25)


def test_enough_rounds_tell_what_the_draws_do(tmp_path: Path) -> None:
    explained = summed(tmp_path, 200).explained
    assert explained["initial.starboard"] > 0.9
    assert explained["initial.heading_deg"] < 0.1
    assert next(iter(explained)) == "initial.starboard"


def test_every_figure_has_its_unit() -> None:
    # Counts, shares and the path's own parameter are pure numbers; nothing else is.
    assert {name for name in FIGURES if "[" not in figure_label(name)} == {
        "steps", "progress", "saturated", "flown_share",
    }  # fmt: skip
    assert figure_label("rms_rudder_rate") == "rms rudder rate [deg/s]"
    assert figure_label("current_estimate_error") == "current estimate error [m/s]"
    assert figure_label("late_rms_distance") == "late rms distance [m]"
