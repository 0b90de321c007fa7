"""Surveys and the other ready-made paths."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.missions.routes import generators, survey
from auv_path_following.missions.routes.smoothing import TOLERANCE, Smoothing

BAY = [(0.0, 0.0), (100.0, 0.0), (100.0, 90.0), (50.0, 30.0), (0.0, 90.0)]


@st.composite
def polygons(draw: st.DrawFn) -> list[tuple[float, float]]:
    """Star-shaped, with bays."""
    n = draw(st.integers(3, 9))
    radii = draw(st.lists(st.floats(20.0, 150.0), min_size=n, max_size=n))
    x, y, a = draw(st.floats(-300.0, 300.0)), draw(st.floats(-300.0, 300.0)), draw(st.floats(0.0, 6.0))
    bearings = [a + 2.0 * math.pi * k / n for k in range(n)]
    return [(x + r * math.cos(b), y + r * math.sin(b)) for r, b in zip(radii, bearings, strict=True)]


@settings(max_examples=30)
@given(polygons(), st.floats(5.0, 60.0), st.floats(-4.0, 4.0), st.randoms(use_true_random=False))
def test_all_of_the_polygon_is_seen(polygon, spacing, chi, random):
    legs = np.array(survey.legs(polygon, spacing, chi))
    axes = np.array([[math.cos(chi), -math.sin(chi)], [math.sin(chi), math.cos(chi)]])
    local = legs @ axes
    assert np.abs(np.diff(local[:, :, 1], axis=1)).max() < 1e-9  # along the course
    across = local[:, 0, 1]
    assert np.all(np.diff(across) > 0.0)
    if len(across) > 1:
        assert np.diff(across).max() <= spacing + 1e-9
    for _ in range(40):  # on the outline: what is inside lies between
        k = random.randrange(len(polygon))
        a, b = np.array(polygon[k]), np.array(polygon[(k + 1) % len(polygon)])
        point = (a + random.random() * (b - a)) @ axes
        leg = int(np.argmin(np.abs(across - point[1])))
        assert abs(across[leg] - point[1]) <= 0.5 * spacing + 1e-9
        low, high = sorted(local[leg, :, 0])
        assert low - 1e-6 <= point[0] <= high + 1e-6


def test_legs_go_to_and_fro_and_run_out():
    legs = survey.legs([(0.0, 0.0), (100.0, 0.0), (100.0, 40.0), (0.0, 40.0)], 20.0, 0.0, run_out=5.0)
    assert legs == [((-5.0, 10.0), (105.0, 10.0)), ((105.0, 30.0), (-5.0, 30.0))]


def test_a_bay_is_crossed_not_left_out():
    legs = survey.legs(BAY, 10.0, 0.0)
    middle = min(legs, key=lambda leg: abs(leg[0][1] - 60.0))
    assert {round(x) for x, _ in middle} == {0, 100}


@pytest.mark.parametrize("spacing", [8.0, 20.0, 45.0])
def test_dubins_turns_keep_every_leg_straight_to_its_end(spacing):
    legs = survey.legs(BAY, spacing, 0.5)
    path = CompositePath(survey.path(legs, Smoothing(kind="dubins", radius=10.0)), TOLERANCE)
    lines = [segment for segment in path.segments if segment.kind == "line"]
    for start, end in legs:
        assert any(
            line.evaluate(0.0)[:2] == pytest.approx(start) and line.evaluate(1.0)[:2] == pytest.approx(end)
            for line in lines
        )
    assert {joint.geometric for joint in path.joints} <= {"G1", "G2"}


@pytest.mark.parametrize("key", ["start_course_deg", "end_course_deg"])
def test_with_dubins_a_survey_has_the_courses_of_its_legs(key):
    legs = survey.legs(BAY, 20.0, 0.5)
    with pytest.raises(
        ConfigurationError, match="found start_course_deg or end_course_deg, expected neither"
    ):
        survey.path(legs, Smoothing(kind="dubins", radius=10.0, **{key: 45.0}))


@pytest.mark.parametrize(
    ("polygon", "spacing", "said"),
    [
        ([(0, 0), (10, 0)], 5.0, "2 corners"),
        ([(0, 0), (10, 10), (20, 20)], 5.0, "corners on one line"),
        (BAY, 1e-4, "legs"),
    ],
)
def test_what_cannot_be_surveyed_is_refused(polygon, spacing, said):
    with pytest.raises(ConfigurationError, match=said):
        survey.legs(polygon, spacing, 0.0)


@pytest.mark.parametrize("separation", [60.0, 61.0, 150.0])
def test_figure_of_eight_is_closed_smooth_and_crosses_in_its_centre(separation):
    segments = generators.figure_of_eight((10.0, 20.0), 30.0, separation, 0.7)
    path = CompositePath([*segments, segments[0]], TOLERANCE)
    assert all(joint.geometric != "G0" for joint in path.joints)
    lines = [segment for segment in segments if segment.kind == "line"]
    assert len(lines) == (0 if separation == 60.0 else 2)
    for line in lines:
        assert line.evaluate(0.5)[:2] == pytest.approx((10.0, 20.0), abs=1e-9)
    turning = [segment.evaluate(0.5).kappa for segment in segments if segment.kind == "arc"]
    assert turning == pytest.approx([1 / 30.0, -1 / 30.0])


@pytest.mark.parametrize("turn", [1, -1])
def test_spiral_keeps_its_spacing(turn):
    path = CompositePath(generators.spiral((5.0, -5.0), 10.0, 15.0, 2.5, 0.3, turn), TOLERANCE)
    assert path.n == 3
    assert {joint.geometric for joint in path.joints} == {"G2"}
    for s, radius in ((0.0, 10.0), (1.0, 25.0), (2.0, 40.0), (3.0, 47.5)):
        p = path.at(s)
        assert math.hypot(p.x - 5.0, p.y + 5.0) == pytest.approx(radius)
    assert math.copysign(1.0, path.at(0.5).kappa) == turn


@pytest.mark.parametrize("turn", [1, -1])
def test_loiter_stays_on_its_circle(turn):
    path = CompositePath(generators.loiter((0.0, 0.0), 25.0, 3, 0.0, turn), TOLERANCE)
    assert path.length == pytest.approx(3 * 2 * math.pi * 25.0)
    assert path.evaluate(0, 0.0)[:2] == pytest.approx((25.0, 0.0))
    assert path.at(1.4).kappa == pytest.approx(turn / 25.0)
