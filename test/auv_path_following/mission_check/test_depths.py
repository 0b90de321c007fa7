"""Depths that the check refuses, each with its place and the length that would do; depths that it passes."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SpatialCurrent
from auv_path_following import vehicle
from auv_path_following.curves.spatial.spatial_point import curvatures_of, tangent_of
from auv_path_following.guidance.switching import SwitchingConfig
from auv_path_following.mission_check.depth_survey import survey_of
from auv_path_following.mission_check.depths import bounds_of, through_water
from auv_path_following.mission_check.flyable import check, refusals
from auv_path_following.missions import mission_file

DIVER = vehicle.load("remus100_6dof")
HEAD = "version: 1\nname: test\nframe: ned\n"
LEG = "segments: [{line: {start: [0, 0], length: 400, course_deg: 0}}]\n"


@pytest.fixture
def loaded(tmp_path):
    def load(text: str, thrust: float = 6.48):
        (tmp_path / "mission.yaml").write_text(f"{HEAD}thrust: {thrust}\n{text}", encoding="utf-8")
        return mission_file.load(str(tmp_path / "mission.yaml"), DIVER)

    return load


def profile(knots: str, kind: str = "smooth", more: str = "") -> str:
    return f"{more}depth_profile: {{kind: {kind}, knots: {knots}}}\n{LEG}"


def refused(mission, hull=DIVER) -> list[str]:
    return [str(finding) for finding in check(mission, hull).refusals]


def test_a_gentle_profile_has_no_fault(loaded):
    findings = check(loaded(profile("[[0, 0], [200, 30], [400, 0]]")), DIVER)
    assert findings.refusals == findings.warnings == ()
    assert findings.duration > 400.0 / findings.speed  # the way down and up is longer than its plan


@pytest.mark.parametrize("text", ["depth: 5\n", "altitude: {above_bottom: 5}\n"])
def test_a_vehicle_without_stern_planes_is_refused(loaded, text):
    (found,) = refused(loaded(text + LEG), vehicle.load("remus100"))
    assert found.startswith("vehicle REMUS 100: found no stern planes for a mission")


def test_a_slope_is_refused_with_a_length_that_would_do(loaded):
    (found,) = refused(loaded(profile("[[0, 5], [60, 30], [400, 5]]")))
    assert "30.0 m along the path, at a depth of 17.5 m: found a slope of 38.0 deg down" in found
    assert "at most 25.0 deg: the pitch of up to 30.0 deg at 2.00 m/s less 5" in found
    length = float(re.search(r"from 5 to 30 m needs ([\d.]+) m of path, now 60.0 m", found)[1])
    assert refused(loaded(profile(f"[[0, 5], [{length + 0.05}, 30], [400, 5]]"))) == []
    (still,) = refused(loaded(profile(f"[[0, 5], [{length - 0.5}, 30], [400, 5]]")))
    assert "a slope of 25" in still


def test_slower_is_flatter(loaded):
    knots = "[[0, 5], [120, 30], [400, 5]]"
    assert refused(loaded(profile(knots))) == []
    (found,) = refused(loaded(profile(knots), thrust=2.0))
    assert "a slope of 21.3 deg down" in found and "at 1.11 m/s" in found


def test_the_missions_own_slope_counts(loaded):
    knots = "[[0, 5], [120, 30], [400, 5]]"
    (found,) = refused(loaded(profile(knots, more="limits: {max_slope_deg: 15}\n")))
    assert "expected at most 15.0 deg, limits.max_slope_deg; the ramp from 5 to 30 m needs" in found


def test_a_vertical_radius_is_refused_with_a_length_that_would_do(loaded):
    (found,) = refused(loaded(profile("[[0, 5], [13, 7], [400, 7]]")))
    least = bounds_of(loaded(profile("[[0, 5], [400, 5]]")), DIVER, DIVER.speed_at(6.48)).radius
    assert "found a vertical radius of 1" in found and f"expected at least {least:.1f} m" in found
    length = float(re.search(r"needs ([\d.]+) m of path, now 13.0 m", found)[1])
    assert refused(loaded(profile(f"[[0, 5], [{length + 0.05}, 7], [400, 7]]"))) == []
    assert least == pytest.approx(20.0, abs=1.0)  # 2 m/s at half of 0.2 rad/s


@pytest.mark.parametrize(
    ("knots", "limits", "message"),
    [
        ("[[0, 60], [300, 101], [400, 101]]", "", "expected at most 100 m, depth.max of REMUS 100 (six"),
        ("[[0, 5], [300, 41], [400, 41]]", "limits: {max_depth: 40}\n", "at most 40 m, limits.max_depth"),
        ("[[0, 5], [200, 0.2], [400, 5]]", "", "found a depth of 0.20 m between start and end, expected"),
        (
            "[[0, 0.2], [400, 0.2]]",
            "",
            "found a depth of 0.20 m between start and end, expected at least 0.5",
        ),
        ("[[0, 0], [50, 0], [200, 10], [400, 10]]", "", "found a depth of 0.00 m between start and end"),
    ],
)
def test_depths_out_of_range_are_refused_with_their_place(loaded, knots, limits, message):
    (found,) = refused(loaded(profile(knots, more=limits)))
    assert message in found and "m along the path" in found


def test_start_and_end_may_be_at_the_surface(loaded):
    assert refused(loaded(profile("[[0, 0], [200, 20], [400, 0]]", "linear"))) == []
    assert refused(mission_file.load("mss_course", DIVER)) == []


def test_a_spline_between_points_is_judged(loaded):
    points = "[[0, 0, 1], [60, 0, 2], [120, 0, 1.5], [180, 0, 40], [400, 0, 41]]"
    found = refused(loaded(f"waypoints: {{points: {points}, smoothing: {{kind: spline}}}}\n"))
    assert any("found a slope of" in one and "points further apart would do" in one for one in found)


def test_too_slow_for_the_planes_is_refused(loaded):
    (found,) = refused(loaded(f"depth: 5\n{LEG}", thrust=1.0))
    assert "speed: found 0.79 m/s through the water, expected at least 0.9 m/s" in found


def test_an_altitude_below_the_limit_is_refused(loaded):
    (found,) = refused(loaded(f"altitude: {{above_bottom: 4}}\nlimits: {{min_altitude: 5}}\n{LEG}"))
    assert "limits.min_altitude: found 5 m with an altitude of 4 m" in found


def _corners(mission, mode: str) -> list[str]:
    warnings = check(mission, DIVER, switching=SwitchingConfig(mode=mode)).warnings
    return [str(warning) for warning in warnings if "vertical corner" in warning.found]


def test_vertical_corners_are_warned_of(loaded):
    mild = loaded(profile("[[0, 5], [200, 25], [400, 25]]", "linear"))
    assert _corners(mild, "g0") == []
    (found,) = _corners(mild, "off")
    assert "joint 1 at north 200.0, east 0.0, at a depth of 25.0 m: found a vertical corner of 6 deg" in found
    sharp = loaded(profile("[[0, 5], [100, 45], [200, 5], [400, 5]]", "linear"))
    (found,) = _corners(sharp, "g0")
    assert "2 vertical corners, the sharpest one of 44 deg" in found
    assert _corners(loaded(profile("[[0, 5], [200, 25], [400, 25]]")), "off") == []


def test_a_helix_does_not_cross_itself_but_a_circle_at_one_depth_does():
    helix = check(mission_file.load("helix", DIVER), DIVER)
    assert helix.warnings == ()
    paper = check(mission_file.load("paper_at_depth", DIVER), DIVER)
    assert any("crosses itself" in warning.found for warning in paper.warnings)


def test_a_vehicle_with_measured_numbers_is_judged():
    hull = vehicle.load("mss_remus100")
    mission = mission_file.load("paper_ramps", hull)
    bounds = bounds_of(mission, hull, 2.0)
    assert math.isfinite(bounds.radius) and bounds.slope > 0.0


def test_every_refusal_is_a_line_and_none_advises_to_fly_it(loaded):
    mission = loaded(profile("[[0, 60], [80, 102], [400, 60]]"))
    findings = check(mission, DIVER)
    lines = [str(error) for error in refusals(mission, findings, "advice")]
    assert len(lines) == len(findings.refusals) == 2
    assert all(line.startswith(str(mission.source)) and "advice" not in line for line in lines)
    assert isinstance(refusals(mission, findings, "")[0], ConfigurationError)


@pytest.mark.parametrize("name", ["paper_ramps", "helix"])
def test_the_survey_is_the_path(name):
    path = mission_file.load(name, DIVER).spatial
    survey = survey_of(path, path.n)
    assert survey.way[-1] == pytest.approx(path.plan.length)
    assert np.all(np.diff(survey.way) >= -1e-9)
    for k in range(0, len(survey.t), 17):
        point = path.evaluate(int(survey.i[k]), float(survey.t[k]))
        assert survey.z[k] == pytest.approx(point.z)
        assert survey.gamma[k] == pytest.approx(tangent_of(point).gamma, abs=1e-9)
        assert survey.bend[k] == pytest.approx(curvatures_of(point)[2], abs=1e-9)


@given(
    gamma=st.floats(-1.2, 1.2),
    speed=st.floats(0.5, 4.0),
    share=st.floats(1e-9, 0.5) | st.floats(-0.5, -1e-9),
)
def test_the_elevation_through_the_water_holds_that_of_the_path(gamma, speed, share):
    sinking = share * speed
    (pitch,) = through_water(np.array([gamma]), speed, sinking)
    ahead, down = speed * math.cos(pitch), -speed * math.sin(pitch) + sinking
    assert math.atan2(-down, ahead) == pytest.approx(gamma, abs=1e-9)
    assert (pitch > gamma) == (sinking > 0.0), "water that sinks is climbed against"


@pytest.mark.parametrize(("way", "sinking"), [("down", -0.1), ("up", 0.1)])
def test_a_vertical_current_against_a_ramp_needs_more_pitch(loaded, way, sinking):
    near, far = (5, 30) if way == "down" else (30, 5)
    mission = loaded(profile(f"[[0, {near}], [105, {far}], [400, {far}]]"))
    assert refused(mission) == refused_in(mission, -sinking) == []
    (found,) = refused_in(mission, sinking)
    pitch = 24.0 + math.degrees(0.1 / 2.0)
    sign = "-" if way == "down" else ""
    assert re.search(rf"a slope of 2[34]\.\d deg {way}, a pitch of {sign}2[67]\.\d deg in 0\.1 m/s", found)
    assert float(re.search(r"a pitch of -?([\d.]+) deg", found)[1]) == pytest.approx(pitch, abs=0.8)
    assert "at most 25.0 deg: the pitch of up to 30.0 deg" in found


def refused_in(mission, sinking) -> list[str]:
    findings = check(mission, DIVER, SpatialCurrent(0.0, 0.0, sinking))
    return [str(finding) for finding in findings.refusals]
