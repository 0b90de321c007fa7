"""What a waypoint file brings to a mission beside its route, and what the mission says of it."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.missions import mission_file

HEAD = "version: 1\nname: t\nframe: wgs84\norigin: {latitude_deg: 59.9, longitude_deg: 10.6}\n"
WAY = "waypoints: {file: a.plan, smoothing: {kind: linear}}\n"
LOITER = "loiter: {centre: [59.9, 10.6], radius: 20}\n"
RING = [[59.89, 10.59], [59.89, 10.62], [59.92, 10.62], [59.92, 10.59]]
SPEED = {"command": 178, "params": [1, 0.8, -1, 0, 0, 0, 0]}


@pytest.fixture
def loaded(tmp_path):
    def load(text: str, *before: dict, fences: int = 0, waypoints: bool = True):
        items = [*before]
        for place in ((59.9, 10.6), (59.905, 10.6)) if waypoints else ():
            items.append({"command": 16, "frame": 3, "params": [0, 0, 0, 0, *place, -5]})
        polygons = [{"inclusion": True, "polygon": RING}] * fences
        document = {"fileType": "Plan", "mission": {"items": items}, "geoFence": {"polygons": polygons}}
        (tmp_path / "a.plan").write_text(json.dumps(document))
        (tmp_path / "m.yaml").write_text(text)
        return mission_file.load(str(tmp_path / "m.yaml"))

    return load


def test_a_plans_one_speed_is_the_missions_where_that_has_none(loaded):
    mission = loaded(HEAD + WAY, SPEED)
    assert mission.speed == 0.8
    assert vehicle.load("remus100").speed_at(mission.thrust) == pytest.approx(0.8)
    assert "a.plan: its speed of 0.8 m/s is taken, as speed through the water" in mission.notices


@pytest.mark.parametrize("own", ["speed: 1.5\n", "thrust: 5\n"])
def test_the_missions_own_speed_or_thrust_goes_before_the_plans(loaded, own):
    mission = loaded(HEAD + own + WAY, SPEED)
    assert mission.speed == (1.5 if "speed" in own else None)
    assert "a.plan: its speed of 0.8 m/s not taken: the mission file has its own" in mission.notices


def test_neither_the_mission_nor_its_file_has_a_speed(loaded):
    with pytest.raises(ConfigurationError, match="exactly one of thrust, speed"):
        loaded(HEAD + WAY)


def test_a_plans_one_inclusion_fence_is_the_geofence(loaded):
    mission = loaded(HEAD + "speed: 1\n" + WAY, fences=1)
    assert len(mission.geofence) == 4
    assert mission.geofence[0] == pytest.approx((-1114.0, -559.5), abs=0.5)  # 0.01 degrees at 59.9 north
    assert "a.plan: its inclusion fence is taken as geofence" in mission.notices


def test_a_geofence_of_the_mission_goes_before_the_plans(loaded):
    own = "geofence: [[59.8, 10.5], [59.8, 10.7], [60, 10.6]]\n"
    mission = loaded(HEAD + "speed: 1\n" + own + WAY, fences=1)
    assert len(mission.geofence) == 3
    assert "a.plan: its inclusion fence not taken: the mission file has its own geofence" in mission.notices


def test_a_fence_of_the_route_gives_way_to_a_geofence_of_another_file_with_a_line(loaded, tmp_path):
    (tmp_path / "area.csv").write_text("lat,lon\n59.8,10.5\n59.8,10.7\n60,10.6\n")
    mission = loaded(HEAD + "speed: 1\ngeofence: {file: area.csv}\n" + WAY, fences=1)
    assert len(mission.geofence) == 3
    assert "a.plan: its inclusion fence not taken: the mission file has its own geofence" in mission.notices


def test_several_fences_are_named_and_chosen(loaded):
    mission = loaded(HEAD + "speed: 1\n" + WAY, fences=2)
    assert mission.geofence == ()
    assert any("('fence 1', 'fence 2')" in notice for notice in mission.notices)
    chosen = "geofence: {file: a.plan, feature: fence 2}\n"
    assert len(loaded(HEAD + "speed: 1\n" + chosen + WAY, fences=2).geofence) == 4


def test_a_plan_that_holds_only_a_fence_is_a_geofence(loaded):
    mission = loaded(HEAD + "speed: 1\ngeofence: {file: a.plan}\n" + LOITER, fences=1, waypoints=False)
    assert len(mission.geofence) == 4
    assert [file.name for file in mission.files] == ["a.plan"]


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ("geofence: a.plan\n", "m.yaml: geofence: found 'a.plan', expected a list"),
        ("geofence: {file: none.plan}\n", "m.yaml: geofence.file: none.plan: found no such file"),
        ("geofence: {files: a.plan}\n", "m.yaml: geofence.files: found an unknown key"),
    ],
)
def test_a_wrong_geofence_is_refused_with_its_key(loaded, keys, said):
    with pytest.raises(ConfigurationError) as caught:
        loaded(HEAD + "speed: 1\n" + keys + LOITER)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("route", "said"),
    [
        (
            "waypoints: {file: a.csv, smoothing: {kind: circular, radius: 900}}",
            "waypoints.file: a.csv: point 2: found a corner that does not fit",
        ),
        (
            "waypoints: {file: a.csv, feature: x, smoothing: {kind: linear}}",
            "waypoints.file: a.csv: found no feature 'x'",
        ),
        (
            "waypoints: {file: far.csv, smoothing: {kind: linear}}",
            "waypoints.file: far.csv: point 2: found [1, 2]",
        ),
        (
            "waypoints: {file: one.csv, smoothing: {kind: linear}}",
            "waypoints.file: one.csv: found 1 point(s), expected at",
        ),
        (
            "survey: {file: one.csv, spacing: 9, heading_deg: 0, smoothing: {kind: linear}}",
            "survey.file: one.csv: found 1 corners",
        ),
        (
            "waypoints: {points: [], feature: x, smoothing: {kind: linear}}",
            "waypoints.feature: found 'x' without",
        ),
    ],
)
def test_a_message_names_the_waypoint_file_and_the_point(loaded, tmp_path, route, said):
    (tmp_path / "a.csv").write_text("lat,lon\n59.9,10.6\n59.905,10.6\n59.905,10.61\n")
    (tmp_path / "far.csv").write_text("lat,lon\n59.9,10.6\n1,2\n")
    (tmp_path / "one.csv").write_text("lat,lon\n59.9,10.6\n")
    with pytest.raises(ConfigurationError) as caught:
        loaded(HEAD + "speed: 1\n" + route + "\n")
    assert f"m.yaml: {said}" in str(caught.value)


def test_points_at_one_place_are_taken_once_with_a_line(loaded, tmp_path):
    (tmp_path / "a.csv").write_text("lat,lon\n59.9,10.6\n59.9,10.6\n59.905,10.6\n59.905,10.6000000001\n")
    mission = loaded(HEAD + "speed: 1\nwaypoints: {file: a.csv, smoothing: {kind: linear}}\n")
    assert mission.path.n == 1
    assert mission.notices == ("a.csv: 2 point(s) at the place of the one before left out",)


@pytest.mark.parametrize(("closed", "sides"), [("", 4), (", closed: false", 3)])
def test_the_outline_of_a_polygon_is_closed_unless_the_mission_says_otherwise(
    loaded, tmp_path, closed, sides
):
    ring = [[east, north] for north, east in RING]
    (tmp_path / "a.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [[*ring, ring[0]]]}))
    mission = loaded(
        HEAD + f"speed: 1\nwaypoints: {{file: a.geojson{closed}, smoothing: {{kind: linear}}}}\n"
    )
    assert mission.path.n == sides
    assert bool(mission.notices) == (sides == 3)
