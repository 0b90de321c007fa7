"""Missions of sizes that no vehicle flies are refused at once, in one line."""

from __future__ import annotations

import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.missions import mission_file

HEAD = "version: 1\nname: large\nframe: {frame}\nthrust: 6\n"
LINEAR = "smoothing: {kind: linear}"
WRONG = {
    "ned": (
        "ned",
        f"waypoints: {{points: [[0, 0], [1e200, 5]], {LINEAR}}}",
        "waypoints.points[1][0]: found 1e+200",
    ),
    "enu": (
        "enu",
        f"waypoints: {{points: [[0, 0], [5, -2e7]], {LINEAR}}}",
        "waypoints.points[1][1]: found -2e+07",
    ),
    "length": (
        "ned",
        "segments: [{line: {start: [0, 0], length: 1e300, course_deg: 0}}]",
        "segments[0].line.length: found 1e+300, expected at most 1e+07",
    ),
    "angle": (
        "ned",
        "segments: [{arc: {centre: [0, 0], radius: 9, from_deg: 0, to_deg: 1e300}}]",
        "segments[0].arc.to_deg: found 1e+300",
    ),
    "geofence": (
        "ned",
        f"geofence: [[0, 0], [1e9, 0], [0, 1]]\nwaypoints: {{points: [[0, 0], [5, 5]], {LINEAR}}}",
        "geofence[1][0]: found 1e+09",
    ),
    "spacing": (
        "ned",
        f"survey: {{polygon: [[0, 0], [9, 0], [9, 9]], heading_deg: 0, spacing: 1e-320, {LINEAR}}}",
        "survey: found numbers that no path can be computed from",
    ),
    "file": (
        "ned",
        f"waypoints: {{file: far.csv, {LINEAR}}}",
        "far.csv: point 2: found north 1e+200, east 4",
    ),
    "many": (
        "ned",
        f"waypoints: {{file: many.csv, {LINEAR}}}",
        "expected at most 50000",
    ),
    "repeat": (
        "ned",
        "repeat: 1000\nloiter: {centre: [0, 0], radius: 20, turns: 1000}",
        "repeat: found 1000000 subpaths in all",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_too_large_too_small_too_many(tmp_path, name):
    frame, route, said = WRONG[name]
    (tmp_path / "far.csv").write_text("north,east\n1,2\n1e200,4\n", encoding="utf-8")
    if name == "many":
        rows = "".join(f"{k},0\n" for k in range(50_001))
        (tmp_path / "many.csv").write_text("north,east\n" + rows, encoding="utf-8")
    file = tmp_path / "mission.yaml"
    file.write_text(HEAD.format(frame=frame) + route + "\n", encoding="utf-8")
    with pytest.raises(ConfigurationError) as caught:
        mission_file.load(str(file))
    assert said in str(caught.value)


def test_a_link_that_leads_out_of_the_folder_is_refused_without_its_content(tmp_path):
    (tmp_path / "secret").write_text("root:x:0:0\n", encoding="utf-8")
    folder = tmp_path / "missions"
    folder.mkdir()
    (folder / "far.csv").symlink_to(tmp_path / "secret")
    (folder / "kept.csv").write_text("north,east\n0,0\n9,0\n", encoding="utf-8")
    (folder / "near.csv").symlink_to("kept.csv")
    file = folder / "mission.yaml"
    text = HEAD.format(frame="ned") + f"waypoints: {{file: far.csv, {LINEAR}}}\n"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigurationError, match="not a link that leads out of it") as caught:
        mission_file.load(str(file))
    assert "root:x" not in str(caught.value) and "secret" not in str(caught.value)
    file.write_text(text.replace("far.csv", "near.csv"), encoding="utf-8")
    assert mission_file.load(str(file)).path.length == 9.0
