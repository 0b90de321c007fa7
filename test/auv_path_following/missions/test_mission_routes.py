"""Mission files beyond lists of segments: frames, files, repetition, speed, switching, and very long ones."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.missions import mission_file
from auv_path_following.missions.geodesy import Origin, to_geodetic
from auv_path_following.parameters import GuidanceParameters

HEAD = "version: 1\nname: test\nthrust: 5\n"


@pytest.fixture
def loaded(tmp_path):
    def load(text: str, **others):
        (tmp_path / "mission.yaml").write_text(text, encoding="utf-8")
        return mission_file.load(str(tmp_path / "mission.yaml"), **others)

    return load


def _waypoints(points, more: str = "") -> str:
    rows = "".join(f"    - [{a!r}, {b!r}]\n" for a, b in points)
    return f"waypoints:\n  smoothing: {{kind: circular, radius: 10}}\n{more}  points:\n{rows}"


POINTS = [(0.0, 0.0), (100.0, 20.0), (150.0, 120.0), (90.0, 200.0)]


def test_one_course_in_three_frames_is_one_path(loaded):
    origin = Origin(latitude_deg=63.4, longitude_deg=10.4)
    degrees = list(
        zip(*(axis.tolist() for axis in to_geodetic(origin, *zip(*POINTS, strict=True))), strict=True)
    )
    ned = loaded(HEAD + "frame: ned\n" + _waypoints(POINTS))
    enu = loaded(HEAD + "frame: enu\n" + _waypoints([(y, x) for x, y in POINTS]))
    at = "origin: {latitude_deg: 63.4, longitude_deg: 10.4}\n"
    wgs = loaded(HEAD + "frame: wgs84\n" + at + _waypoints(degrees))
    for s in np.linspace(0.0, ned.path.n, 30).tolist():
        assert list(enu.path.at(s)) == pytest.approx(list(ned.path.at(s)), abs=1e-9)
        assert list(wgs.path.at(s)) == pytest.approx(list(ned.path.at(s)), abs=1e-5)
    assert wgs.origin == origin


@pytest.mark.parametrize(
    ("header", "rows", "frame"),
    [("north,east", POINTS, "ned"), ("east,north", [(y, x) for x, y in POINTS], "enu")],
)
def test_waypoints_come_from_a_file(loaded, tmp_path, header, rows, frame):
    (tmp_path / "tracks").mkdir()
    lines = [header, *(f"{a},{b}" for a, b in rows)]
    (tmp_path / "tracks" / "a.csv").write_text("\n".join(lines), encoding="utf-8")
    route = "waypoints: {file: tracks/a.csv, smoothing: {kind: circular, radius: 10}}\n"
    mission = loaded(HEAD + f"frame: {frame}\n" + route)
    assert mission.waypoints == tuple(POINTS)
    assert mission.files == (tmp_path / "tracks" / "a.csv",)


def test_degrees_in_a_file_need_an_origin(loaded, tmp_path):
    (tmp_path / "a.csv").write_text("lat,lon\n63.4,10.4\n63.41,10.4\n", encoding="utf-8")
    route = "waypoints: {file: a.csv, smoothing: {kind: linear}}\n"
    with pytest.raises(ConfigurationError, match=r"mission\.yaml: origin: found nothing"):
        loaded(HEAD + "frame: ned\n" + route)
    mission = loaded(HEAD + "frame: ned\norigin: {latitude_deg: 63.4, longitude_deg: 10.4}\n" + route)
    assert mission.path.length == pytest.approx(1114.4, abs=0.5)


def test_reverse_goes_back_the_same_way(loaded):
    there = loaded(HEAD + "frame: ned\n" + _waypoints(POINTS)).path
    back = loaded(HEAD + "frame: ned\nreverse: true\n" + _waypoints(POINTS)).path
    assert back.length == pytest.approx(there.length)
    for s in np.linspace(0.0, there.n, 20).tolist():
        assert back.at(there.n - s)[:2] == pytest.approx(there.at(s)[:2], abs=1e-9)


def test_a_closed_path_is_repeated(loaded):
    text = (
        HEAD
        + "frame: ned\nrepeat: {}\n"
        + _waypoints(POINTS, "  closed: true\n").replace("{", "{{").replace("}", "}}")
    )
    once, thrice = loaded(text.format(1)), loaded(text.format(3))
    assert (thrice.path.n, thrice.once) == (3 * once.path.n, once.path.n)
    assert thrice.path.length == pytest.approx(3.0 * once.path.length)
    assert thrice.path.distance_to_go(once.path.n, 0.0) == pytest.approx(2.0 * once.path.length)
    assert all(joint.geometric == "G1" for joint in thrice.path.joints)


def test_a_speed_becomes_the_thrust_that_the_vehicle_needs(loaded):
    text = "version: 1\nname: t\nframe: ned\nspeed: 1.5\nloiter: {centre: [0, 0], radius: 20}\n"
    hull = vehicle.load("remus100")
    mission = loaded(text, hull=hull)
    assert hull.speed_at(mission.thrust) == pytest.approx(1.5)
    assert mission.speed == 1.5


@pytest.mark.parametrize(
    ("own", "expected"),
    [
        ("", ("all", 4.0)),
        ("switching: {mode: off}\n", ("off", 4.0)),
        ("switching: {radius: 9}\n", ("all", 9.0)),
        ("switching: {mode: g0, radius: 3}\n", ("g0", 3.0)),
    ],
)
def test_the_missions_switching_goes_before_the_parameters(loaded, own, expected):
    mission = loaded(HEAD + "frame: ned\n" + own + "loiter: {centre: [0, 0], radius: 20}\n")
    guidance = PathFollowerConfig(switching=SwitchingConfig(mode="all", radius=4.0))
    parameters = GuidanceParameters(guidance=guidance)
    switching = parameters.with_mission_overrides(mission).guidance.switching
    assert (switching.mode, switching.radius) == expected
    resolved = GuidanceParameters(guidance=guidance, mission_switching=False)
    assert resolved.with_mission_overrides(mission) == resolved


def test_ten_thousand_waypoints_are_read_and_built_in_seconds(tmp_path):
    file = tmp_path / "survey.yaml"
    points = []
    for k in range(5000):
        points += [(0.0, 40.0 * k), (500.0, 40.0 * k)][:: 1 if k % 2 == 0 else -1]
    file.write_text(HEAD + "frame: ned\n" + _waypoints(points), encoding="utf-8")
    began = time.process_time()
    mission = mission_file.load(str(file))
    assert time.process_time() - began < 15.0  # about 2 s on a quiet machine
    assert len(mission.waypoints) == 10_000
    assert mission.path.n == 4999 * 2 + 9999
    # A track that is 3 m beside its path is so everywhere, and that is measured without looking everywhere.
    x, y, s = mission.path.polyline(25.0)
    i = np.minimum(s.astype(int), mission.path.n - 1)[:2000]
    chi = np.array([mission.path.at(float(at)).chi for at in s[:2000]])
    off = mission.path.distance(x[:2000] - 3.0 * np.sin(chi), y[:2000] + 3.0 * np.cos(chi), i)
    assert off.max() == pytest.approx(3.0, abs=1e-6)
    assert math.isfinite(mission.path.distance_to_go(7, 0.5))
