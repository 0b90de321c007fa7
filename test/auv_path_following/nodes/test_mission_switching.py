"""ailos_guidance alone takes the switching from its mission."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from auv_path_following.nodes.guidance_node import GuidanceNode
from node_bench import Bench


@pytest.fixture
def mission(tmp_path: Path) -> str:
    file = tmp_path / "switched.yaml"
    route = "loiter: {centre: [0, 0], radius: 30}\nswitching: {mode: all, radius: 3}\n"
    file.write_text(f"version: 1\nname: switched\nframe: ned\nspeed: 1.5\n{route}", encoding="utf-8")
    return str(file)


@pytest.mark.parametrize(("taken", "expected"), [(True, ("all", 3.0)), (False, ("off", 6.0))])
def test_its_parameters_show_what_counts(
    bench: Bench, mission: str, taken: bool, expected: tuple[str, float]
) -> None:
    parameters = {"mission": mission, "mission_switching": taken, "guidance__switching__mode": "off"}
    node = bench.start(GuidanceNode, **parameters)
    names = ("guidance.switching.mode", "guidance.switching.radius")
    assert tuple(node.get_parameter(name).value for name in names) == expected
    circles = node.keeper.config.follower.progress.circles
    assert (("off", "g0", "all")[circles.mode], circles.radius) == expected


def test_a_speed_becomes_the_vehicles_thrust(bench: Bench, mission: str) -> None:
    node = bench.start(GuidanceNode, mission=mission, vehicle="remus100")
    assert node.keeper.config.thrust == pytest.approx(1.62 * 1.5**2)


def test_what_is_not_taken_of_a_waypoint_file_is_logged(
    bench: Bench, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    items = [{"command": 16, "frame": 3, "params": [60, 0, 0, 0, lat, 10.6, 0]} for lat in (59.9, 59.901)]
    (tmp_path / "a.plan").write_text(json.dumps({"fileType": "Plan", "mission": {"items": items}}))
    bench.start(GuidanceNode, mission=str(tmp_path / "a.plan"), vehicle="remus100")
    logged = capfd.readouterr().err
    assert "a.plan is not a mission file; assumed: straight legs" in logged
    assert "a.plan: hold of 60 s (items 1, 2) not taken" in logged
