"""MAVLink missions: what is flown of them, what is left out with a line, what is refused."""

from __future__ import annotations

import json

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import waypoint_files
from auv_path_following.missions.waypoint_files import Content

A, B, C = (63.0, 10.0), (63.01, 10.0), (63.01, 10.02)
RING = [[63.0, 10.0], [63.0, 10.1], [63.1, 10.1]]


def _item(command, place=(0.0, 0.0), first=0.0, second=0.0, frame=3, height=0.0, **more) -> dict:
    params = [first, second, 0, None, *place, height]
    return {"type": "SimpleItem", "command": command, "frame": frame, "params": params, **more}


def _survey(polygon=RING, transects=(A, B), **more) -> dict:
    inner = {"Items": [_item(16, place) for place in transects]}
    return {
        "type": "ComplexItem",
        "complexItemType": "survey",
        "polygon": polygon,
        "TransectStyleComplexItem": inner,
    } | more


@pytest.fixture
def plan(tmp_path):
    def make(*items: dict, **sections) -> Content:
        document = {"fileType": "Plan", "mission": {"items": items}, **sections}
        (tmp_path / "a.plan").write_text(json.dumps(document))
        return waypoint_files.read(tmp_path / "a.plan")

    return make


def test_takeoff_and_return_to_launch_are_left_out_with_a_line_each(plan):
    content = plan(_item(22, A), _item(16, A), _item(16, B), _item(20))
    points, _, notices, _ = waypoint_files.choose(content, "waypoints")
    assert points == [A, B]
    assert notices == ["takeoff (item 1) not taken", "return to launch (item 4) not taken"]


def test_holds_delays_cameras_and_stops_are_left_out_with_a_line_for_each_kind(plan):
    content = plan(
        _item(16, A, first=60.0),
        _item(2000),
        _item(93),
        _item(16, B, autoContinue=False),
        _item(2000),
        _item(9999),
    )
    assert waypoint_files.choose(content, "waypoints").notices == [
        "hold of 60 s (item 1) not taken",
        "camera (items 2, 5) not taken",
        "delay (item 3) not taken",
        "stop until the operator goes on (item 4) not taken",
        "command 9999 (item 6) not taken",
    ]


@pytest.mark.parametrize(
    ("items", "speed", "notices"),
    [
        ([_item(178, first=1, second=0.8), _item(16, A), _item(16, B)], 0.8, []),
        ([_item(16, A), _item(178, second=0.8), _item(16, B), _item(16, C)], 0.8, []),
        (
            [_item(16, A), _item(16, B), _item(178, second=0.6), _item(16, C)],
            None,
            ["speed change to 0.6 m/s (item 3) not taken: a mission has one speed"],
        ),
        (
            [_item(178, second=0.8), _item(16, A), _item(16, B), _item(178, second=0.6), _item(16, C)],
            None,
            ["speed change to 0.8 m/s (item 1), to 0.6 m/s (item 4) not taken: a mission has one speed"],
        ),
        ([_item(178, second=-1), _item(16, A), _item(16, B)], None, []),
        ([_item(178, first=2, second=3), _item(16, A)], None, ["climb or descent speed (item 1) not taken"]),
    ],
)
def test_a_speed_counts_if_it_holds_for_the_whole_path(plan, items, speed, notices):
    content = plan(*items)
    assert content.speed == speed
    assert waypoint_files.choose(content, "waypoints").notices == notices


@pytest.mark.parametrize("ends", [20, 21, 17])
def test_a_waypoint_behind_the_end_of_a_mission_is_refused(plan, ends):
    content = plan(_item(16, A), _item(ends, B), _item(16, C))
    with pytest.raises(ConfigurationError, match=r"^item 3: found a waypoint behind item 2"):
        waypoint_files.choose(content, "waypoints")


@pytest.mark.parametrize(
    ("command", "hint"), [(177, "`repeat: N`"), (601, "`repeat: N`"), (192, ""), (33, "")]
)
def test_a_command_that_leads_elsewhere_is_refused_with_what_to_do(plan, command, hint):
    content = plan(_item(16, A), _item(command, frame=2))
    with pytest.raises(ConfigurationError, match=rf"^item 2: found command {command}") as caught:
        waypoint_files.choose(content, "waypoints")
    assert hint in caught.value.expected


@pytest.mark.parametrize("frame", [1, 2, 4, 7, 8, True, "3"])
def test_a_position_that_is_not_in_degrees_is_refused(plan, frame):
    content = plan(_item(16, A), _item(82, (40.0, 25.0), frame=frame))
    with pytest.raises(ConfigurationError, match=r"^item 2: found frame"):
        waypoint_files.choose(content, "waypoints")


@pytest.mark.parametrize(
    "params", [[], None, [0, 0, 0, 0, None, None, 0], [0, 0, 0, 0, 0, 0, 0], [0] * 4 + [10**400, 1]]
)
def test_a_waypoint_without_a_position_is_refused(plan, params):
    content = plan({"command": 16, "params": params})
    with pytest.raises(ConfigurationError, match=r"^item 1: found (no position|latitude 0)"):
        waypoint_files.choose(content, "waypoints")


def test_a_survey_takes_the_polygon_of_the_survey_item_and_waypoints_its_transects(plan):
    content = plan(_survey(), _item(177, frame=2))
    assert waypoint_files.choose(content, "survey").points == [tuple(corner) for corner in RING]
    assert waypoint_files.choose(plan(_survey()), "waypoints").points == [A, B]


def test_several_survey_items_are_chosen_by_name(plan):
    content = plan(_survey(), _survey(polygon=[*RING, [63.1, 10.0]]))
    with pytest.raises(ConfigurationError, match=r"2 polygons \('survey of item 1', 'survey of item 2'\)"):
        waypoint_files.choose(content, "survey")
    assert len(waypoint_files.choose(content, "survey", "survey of item 2").points) == 4


def test_waypoints_in_the_place_of_a_polygon_are_taken_with_a_line(plan):
    points, _, notices, _ = waypoint_files.choose(plan(*(_item(16, p) for p in (A, B, C))), "survey")
    assert points == [A, B, C]
    assert notices == ["the line 'mission' is taken as an outline and closed"]


@pytest.mark.parametrize(
    "pattern", [{"TransectStyleComplexItem": {"Items": None}}, {"TransectStyleComplexItem": 3}]
)
def test_a_pattern_without_its_items_is_refused_as_waypoints_only(plan, pattern):
    content = plan(_survey() | pattern)
    with pytest.raises(ConfigurationError, match=r"^item 1: found a pattern of type 'survey' without items"):
        waypoint_files.choose(content, "waypoints")
    assert len(waypoint_files.choose(content, "survey").points) == 3


def test_a_plan_that_holds_nothing_but_a_fence_gives_a_geofence(plan):
    fence = {"polygons": [{"inclusion": True, "polygon": RING}], "circles": []}
    content = plan(geoFence=fence)
    assert waypoint_files.choose(content, "geofence").points == [tuple(corner) for corner in RING]
    with pytest.raises(ConfigurationError, match=r"no waypoints, .*`geofence: \{file: \.\.\.\}`"):
        waypoint_files.choose(content, "waypoints")


def test_exclusion_fences_circles_and_rally_points_are_reported(plan):
    fence = {
        "polygons": [{"inclusion": False, "polygon": RING}],
        "circles": [{"inclusion": True, "circle": {"center": A, "radius": 100}}],
    }
    content = plan(_item(16, A), _item(16, B), geoFence=fence, rallyPoints={"points": [[*A, 0]]})
    assert content.fences == []
    assert waypoint_files.choose(content, "waypoints").notices == [
        "1 exclusion fence(s) not taken: the geofence of a mission is one polygon",
        "1 circular fence(s) not taken: the geofence of a mission is one polygon",
        "1 rally point(s) not taken",
    ]


def test_a_plan_without_a_fence_is_no_geofence(plan):
    with pytest.raises(ConfigurationError, match="no area, expected an inclusion fence"):
        waypoint_files.choose(plan(_item(16, A), _item(16, B), _item(177, frame=2)), "geofence")


def test_an_old_plan_keeps_positions_beside_the_parameters_and_has_one_fence(plan):
    items = [
        {"command": 16, "frame": 3, "params": [0, 0, 0, None], "coordinate": [*place, 20]} for place in (A, B)
    ]
    content = plan(*items, geoFence={"polygon": RING, "version": 1})
    assert waypoint_files.choose(content, "waypoints").points == [A, B]
    assert len(waypoint_files.choose(content, "geofence").points) == 3


def test_a_mission_file_of_the_time_before_plans_is_read(tmp_path):
    items = [_item(16, place) for place in (A, B)]
    (tmp_path / "a.mission").write_text(
        json.dumps({"items": items, "plannedHomePosition": [*A, 0], "version": 2})
    )
    assert waypoint_files.choose(waypoint_files.read(tmp_path / "a.mission"), "waypoints").points == [A, B]


def test_a_landing_pattern_ends_a_mission(plan):
    landing = {"type": "ComplexItem", "complexItemType": "fwLandingPattern", "landCoordinate": [*A, 0]}
    assert waypoint_files.choose(plan(_item(16, A), _item(16, B), landing), "waypoints").notices == [
        "landing (item 3) not taken"
    ]


def test_fence_corners_in_a_waypoints_file_are_a_fence(tmp_path):
    rows = [f"{k}\t0\t3\t5001\t3\t0\t0\t0\t{lat}\t{lon}\t0\t1" for k, (lat, lon) in enumerate(RING, start=1)]
    (tmp_path / "a.waypoints").write_text(
        "\n".join(["QGC WPL 110", "0\t1\t0\t16\t0\t0\t0\t0\t63\t10\t0\t1", *rows])
    )
    content = waypoint_files.read(tmp_path / "a.waypoints")
    assert [fence.points for fence in content.fences] == [tuple(map(tuple, RING))]
    assert content.notices == ["home position (item 0) not taken"]
