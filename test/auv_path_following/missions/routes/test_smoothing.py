"""Waypoints to Table 1's five kinds of path: what every one of them has to keep."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.outline import tightest
from auv_path_following.missions.routes.corner_shapes import SHAPES, fermat_curvature, fermat_theta_end
from auv_path_following.missions.routes.smoothing import TOLERANCE, Smoothing, smooth

CONTINUITY = {"linear": "G0", "circular": "G1", "dubins": "G1", "clothoid": "G2", "fermat": "G2"}
RADIUS = 10.0
#: A step of course (rad) or curvature (1/m) below this is none; far below what a joint's class allows.
STEP = 1e-8
ROUNDED = sorted(SHAPES)
KINDS = sorted(CONTINUITY)


def smoothing(kind: str, radius: float = RADIUS) -> Smoothing:
    return Smoothing(kind=kind, radius=None if kind == "linear" else radius)


@st.composite
def courses(draw: st.DrawFn) -> list[tuple[float, float]]:
    """Random waypoints with room for a corner of RADIUS of any kind."""
    n = draw(st.integers(1, 5))
    turns = draw(st.lists(st.floats(0.02, 2.3), min_size=n, max_size=n))
    sides = draw(st.lists(st.sampled_from([1.0, -1.0]), min_size=n, max_size=n))
    extra = draw(st.lists(st.floats(1.0, 80.0), min_size=n + 1, max_size=n + 1))
    reach = [RADIUS * max(shape.reach(turn) for shape in SHAPES.values()) for turn in turns]
    x, y = draw(st.floats(-500.0, 500.0)), draw(st.floats(-500.0, 500.0))
    chi = draw(st.floats(-3.0, 3.0))
    points = [(x, y)]
    for k in range(n + 1):
        length = (reach[k - 1] if k else 0.0) + extra[k] + (reach[k] if k < n else 0.0)
        x, y = x + length * math.cos(chi), y + length * math.sin(chi)
        points.append((x, y))
        if k < n:
            chi += sides[k] * turns[k]
    return points


@settings(max_examples=60)
@given(courses(), st.sampled_from(KINDS))
def test_ends_and_joints_meet_and_the_claimed_continuity_holds(points, kind):
    path = CompositePath(smooth(points, smoothing(kind)), TOLERANCE)
    first, last = path.evaluate(0, 0.0), path.evaluate(path.n - 1, 1.0)
    assert (first.x, first.y) == pytest.approx(points[0], abs=TOLERANCE)
    assert (last.x, last.y) == pytest.approx(points[-1], abs=TOLERANCE)
    for joint in path.joints:
        assert joint.gap <= TOLERANCE
        if CONTINUITY[kind] != "G0":
            assert abs(joint.angle_step) < STEP
        if CONTINUITY[kind] == "G2":
            assert abs(joint.curvature_step) < STEP
    if kind == "linear":
        assert {joint.geometric for joint in path.joints} <= {"G0"}


@settings(max_examples=40)
@given(courses(), st.sampled_from(ROUNDED))
def test_no_corner_is_tighter_than_asked_for_and_the_tightest_is_just_that(points, kind):
    for segment in smooth(points, smoothing(kind)):
        _, kappa = tightest(segment)
        if segment.kind == "line":
            assert kappa == 0.0
        else:
            assert abs(kappa) == pytest.approx(1.0 / RADIUS, rel=1e-6)


@settings(max_examples=40)
@given(courses(), st.sampled_from(ROUNDED), st.floats(0.5, 1.0))
def test_a_distance_is_where_the_legs_are_left(points, kind, share):
    legs = [math.dist(a, b) for a, b in itertools.pairwise(points)]
    distance = 0.45 * share * min(legs)
    segments = smooth(points, Smoothing(kind=kind, distance=distance))
    before = segments[0].evaluate(1.0)
    assert math.dist((before.x, before.y), points[1]) == pytest.approx(distance, abs=1e-8)


def _moved(points, angle, mirror):
    cos, sin = math.cos(angle), math.sin(angle)
    side = -1.0 if mirror else 1.0
    return [(x * cos - side * y * sin, x * sin + side * y * cos) for x, y in points]


@settings(max_examples=40)
@given(courses(), st.sampled_from(KINDS), st.floats(-3.0, 3.0), st.booleans())
def test_turned_or_mirrored_waypoints_give_the_turned_or_mirrored_path(points, kind, angle, mirror):
    path = CompositePath(smooth(points, smoothing(kind)), TOLERANCE)
    other = CompositePath(smooth(_moved(points, angle, mirror), smoothing(kind)), TOLERANCE)
    assert other.length == pytest.approx(path.length, abs=1e-6)
    if kind == "dubins":  # of two equally short words another one may be chosen: compare what they reach
        return
    assert other.n == path.n
    for s in np.linspace(0.0, path.n, 23).tolist():
        here, there = path.at(s), other.at(s)
        ((x, y),) = _moved([(here.x, here.y)], angle, mirror)
        assert (there.x, there.y) == pytest.approx((x, y), abs=1e-6)


@settings(max_examples=30)
@given(courses())
def test_dubins_passes_every_waypoint_half_way_round_its_corner(points):
    path = CompositePath(smooth(points, smoothing("dubins")), TOLERANCE)
    starts = [path.evaluate(i, 0.0) for i in range(path.n)]
    for k in range(1, len(points) - 1):
        (x0, y0), (x1, y1), (x2, y2) = points[k - 1 : k + 2]
        chi_in, chi_out = math.atan2(y1 - y0, x1 - x0), math.atan2(y2 - y1, x2 - x1)
        here = [p for p in starts if math.hypot(p.x - x1, p.y - y1) < 1e-6]
        assert here
        middle = chi_in + 0.5 * wrap(chi_out - chi_in)
        assert any(abs(wrap(p.chi - middle)) < 1e-6 for p in here)


def test_dubins_keeps_the_courses_at_its_ends():
    dubins = Smoothing(kind="dubins", radius=10.0, start_course_deg=-90.0, end_course_deg=135.0)
    path = CompositePath(smooth([(0, 0), (80, 20), (120, 90)], dubins))
    assert path.start_pose[2] == pytest.approx(-math.pi / 2)
    assert path.evaluate(path.n - 1, 1.0).chi == pytest.approx(math.radians(135.0))


@pytest.mark.parametrize("kind", KINDS)
def test_a_closed_path_ends_where_it_starts_and_rounds_every_corner(kind):
    square = [(0, 0), (100, 0), (100, 100), (0, 100)]
    path = CompositePath(smooth(square, smoothing(kind), closed=True), TOLERANCE)
    start, end = path.evaluate(0, 0.0), path.evaluate(path.n - 1, 1.0)
    assert (end.x, end.y) == pytest.approx((start.x, start.y), abs=TOLERANCE)
    middles = (np.arange(2000) + 0.5) / 2000
    points = [segment.evaluate(middles) for segment in path.segments]
    turned = sum(float(np.mean(p.kappa * p.speed)) for p in points)
    assert turned == pytest.approx(0.0 if kind == "linear" else 2.0 * math.pi, abs=1e-5)


def test_waypoints_in_line_make_no_corner():
    path = CompositePath(smooth([(0, 0), (50, 0), (100, 0)], smoothing("fermat")), TOLERANCE)
    assert [segment.kind for segment in path.segments] == ["line", "line"]
    assert path.joints[0].geometric == "G2"


def test_legs_that_just_fit_leave_no_line_between():
    # Two right angles of radius 10 on a leg of 20 m: a half circle.
    path = CompositePath(smooth([(0, 0), (50, 0), (50, 20), (0, 20)], smoothing("circular")), TOLERANCE)
    assert [segment.kind for segment in path.segments] == ["line", "arc", "arc", "line"]


def test_the_papers_spirals_are_found_again():
    """Table 3: a corner of 45 degrees at (-20, 220), left 45.0434 m before it."""
    points = [(-20, 420), (-20, 220), (180, 20)]
    _, spiral, mirror, _ = smooth(points, Smoothing(kind="fermat", distance=45.0434))
    assert spiral.evaluate(0.0)[:2] == pytest.approx((-20.0, 265.0434))
    assert mirror.evaluate(1.0)[:2] == pytest.approx((11.8505, 188.1495), abs=1e-4)
    assert spiral.length == pytest.approx(43.361, abs=1e-3)
    assert fermat_theta_end(math.pi / 4) == pytest.approx(0.1329, abs=1e-4)
    assert 1.0 / abs(spiral.evaluate(1.0).kappa) == pytest.approx(58.45, abs=5e-3)


@given(st.floats(0.01, 3.0))
def test_the_spirals_angle_solves_its_equation(turn):
    theta = fermat_theta_end(turn)
    assert theta + math.atan(2.0 * theta) == pytest.approx(turn / 2.0, rel=1e-12)
    assert fermat_curvature(theta) > 0.0


@pytest.mark.parametrize(
    ("points", "keys", "where", "said"),
    [
        ([(0, 0), (30, 0), (30, 30)], {"kind": "circular", "radius": 40}, "points[1]", "10.000 m too much"),
        (
            [(0, 0), (30, 0), (30, 40), (0, 40)],
            {"kind": "circular", "radius": 25},
            "points[2]",
            "10.000 m too much",
        ),
        ([(0, 0), (30, 0), (0, 1)], {"kind": "fermat", "radius": 10}, "points[1]", "does not fit"),
        ([(0, 0), (30, 0), (0, 0)], {"kind": "clothoid", "radius": 10}, "points[1]", "straight back"),
        ([(0, 0), (30, 0), (30, 0)], {"kind": "linear"}, "points[2]", "the same place as points[1]"),
        ([(0, 0)], {"kind": "linear"}, "points", "at least 2"),
        ([(0, 0), (1, 1)], {"kind": "fermat"}, "smoothing", "neither radius nor distance"),
        (
            [(0, 0), (1, 1)],
            {"kind": "fermat", "radius": 1, "distance": 1},
            "smoothing",
            "both radius and distance",
        ),
        ([(0, 0), (1, 1)], {"kind": "dubins"}, "smoothing", "no radius"),
        ([(0, 0), (1, 1)], {"kind": "linear", "radius": 1}, "smoothing", "neither for linear"),
        ([(0, 0), (1, 1)], {"kind": "linear", "end_course_deg": 1}, "smoothing", "dubins and spline"),
    ],
)
def test_what_does_not_fit_says_where_and_by_how_much(points, keys, where, said):
    with pytest.raises(ConfigurationError) as caught:
        smooth(points, Smoothing(**{k: float(v) if isinstance(v, int) else v for k, v in keys.items()}))
    assert caught.value.where == where
    assert said in str(caught.value)
