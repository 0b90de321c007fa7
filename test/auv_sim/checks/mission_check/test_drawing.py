"""The picture of a plan is drawn whatever the check found."""

from __future__ import annotations

import pytest

from auv_path_following import vehicle
from auv_path_following.mission_check.flyable import check
from auv_path_following.missions import mission_file
from auv_sim.checks.mission_check.drawing import draw

STEEP = """\
version: 1
name: steep
frame: ned
thrust: 6.48
limits: {max_depth: 60}
depth_profile: {kind: smooth, knots: [[0, 5], [60, 70], [400, 5]]}
segments: [{line: {start: [0, 0], length: 400, course_deg: 0}}]
"""


@pytest.mark.parametrize("hull", ["remus100_6dof", "remus100"])
def test_a_refused_plan_is_drawn_for_a_vehicle_of_either_kind(tmp_path, hull):
    (tmp_path / "steep.yaml").write_text(STEEP, encoding="utf-8")
    flown = vehicle.load(hull)
    mission = mission_file.load(str(tmp_path / "steep.yaml"), flown)
    findings = check(mission, flown)
    assert findings.refusals
    draw(mission, findings, flown, tmp_path / "plan.png")
    assert (tmp_path / "plan.png").read_bytes().startswith(b"\x89PNG")
