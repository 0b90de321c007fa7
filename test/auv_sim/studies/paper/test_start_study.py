"""A small version of the study of random starts, and the default's bounds on the paper's mission."""

from __future__ import annotations

import csv
import math

import numpy as np
import pytest

from auv_path_following.missions import mission_file
from auv_sim.flight.metrics import root_mean_square
from auv_sim.studies.paper import start_study
from auv_sim.studies.paper.cases import CURRENT
from auv_sim.studies.paper.claims import measures
from auv_sim.studies.paper.paper_flights import MISSION, PaperFlight, fly

PATH = mission_file.load(MISSION).path


def test_starts_are_repeatable_and_within_bounds():
    few, many = start_study.starts(5, 7), start_study.starts(200, 7)
    assert many[:5] == few
    assert start_study.starts(5, 8) != few
    x0, y0, _ = PATH.start_pose
    assert max(math.hypot(s[0] - x0, s[1] - y0) for s, _ in many) <= start_study.LARGEST_OFFSET
    assert max(math.hypot(*c) for _, c in many) <= start_study.STRONGEST_CURRENT
    headings = np.array([s[2] for s, _ in many])
    assert np.hypot(np.cos(headings).mean(), np.sin(headings).mean()) < 0.2


def test_the_default_converges_from_anywhere(tmp_path):
    # Run 400 is the one of a thousand that an earlier choice of gains did not survive on the printed hull.
    work = [
        job for job in start_study.jobs(401, 1, ["robust"], ["mismatch", "table2"]) if job.run in (0, 400)
    ]
    results = start_study.study(work, 1)
    for result in results:
        assert result.finished
        assert result.distance_after_settling <= 1.0
        assert result.rms_after_corner <= 0.03
        assert result.largest_rudder_rate <= math.radians(15.0) * (1 + 1e-9)
    rows = start_study.table(results)
    assert [(row.law, row.runs) for row in rows] == [("robust", 2), ("robust", 2)]
    start_study.write(results, tmp_path / "starts.csv")
    with (tmp_path / "starts.csv").open(encoding="utf-8") as stream:
        assert len(list(csv.DictReader(stream))) == len(results)


def test_a_flight_that_never_arrives_counts_as_the_worst():
    lost = start_study.StartResult("pid", "table2", 1, 0, False, 80.0, math.nan, 0.2)
    row = start_study.table([lost])[0]
    assert row.finished == 0.0
    assert row.rms_worst == math.inf


@pytest.mark.parametrize("step", [0.1, 0.05])
def test_the_default_meets_its_bounds_in_the_papers_current(step):
    run = fly(PaperFlight(name="case 3", params="robust", current=CURRENT, step=step))
    assert measures.completed(run, PATH)
    distance = measures.distance(run, PATH)
    assert all(root_mean_square(distance[run.subpath(PATH.n) == i]) <= 0.05 for i in range(2, 7))
    assert measures.at_joint(run, PATH, 0) <= 1.0


def test_table_4_falls_into_the_limit_cycle_where_the_default_does_not():
    cycle, calm = (
        fly(
            PaperFlight(
                name=params,
                plant="table2",
                params=params,
                start=(-27.07, 27.07, math.pi / 4),
                time_limit=60.0,
            )
        )
        for params in ("paper", "robust")
    )
    assert np.abs(np.degrees(cycle.psi_e[-200:])).max() > 30.0
    assert np.abs(np.degrees(calm.psi_e[-200:])).max() < 1.0
