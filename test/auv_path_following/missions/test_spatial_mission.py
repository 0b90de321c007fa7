"""Mission files with depth: every key, every frame, the way back, laps, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from auv_path_following import config_files
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.missions import mission_file

HEAD = "version: 1\nname: test\nthrust: 5\n"
LOITER = "loiter: {centre: [0, 0], radius: 20}\n"
ROUND = 2.0 * math.pi * 20.0


@pytest.fixture
def loaded(tmp_path):
    def load(text: str, frame: str = "ned"):
        (tmp_path / "mission.yaml").write_text(f"{HEAD}frame: {frame}\n{text}", encoding="utf-8")
        return mission_file.load(str(tmp_path / "mission.yaml"))

    return load


def _helix(to: float, more: str) -> str:
    return f"helix: {{centre: [0, 0], radius: 15, from_depth: 5, to_depth: {to}, {more}}}\n"


def depths(mission, per_subpath: int = 41) -> np.ndarray:
    t = np.linspace(0.0, 1.0, per_subpath)
    return np.concatenate([mission.spatial.sampled(i, t).z for i in range(mission.spatial.n)])


def test_a_mission_without_a_depth_is_planar(loaded):
    mission = loaded(LOITER)
    assert (mission.spatial, mission.altitude, mission.max_slope) == (None, None, 0.0)


@pytest.mark.parametrize("name", ["paper_at_depth", "paper_ramps"])
def test_the_paper_path_with_a_depth_is_the_paper_path(name):
    planar, spatial = mission_file.load("paper_composite"), mission_file.load(name)
    assert spatial.path is spatial.spatial.plan
    assert spatial.path.length == pytest.approx(planar.path.length, abs=1e-9)
    assert spatial.spatial.length >= planar.path.length - 1e-9


@pytest.mark.parametrize(
    ("frame", "origin"),
    [("ned", ""), ("enu", ""), ("wgs84", "origin: {latitude_deg: 63, longitude_deg: 10}\n")],
)
def test_a_depth_is_positive_down_in_every_frame(loaded, frame, origin):
    points = "[[63, 10, 5], [63.001, 10, 25]]" if frame == "wgs84" else "[[0, 0, 5], [100, 0, 25]]"
    mission = loaded(f"{origin}waypoints: {{points: {points}, smoothing: {{kind: linear}}}}\n", frame)
    spatial = mission.spatial
    assert (spatial.evaluate(0, 0.0).z, spatial.evaluate(0, 1.0).z) == (5.0, 25.0)
    assert spatial.start_pose.gamma < 0.0  # the bow goes down


def test_one_depth_and_a_profile(loaded):
    assert depths(loaded(f"depth: 10\n{LOITER}")) == pytest.approx(10.0)
    knots = f"[[0, 5], [40, 9], [{ROUND:.3f}, 5]]"
    mission = loaded(f"depth_profile: {{kind: linear, knots: {knots}}}\n{LOITER}")
    assert [joint.z for joint in mission.spatial.joints] == [pytest.approx(9.0)]
    assert depths(mission).max() == pytest.approx(9.0)
    smooth = loaded(f"depth_profile: {{knots: {knots}}}\n{LOITER}")
    assert not any(joint.is_corner for joint in smooth.spatial.joints)


def test_an_altitude_leaves_the_path_planar(loaded):
    mission = loaded(f"altitude: {{above_bottom: 5, min: 3}}\n{LOITER}")
    assert mission.spatial is None
    assert (mission.altitude.above_bottom, mission.altitude.min) == (5.0, 3.0)


def test_limits_of_depth_are_read(loaded):
    limits = "{max_depth: 40, min_altitude: 2, max_slope_deg: 12, depth_error: 3}"
    mission = loaded(f"limits: {limits}\ndepth: 10\n{LOITER}")
    assert (mission.limits.max_depth, mission.limits.min_altitude, mission.limits.depth_error) == (40, 2, 3)
    assert mission.max_slope == pytest.approx(math.radians(12.0))


POINTS = "[[0, 0, 5], [100, 0, 15], [100, 80, 30], [0, 90, 10]]"


@pytest.mark.parametrize("kind", ["circular", "clothoid", "fermat"])
@pytest.mark.parametrize("ramp", ["", "depth_ramp: linear, "])
def test_a_rounded_corner_has_its_depth_in_its_middle(loaded, kind, ramp):
    mission = loaded(f"waypoints: {{points: {POINTS}, {ramp}smoothing: {{kind: {kind}, radius: 10}}}}\n")
    spatial = mission.spatial
    assert [knot.depth for knot in spatial.knots] == [5.0, 15.0, 30.0, 10.0]
    for (north, east), depth in zip([(100, 0), (100, 80)], (15.0, 30.0), strict=True):
        joint = min(spatial.joints, key=lambda j: math.hypot(j.x - north, j.y - east))
        assert joint.z == pytest.approx(depth, abs=1e-6)  # the middle is the nearest joint to the waypoint
    corners = [joint.is_corner for joint in spatial.joints]
    assert any(corners) == bool(ramp)


def test_linear_legs_are_straight_in_three_dimensions(loaded):
    mission = loaded(f"waypoints: {{points: {POINTS}, smoothing: {{kind: linear}}}}\n")
    slopes = [
        (
            tangent_of(mission.spatial.evaluate(i, 0.0)).gamma,
            tangent_of(mission.spatial.evaluate(i, 1.0)).gamma,
        )
        for i in range(3)
    ]
    assert slopes == [
        pytest.approx((g, g))
        for g in (-math.atan2(10, 100), -math.atan2(15, 80), math.atan2(20, math.hypot(100, 10)))
    ]


def test_dubins_passes_its_waypoints_at_their_depths(loaded):
    mission = loaded(f"waypoints: {{points: {POINTS}, smoothing: {{kind: dubins, radius: 10}}}}\n")
    for north, east, depth in ((100, 0, 15.0), (100, 80, 30.0)):
        joint = min(mission.spatial.joints, key=lambda j: math.hypot(j.x - north, j.y - east))
        assert (joint.x, joint.y, joint.z) == pytest.approx((north, east, depth), abs=1e-6)


@pytest.mark.parametrize("kind", ["linear", "circular", "fermat", "dubins"])
def test_a_closed_path_ends_at_the_depth_of_its_start(loaded, kind):
    radius = "" if kind == "linear" else ", radius: 10"
    text = f"waypoints: {{points: {POINTS}, closed: true, smoothing: {{kind: {kind}{radius}}}}}\n"
    once, thrice = loaded(text), loaded(f"repeat: 3\n{text}")
    assert once.spatial.evaluate(0, 0.0).z == once.spatial.evaluate(once.path.n - 1, 1.0).z == 5.0
    assert (thrice.path.n, thrice.once) == (3 * once.path.n, once.path.n)
    assert depths(thrice) == pytest.approx(np.tile(depths(once), 3))
    assert thrice.spatial.length == pytest.approx(3.0 * once.spatial.length)


def test_a_spline_with_depths_is_one_cubic_in_all_coordinates(loaded):
    mission = loaded(f"waypoints: {{points: {POINTS}, smoothing: {{kind: spline}}}}\n")
    assert (mission.path.n, mission.path.segments[0].kind) == (1, "spline")
    way = np.column_stack(mission.spatial.sampled(0, np.linspace(0.0, 1.0, 20001))[:3])
    for point in ((100, 0, 15), (100, 80, 30)):
        assert np.sqrt(((way - point) ** 2).sum(axis=1)).min() < 0.02


def test_segments_beside_a_spline_with_depths_are_level(loaded):
    spline = (
        "spline: {points: [[50, 0, 5], [100, 30, 15], [150, 30, 20]], start_course_deg: 0, end_course_deg: 0}"
    )
    lines = [f"line: {{start: [{x}, {y}], length: 50, course_deg: 0}}" for x, y in ((0, 0), (150, 30))]
    mission = loaded(
        "".join(f"  - {one}\n" for one in (lines[0], spline, lines[1])).join(("segments:\n", ""))
    )
    assert [
        mission.spatial.evaluate(i, t).z for i, t in ((0, 0.0), (0, 1.0), (2, 0.0), (2, 1.0))
    ] == pytest.approx([5.0, 5.0, 20.0, 20.0])
    assert not any(joint.is_corner for joint in mission.spatial.joints)


def test_a_helix_goes_down_to_either_side(loaded):
    more = "slope_deg: 10, run_in: 40, run_out: 30, turn: {}"
    right, left = (loaded(_helix(40, more.format(turn))).spatial for turn in (1, -1))
    for path, side in ((right, 1.0), (left, -1.0)):
        assert path.plan.length == pytest.approx(70.0 + 35.0 / math.tan(math.radians(10.0)))
        middle = path.evaluate(1, 0.5)
        assert tangent_of(middle).gamma == pytest.approx(-math.radians(10.0))
        assert math.copysign(1.0, path.plan.segments[1].evaluate(0.5).kappa) == side
        assert [path.evaluate(i, t).z for i, t in ((0, 0.0), (0, 1.0), (path.n - 1, 0.0))] == pytest.approx(
            [5, 5, 40]
        )
        assert all(joint.geometric != "G0" for joint in path.plan.joints)


@pytest.mark.parametrize(("turns", "subpaths"), [(1e-9, 1), (1.0, 1), (2.0, 2), (2.5, 3)])
def test_a_helix_has_a_subpath_for_each_turn(loaded, turns, subpaths):
    path = loaded(_helix(9, f"turns: {turns:.9f}")).spatial
    assert path.n == subpaths
    assert path.plan.length == pytest.approx(turns * 2.0 * math.pi * 15.0)


@pytest.mark.parametrize(("ramp", "steepest"), [("linear", 10.0), ("smooth", 10.0)])
def test_the_slope_of_a_helix_is_its_steepest(loaded, ramp, steepest):
    mission = loaded(_helix(0, f"slope_deg: 10, depth_ramp: {ramp}"))
    gammas = [
        tangent_of(mission.spatial.evaluate(i, float(t))).gamma
        for i in range(mission.path.n)
        for t in np.linspace(0.0, 1.0, 201)
    ]
    assert math.degrees(max(gammas)) == pytest.approx(steepest, abs=1e-3)  # upwards
    assert min(gammas) >= -1e-9


SURVEY = (
    "survey: {{polygon: [[0, 0], [90, 0], [90, 60], [0, 60]], spacing: 30, heading_deg: 0, smoothing: {},"
    " leg_depths: [5, 9]}}\n"
)


@pytest.mark.parametrize(
    "smoothing", ["{kind: dubins, radius: 6}", "{kind: fermat, radius: 6}", "{kind: linear}"]
)
def test_each_leg_of_a_survey_has_its_depth(loaded, smoothing):
    mission = loaded(SURVEY.format(smoothing))
    spatial = mission.spatial
    for i, segment in enumerate(spatial.plan.segments):
        middle = spatial.evaluate(i, 0.5)
        if (
            segment.kind == "line"
            and abs(math.sin(segment.evaluate(0.5).chi)) < 1e-9
            and 20.0 < middle.x < 70.0
        ):
            assert middle.z == pytest.approx(5.0 if middle.y < 30.0 else 9.0)
    assert not any(abs(joint.gamma_in - joint.gamma_out) > 1e-6 for joint in spatial.joints)


@settings(max_examples=12, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(st.floats(1.0, 60.0), min_size=4, max_size=4),
    st.sampled_from(["linear", "fermat", "dubins", "spline"]),
)
def test_the_way_back_has_the_same_depths(loaded, levels, kind):
    points = [[x, y, z] for (x, y), z in zip(((0, 0), (100, 0), (100, 80), (0, 90)), levels, strict=True)]
    radius = ", radius: 10" if kind in ("fermat", "dubins") else ""
    text = f"waypoints: {{points: {points}, smoothing: {{kind: {kind}{radius}}}}}\n"
    there, back = loaded(text).spatial, loaded(f"reverse: true\n{text}").spatial
    assert there.n == back.n
    for s in np.linspace(0.001, there.n - 0.001, 23):
        i, j = int(s), int(there.n - s)
        one, other = there.evaluate(i, s - i), back.evaluate(j, there.n - s - j)
        assert other[:3] == pytest.approx(one[:3], abs=1e-6)
        assert other[3:6] == pytest.approx([-v for v in one[3:6]], abs=1e-5)


def test_depths_of_points_can_be_ignored(loaded):
    text = "waypoints: {points: [[0, 0, 5], [90, 0]], depths: ignore, smoothing: {kind: linear}}\n"
    assert loaded(text).spatial is None


def test_shipped_missions_in_three_dimensions():
    names = {"paper_at_depth", "paper_deep", "paper_ramps", "helix", "mss_course", "survey_3d"}
    shipped = {name: mission_file.load(name).spatial is not None for name in config_files.shipped("missions")}
    assert {name for name, is_spatial in shipped.items() if is_spatial} == names
