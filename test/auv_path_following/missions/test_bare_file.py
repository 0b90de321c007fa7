"""A waypoint file in the place of a mission file."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import mission_file

ITEMS = [
    {"command": 16, "frame": 3, "params": [0, 0, 0, 0, 59.9, 10.6, 0]},
    {"command": 16, "frame": 3, "params": [0, 0, 0, 0, 59.901, 10.6, 0]},
]


def _plan(path, *before: dict) -> str:
    path.write_text(json.dumps({"fileType": "Plan", "mission": {"items": [*before, *ITEMS]}}))
    return str(path)


def test_a_plan_is_flown_straight_from_waypoint_to_waypoint_and_says_so(tmp_path):
    mission = mission_file.load(_plan(tmp_path / "harbour.plan"))
    assert mission.name == "harbour"
    assert mission.path.length == pytest.approx(111.4, abs=0.1)
    assert mission.speed == 1.5
    assert (mission.origin.latitude_deg, mission.origin.longitude_deg) == (59.9, 10.6)
    assert mission.notices[0] == (
        "harbour.plan is not a mission file; assumed: straight legs (smoothing linear), speed 1.5 m/s,"
        " origin [59.9, 10.6]"
    )


def test_its_own_speed_is_taken(tmp_path):
    speed = {"command": 178, "params": [1, 0.8, -1, 0, 0, 0, 0]}
    mission = mission_file.load(_plan(tmp_path / "a.plan", speed))
    assert mission.speed == 0.8
    assert "speed 0.8 m/s" in mission.notices[0]


def test_a_table_of_metres_needs_no_origin(tmp_path):
    (tmp_path / "a.csv").write_text("north,east\n0,0\n100,0\n")
    mission = mission_file.load(str(tmp_path / "a.csv"))
    assert mission.origin is None
    assert mission.path.length == 100.0


def test_what_is_written_for_a_flight_is_a_mission_file_that_flies_the_same(tmp_path):
    mission = mission_file.load(_plan(tmp_path / "a.plan"))
    (tmp_path / "config").mkdir()
    again = mission_file.load(str(mission.copy_to(tmp_path / "config")))
    assert again.source.name == "mission.yaml"
    assert again.assumed is None
    assert again.path.length == mission.path.length
    assert again.thrust == mission.thrust


def test_an_error_in_it_names_it_once(tmp_path):
    jump = {"command": 177, "frame": 2, "params": [1, 3, 0, 0, 0, 0, 0]}
    with pytest.raises(ConfigurationError) as caught:
        mission_file.load(_plan(tmp_path / "a.plan", jump))
    assert str(caught.value).startswith(f"{tmp_path / 'a.plan'}: item 1: found command 177 (jump)")
