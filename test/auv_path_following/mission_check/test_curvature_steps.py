"""Steps of the curvature that the yaw cannot follow are warned of, and the flights bear it out."""

from __future__ import annotations

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.mission_check.flyable import check
from auv_path_following.missions import mission_file
from auv_sim.flight import closed_loop
from auv_sim.launch import mission_plan
from auv_sim.launch.options import Options

REMUS = vehicle.load("remus100")


def _survey(folder, spacing: float, radius: float, kind: str = "dubins") -> str:
    """Legs closer than two radii: a Dubins turn swings out to one side and back to the other."""
    text = (
        "version: 1\nname: survey\nframe: ned\nthrust: 6.48\n"
        f"survey: {{polygon: [[0, 0], [80, 0], [80, 40], [0, 40]], spacing: {spacing}, heading_deg: 0,"
        f" smoothing: {{kind: {kind}, radius: {radius}}}}}\n"
    )
    (folder / "survey.yaml").write_text(text)
    return str(folder / "survey.yaml")


def _warnings(name: str) -> list[str]:
    warnings = check(mission_file.load(name, REMUS), REMUS).warnings
    return [str(one) for one in warnings if "step of the curvature" in one.found]


def _largest(name: str) -> float:
    """Largest distance of the flight from its path, without its first 5 s, m."""
    scenario = mission_plan.scenario(Options(mission=name))
    run = closed_loop.fly(scenario)
    i = np.minimum(run.s.astype(int), scenario.path.n - 1)
    return float(scenario.path.distance(run.x, run.y, i)[100:].max())


def test_a_survey_whose_turns_flip_is_warned_of_and_leaves_its_path(tmp_path):
    name = _survey(tmp_path, 10.0, 12.0)
    (found,) = _warnings(name)
    assert "a step of the curvature by 0.167 1/m (G1) (likewise at" in found
    assert "at most 0.118 1/m at 2.00 m/s, or the vehicle leaves the path by 1.3 m or more" in found
    assert _largest(name) > 1.0


def test_a_survey_with_room_for_its_turns_is_not(tmp_path):
    name = _survey(tmp_path, 40.0, 12.0)
    assert _warnings(name) == []
    assert _largest(name) < 1.0


@pytest.mark.parametrize("name", ["course_circular", "course_dubins", "survey_wgs84", "paper_composite"])
def test_shipped_missions_have_no_such_step(name):
    assert _warnings(name) == []
