"""Mission files: what is read, and that every wrong one gets a single line that says where and what."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following.missions import mission_file

GOOD = """\
version: 1
name: two legs
frame: ned
thrust: 6.48
segments:
  - line: {start: [0, 0], length: 100, course_deg: 0}
  - arc: {centre: [100, 50], radius: 50, from_deg: -90, to_deg: 0}
"""
LINE = "line: {start: [0, 0], length: 100, course_deg: 0}"
ARC = "arc: {centre: [100, 50], radius: 50, from_deg: -90, to_deg: 0}"
SPIRAL = "fermat: {start: [0, 0], course_deg: 90, scale: 100, theta_end: 0.1, turn: 1}"


def _load(folder: Path, text: str | bytes) -> mission_file.Mission:
    file = folder / "mission.yaml"
    file.write_bytes(text.encode() if isinstance(text, str) else text)
    return mission_file.load(str(file))


def test_shipped_mission_is_read():
    mission = mission_file.load("paper_composite")
    assert mission.name == "paper_composite"
    assert mission.thrust == 6.48
    assert mission.source.name == "paper_composite.yaml"
    assert mission.path.n == 7


@pytest.mark.parametrize("name", config_files.shipped("missions"))
def test_every_shipped_mission_can_be_flown(name):
    assert mission_file.load(name).path.length > 0.0


def test_own_mission_is_read(tmp_path):
    mission = _load(tmp_path, GOOD)
    assert (mission.name, mission.description, mission.thrust) == ("two legs", "", 6.48)
    assert [segment.kind for segment in mission.path.segments] == ["line", "arc"]
    end = mission.path.at(2.0)
    assert (end.x, end.y) == pytest.approx((150.0, 50.0))


@pytest.mark.parametrize(("turn", "east"), [(1, 1.0), (-1, -1.0)])
def test_spirals_turn_to_the_side_that_the_file_says(tmp_path, turn, east):
    head = GOOD.split("segments:")[0]
    spiral = (
        f"segments:\n  - fermat: {{start: [0, 0], course_deg: 0, scale: 100, theta_end: 0.1, turn: {turn}}}\n"
    )
    mirror = spiral.replace("fermat", "fermat_mirrored").replace("start", "end")
    end = _load(tmp_path, head + spiral).path.at(1.0)
    start = _load(tmp_path, head + mirror).path.at(0.0)
    assert end.y * east > 0.0 and end.chi * east > 0.0
    assert start.y * east > 0.0 and start.chi * east < 0.0


def test_a_mission_cannot_be_changed(tmp_path):
    mission = _load(tmp_path, GOOD)
    with pytest.raises(dataclasses.FrozenInstanceError):
        mission.thrust = 1.0


WRONG = {
    "empty file": ("", "", "empty file"),
    "not a mapping": ("- 1\n", "", "a mapping"),
    "not YAML": ("name: [1\n", "line 2", "YAML"),
    "not text": (b"\xff\xfe\x00", "", "cannot be read"),
    "duplicate key": (GOOD + "thrust: 3\n", "line 8", "'thrust'"),
    "unknown version": (GOOD.replace("version: 1", "version: 2"), "version", "found 2, expected 1"),
    "version is a boolean": (GOOD.replace("version: 1", "version: true"), "version", "True"),
    "no version": (GOOD.replace("version: 1\n", ""), "version", "nothing"),
    "unknown key": (GOOD + "gains: 3\n", "gains", "unknown key"),
    "unknown frame": (GOOD.replace("ned", "nwu"), "frame", "'nwu', expected one of 'ned', 'enu' or 'wgs84'"),
    "thrust of zero": (GOOD.replace("6.48", "0"), "thrust", "greater than 0"),
    "thrust backwards": (GOOD.replace("6.48", "-1"), "thrust", "found -1"),
    "thrust is NaN": (GOOD.replace("6.48", ".nan"), "thrust", "finite"),
    "thrust is a text": (GOOD.replace("6.48", "lots"), "thrust", "'lots', expected a number"),
    "thrust is a boolean": (GOOD.replace("6.48", "true"), "thrust", "a number"),
    "thrust is empty": (GOOD.replace("6.48", ""), "", "exactly one of thrust, speed"),
    "name is a number": (GOOD.replace("two legs", "2"), "name", "a text"),
    "no segments": (
        GOOD.split("segments:")[0],
        "",
        "0 kinds of route, expected exactly one of segments, waypoints",
    ),
    "empty path": (GOOD.split("  -")[0].replace("segments:", "segments: []"), "segments", "an empty path"),
    "segments is empty": (GOOD.split("  -")[0], "", "0 kinds of route"),
    "segments is a mapping": (GOOD.split("  -")[0] + "  a: 1\n", "segments", "a list"),
    "segment is a number": (GOOD.replace(ARC, "3"), "segments[1]", "a mapping"),
    "segment is nothing": (
        GOOD.replace(ARC, "{}"),
        "segments[1]",
        "0 kinds of segment, expected exactly one of line",
    ),
    "segment has two kinds": (GOOD.replace(ARC, f"{{{LINE}, {ARC}}}"), "segments[1]", "2 kinds of segment"),
    "unknown segment": (GOOD.replace("arc:", "ark:"), "segments[1].ark", "unknown key"),
    "misspelt key": (GOOD.replace("length", "lenght"), "segments[0].line.lenght", "unknown key"),
    "missing key": (GOOD.replace("length: 100, ", ""), "segments[0].line.length", "nothing"),
    "negative length": (GOOD.replace("length: 100", "length: -100"), "segments[0].line.length", "found -100"),
    "infinite length": (GOOD.replace("length: 100", "length: .inf"), "segments[0].line.length", "finite"),
    "NaN in a point": (GOOD.replace("[0, 0]", "[0, .nan]"), "segments[0].line.start[1]", "finite"),
    "text in a point": (
        GOOD.replace("[0, 0]", "[x, 0]"),
        "segments[0].line.start[0]",
        "'x', expected a number",
    ),
    "short point": (GOOD.replace("[0, 0]", "[0]"), "segments[0].line.start[1]", "one more item"),
    "long point": (GOOD.replace("[0, 0]", "[0, 0, 0]"), "segments[0].line.start", "at most 2"),
    "point is a number": (GOOD.replace("[0, 0]", "0"), "segments[0].line.start", "a list"),
    "radius of zero": (GOOD.replace("radius: 50", "radius: 0"), "segments[1].arc.radius", "greater than 0"),
    "arc without length": (
        GOOD.replace("to_deg: 0", "to_deg: -90"),
        "segments[1].arc",
        "two bearings that differ",
    ),
    "turn of zero": (
        GOOD.replace(ARC, SPIRAL.replace("turn: 1", "turn: 0")),
        "segments[1].fermat.turn",
        "1 or -1",
    ),
    "turn is a boolean": (
        GOOD.replace(ARC, SPIRAL.replace("turn: 1", "turn: true")),
        "segments[1].fermat.turn",
        "True",
    ),
    "scale of zero": (
        GOOD.replace(ARC, SPIRAL.replace("scale: 100", "scale: 0")),
        "segments[1].fermat.scale",
        "greater than 0",
    ),
    "joint that does not meet": (
        GOOD.replace("length: 100", "length: 97.5"),
        "segments[1]",
        "a gap of 2.5 m at joint 1",
    ),
    "joint of 2 mm": (GOOD.replace("length: 100", "length: 100.002"), "segments[1]", "a gap of 0.002 m"),
}


@pytest.mark.parametrize(("text", "key", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_file_gets_one_line_with_file_key_and_reason(tmp_path, text, key, said):
    with pytest.raises(ConfigurationError) as caught:
        _load(tmp_path, text)
    message = str(caught.value)
    place = f"{tmp_path / 'mission.yaml'}: {key}" if key else str(tmp_path / "mission.yaml")
    assert "\n" not in message
    assert message.startswith(place)
    assert said in message
    if key and not key.startswith("line "):
        assert caught.value.where == place


def test_a_gap_below_a_millimetre_is_allowed(tmp_path):
    mission = _load(tmp_path, GOOD.replace("length: 100", "length: 100.0009"))
    assert mission.path.joints[0].gap == pytest.approx(0.0009)


def test_a_missing_mission_names_the_shipped_ones():
    with pytest.raises(ConfigurationError, match=r"nowhere\.yaml: .*paper_composite"):
        mission_file.load("nowhere.yaml")


LINE = (
    "version: 1\nname: x\nframe: enu\nthrust: 6\n"
    "segments: [{line: {start: [0, 0], length: 100, course_deg: 0}}]\n"
)


def test_limits_and_geofence_are_read_in_the_frame_of_the_file(tmp_path):
    file = tmp_path / "m.yaml"
    file.write_text(LINE + "limits: {path_distance: 20}\ngeofence: [[-10, -20], [10, -20], [10, 120]]\n")
    mission = mission_file.load(str(file))
    assert mission.limits.path_distance == 20.0
    assert mission.limits.duration == 0.0
    assert mission.geofence == ((-20.0, -10.0), (-20.0, 10.0), (120.0, 10.0))


@pytest.mark.parametrize(
    ("keys", "where"),
    [
        ("geofence: [[0, 0], [1, 1]]", "geofence"),
        ("limits: {path_distance: -1}", "limits.path_distance"),
        ("limits: {distance: 1}", "limits.distance"),
    ],
)
def test_wrong_limits_are_refused_with_their_key(tmp_path, keys, where):
    file = tmp_path / "m.yaml"
    file.write_text(LINE + keys + "\n")
    with pytest.raises(ConfigurationError, match=rf"m\.yaml: {where}: "):
        mission_file.load(str(file))
