"""The path on a chart comes back as the path."""

from __future__ import annotations

import json
from xml.etree import ElementTree

import numpy as np
import pytest

from auv_path_following.missions import mission_file, waypoint_files
from auv_path_following.missions.geodesy import to_ned
from auv_sim.checks.mission_check import chart


@pytest.mark.parametrize("suffix", [".geojson", ".kml"])
def test_what_is_exported_lies_on_the_path(tmp_path, suffix):
    mission = mission_file.load("survey_wgs84")
    target = tmp_path / f"path{suffix}"
    chart.export(mission, target)
    # One line among many points: the line is taken.
    line = waypoint_files.choose(waypoint_files.read(target), "waypoints")
    x, y = to_ned(mission.origin, *zip(*line.points, strict=True))
    ends = [mission.path.at(0.0), mission.path.at(float(mission.path.n))]
    assert (x[0], y[0], x[-1], y[-1]) == pytest.approx((ends[0].x, ends[0].y, ends[1].x, ends[1].y), abs=2e-3)
    px, py, _ = mission.path.polyline(0.5)
    for k in range(0, len(x), 7):
        assert np.hypot(px - x[k], py - y[k]).min() < 0.3
    length = float(np.hypot(np.diff(x), np.diff(y)).sum())
    assert length == pytest.approx(mission.path.length, rel=2e-3)


@pytest.mark.parametrize("suffix", [".geojson", ".kml"])
@pytest.mark.parametrize(
    ("points", "crossings"),
    [("[[0, -300], [200, 400], [300, -500]]", 2), ("[[0, -300], [0, 0], [200, 400]]", 1)],
)
def test_a_path_over_the_antimeridian_is_cut_there_and_read_back_as_one(tmp_path, suffix, points, crossings):
    origin = "origin: {latitude_deg: -17.0, longitude_deg: 180.0}"
    route = f"waypoints: {{points: {points}, smoothing: {{kind: linear}}}}"
    (tmp_path / "m.yaml").write_text(f"version: 1\nname: dateline\nframe: ned\nspeed: 1\n{origin}\n{route}\n")
    mission = mission_file.load(str(tmp_path / "m.yaml"))
    chart.export(mission, tmp_path / f"path{suffix}")
    text = (tmp_path / f"path{suffix}").read_text()
    assert text.count("LineString") == {".geojson": 1, ".kml": 4}[suffix] + (suffix == ".kml") * 2 * (
        crossings - 1
    )
    line = waypoint_files.choose(waypoint_files.read(tmp_path / f"path{suffix}"), "waypoints").points
    assert sum(abs(longitude) == 180.0 for _, longitude in line) == crossings
    x, y = to_ned(mission.origin, *zip(*line, strict=True))
    assert float(np.hypot(np.diff(x), np.diff(y)).sum()) == pytest.approx(mission.path.length, abs=0.01)


@pytest.mark.parametrize("suffix", [".geojson", ".kml"])
@pytest.mark.parametrize("kind", ["linear", "fermat, radius: 12", "spline"])
def test_depths_come_back_as_depths(tmp_path, suffix, kind):
    origin = "origin: {latitude_deg: 63.0, longitude_deg: 10.0}"
    route = f"waypoints: {{points: [[0, 0, 5], [200, 0, 30], [250, 90, 8]], smoothing: {{kind: {kind}}}}}"
    (tmp_path / "m.yaml").write_text(f"version: 1\nname: deep\nframe: ned\nspeed: 1\n{origin}\n{route}\n")
    mission = mission_file.load(str(tmp_path / "m.yaml"))
    chart.export(mission, tmp_path / f"path{suffix}")
    line = waypoint_files.choose(waypoint_files.read(tmp_path / f"path{suffix}"), "waypoints")
    x, y = to_ned(mission.origin, *zip(*line.points, strict=True))
    path = mission.spatial
    for i in range(path.n):
        for point in (path.evaluate(i, 0.0), path.evaluate(i, 1.0)):
            k = int(np.argmin(np.hypot(x - point.x, y - point.y)))
            assert line.depths[k] == pytest.approx(point.z, abs=2e-3)
    chords = np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2 + np.diff(line.depths) ** 2)
    assert chords.sum() == pytest.approx(path.length, rel=2e-3)


def test_waypoints_and_joints_have_names(tmp_path):
    mission = mission_file.load("survey_wgs84")
    chart.export(mission, tmp_path / "path.geojson")
    features = json.loads((tmp_path / "path.geojson").read_text(encoding="utf-8"))["features"]
    names = [feature["properties"]["name"] for feature in features]
    assert names[0] == "survey_wgs84"
    assert sum(name.startswith("waypoint") for name in names) == len(mission.waypoints)
    assert sum(name.startswith("joint") for name in names) == mission.path.n - 1
    chart.export(mission, tmp_path / "path.kml")
    marks = ElementTree.parse(tmp_path / "path.kml").getroot().findall(".//{*}Placemark/{*}name")
    assert [mark.text for mark in marks] == names
