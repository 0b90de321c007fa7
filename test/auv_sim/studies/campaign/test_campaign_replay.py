"""The files of one run of a campaign are the run: the launcher reads its scenario back from them."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_sim.cli import mission as mission_command
from auv_sim.flight.scenario import Scenario
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.campaign.campaign_plan import StudyPlan
from auv_sim.studies.campaign.campaign_replay import command_line, write_files
from auv_sim.vehicle.hulls.rigid_body import BodyState

DIVE = Path(__file__).parents[3] / "data" / "short_dive.yaml"
PLANAR = """\
mission: paper_composite
vary:
  vehicle.hull.Nuud: {uniform: [0.7, 1.3], factor: true}
  autopilot.nism.k1: {uniform: [0.2, 0.4]}
"""
DIVING = f"""\
mission: {DIVE}
vehicle: remus100_6dof
sea: shelf
vary:
  vehicle.hull.vertical.zg: {{uniform: [0.9, 1.1], factor: true}}
  initial.below: {{uniform: [-1, 1]}}
  initial.pitch_deg: {{uniform: [5, 20]}}
  initial.heading_deg: {{uniform: [-90, 90]}}
  current.down: {{uniform: [-0.1, -0.05]}}
  pitch.nism.k1: {{uniform: [0.2, 0.4]}}
  sea.bottom.depth: {{uniform: [40, 50]}}
"""


def compared(scenario: Scenario) -> dict[str, Any]:
    """What a scenario flies, but for the objects that only its files compare."""
    left_out = {"path", "spatial", "initial", "time_limit"}
    return {
        field.name: getattr(scenario, field.name)
        for field in dataclasses.fields(scenario)
        if field.name not in left_out
    }


@pytest.mark.parametrize("text", [PLANAR, DIVING], ids=["planar", "diving"])
def test_the_launcher_flies_the_run_that_its_files_say(text: str, tmp_path: Path) -> None:
    study = tmp_path / "trial.yaml"
    study.write_text(f"version: 1\nname: trial\nruns: 3\ntime_limit: 60\n{text}", encoding="utf-8")
    plan = StudyPlan(study)
    write_files(plan, 2, tmp_path / "config")
    words = mission_command.parser().parse_args(command_line(tmp_path / "config"))
    named = {f.name: getattr(words, f.name) for f in dataclasses.fields(Options) if hasattr(words, f.name)}
    read, wanted = mission_plan.scenario(Options(**named)), plan.scenario(2)
    assert wanted.initial is not None
    assert read.initial == pytest.approx(wanted.initial, abs=1e-15)
    assert isinstance(read.initial, BodyState) == (text is DIVING)
    assert (read.path.length, read.path.n) == (wanted.path.length, wanted.path.n)
    assert (read.spatial is None) == (wanted.spatial is None) == (text is PLANAR)
    assert compared(read) == compared(wanted)
    guidance = params_file.load(tmp_path / "config" / "params.yaml", SUITE)[topics.GUIDANCE]
    watched = dataclasses.asdict(guidance.diving)
    kept = {"tilt_after", "depth_tolerance", "depth_rate_error"}  # that only say how a limit is judged
    assert {name for name, value in watched.items() if value} == kept, "a limit that the engine does not have"
