"""Which flights of a study succeed."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from auv_msgs_py.settings.schema import validated
from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.flight.batch import engine
from auv_sim.flight.batch.flight_figures import Flights
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.evaluation.summary import summarise
from auv_sim.studies.campaign.run_table import flown_enough, successes, table_of
from auv_sim.studies.campaign.study_file import Study


def flights(**columns: list[float]) -> Flights:
    """Four flights that are perfect but for what is given."""
    names = [field.name for field in dataclasses.fields(Flights)]
    perfect = {name: np.zeros(4) for name in names} | {
        "completed": np.ones(4, bool),
        "flown_share": np.ones(4),
    }
    return Flights(**perfect | {name: np.array(values) for name, values in columns.items()})


def study(**changes) -> Study:
    return validated(Study, {"version": 1, "name": "trial", **changes}, "trial.yaml")


def test_a_flight_that_skipped_some_of_the_path_is_no_success() -> None:
    flown = flights(flown_share=[1.0, 0.99, 0.989, np.nan])
    assert successes(study(), flown).tolist() == [True, True, False, False]
    assert flown_enough(study(), flown.flown_share).tolist() == [True, True, False, False]
    assert successes(study(flown=0.95), flown).tolist() == [True, True, True, False]
    assert successes(study(flown=1), flown).tolist() == [True, False, False, False]


def test_the_end_of_the_path_and_the_limits_count_as_well() -> None:
    flown = flights(completed=[True, False, True, True], late_largest_distance=[1.0, 1.0, 2.5, np.nan])
    limits = study(success={"late_largest_distance": 2.0})
    assert successes(limits, flown).tolist() == [True, False, False, False]


def test_a_share_beyond_the_whole_path_is_refused() -> None:
    with pytest.raises(ConfigurationError, match="flown: found 99"):
        study(flown=99)


def test_a_table_has_figures_of_depth_where_a_vehicle_dives(tmp_path: Path) -> None:
    """Of a study in which the other vehicle flies in the plane."""
    file = tmp_path / "depths.yaml"
    file.write_text(
        "version: 1\nname: depths\nmission: loiter\ntime_limit: 5\nvary:\n"
        "  vehicle: {grid: [remus100, remus100_6dof]}\njudge: largest_pitch\n"
    )
    plan = StudyPlan(file)
    scenarios = [plan.scenario(run) for run in range(2)]
    table = table_of(plan, range(2), engine.fly(scenarios), [told.path.n for told in scenarios])
    planar, deep = table.column("largest_pitch").to_pylist()
    assert np.isnan(planar) and 0.0 < deep < 30.0
    assert "largest_pitch" in summarise(plan, table).figures
    alone = table_of(plan, range(1), engine.fly(scenarios[:1]), [scenarios[0].path.n])
    assert np.isnan(alone.column("rms_depth_error").to_pylist()).all()
