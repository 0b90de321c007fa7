"""The composite path: one scalar s, joints, what is left, and how far a track is from it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.missions import mission_file

PATH = mission_file.load("paper_composite").path


def test_paper_path_has_seven_subpaths_and_its_length():
    assert [segment.kind for segment in PATH.segments] == [
        "line", "line", "arc", "line", "fermat", "fermat_mirrored", "line",
    ]  # fmt: skip
    assert PATH.n == 7
    assert PATH.length == pytest.approx(1276.48, abs=0.005)
    assert PATH.segments[4].length == pytest.approx(43.361, abs=5e-4)
    assert PATH.segments[5].length == pytest.approx(43.361, abs=5e-4)


def test_paper_path_joints_are_as_smooth_as_the_paper_says():
    assert [joint.index for joint in PATH.joints] == [1, 2, 3, 4, 5, 6]
    assert [joint.geometric for joint in PATH.joints] == ["G0", "G1", "G1", "G2", "G2", "G2"]
    assert [joint.parametric for joint in PATH.joints] == ["C0", "C0", "C0", "C0", "C1", "C0"]
    assert PATH.joints[0].angle_step == pytest.approx(math.pi / 4.0)
    assert PATH.joints[1].curvature_step == pytest.approx(0.01)
    assert PATH.joints[2].curvature_step == pytest.approx(-0.01)


def test_paper_path_joints_meet():
    assert max(joint.gap for joint in PATH.joints) <= 1e-9
    assert (PATH.joints[5].x, PATH.joints[5].y) == pytest.approx((11.8505, 188.1495), abs=5e-5)


def test_paper_path_is_tightest_where_the_spirals_meet():
    t = np.linspace(0.0, 1.0, 2001)
    radius = 1.0 / np.abs(PATH.segments[4].evaluate(t[1:]).kappa)
    assert radius.argmin() == len(radius) - 1
    assert 1.0 / PATH.evaluate(4, 1.0).kappa == pytest.approx(58.45, abs=0.005)
    assert 1.0 / PATH.evaluate(5, 0.0).kappa == pytest.approx(58.45, abs=0.005)


def test_start_pose_is_the_first_point():
    assert PATH.start_pose == pytest.approx((-20.0, 20.0, math.pi / 4.0))


@pytest.mark.parametrize(
    ("s", "i", "t"), [(0.0, 0, 0.0), (0.5, 0, 0.5), (1.0, 1, 0.0), (6.25, 6, 0.25), (7.0, 6, 1.0)]
)
def test_at_takes_the_global_scalar(s, i, t):
    assert PATH.at(s) == PATH.evaluate(i, t)


def test_at_holds_s_within_the_path():
    assert PATH.at(-1.0) == PATH.at(0.0)
    assert PATH.at(99.0) == PATH.at(7.0)


@given(st.integers(0, 6), st.floats(0.0, 1.0))
def test_distance_to_go_counts_the_rest_and_all_that_follows(i, t):
    expected = PATH.segments[i].length_to_go(t) + sum(segment.length for segment in PATH.segments[i + 1 :])
    assert PATH.distance_to_go(i, t) == pytest.approx(expected, abs=1e-9)


def test_distance_to_go_begins_with_the_length_and_ends_with_zero():
    assert PATH.distance_to_go(0, 0.0) == pytest.approx(PATH.length)
    assert PATH.distance_to_go(6, 1.0) == 0.0


def test_one_long_line_cut_in_halves_is_smooth_to_the_second_derivative():
    (joint,) = CompositePath(
        [Line(0.0, 0.0, 50.0, 0.3), Line(50 * math.cos(0.3), 50 * math.sin(0.3), 50.0, 0.3)]
    ).joints
    assert (joint.geometric, joint.parametric) == ("G2", "C2")


@pytest.mark.parametrize(
    ("angle", "radius", "geometric"),
    [
        (0.9e-3, 1e5, "G2"),  # just within the tolerances of course and curvature
        (1.1e-3, 1e5, "G0"),  # course
        (0.0, 1.1e4, "G2"),
        (0.0, 0.9e4, "G1"),  # curvature
    ],
)
def test_geometric_continuity_is_judged_with_the_stated_tolerances(angle, radius, geometric):
    a0 = angle - math.pi / 2.0
    after = Arc(50.0 - radius * math.cos(a0), -radius * math.sin(a0), radius, a0, a0 + 1e-3)
    (joint,) = CompositePath([Line(0.0, 0.0, 50.0, 0.0), after]).joints
    assert joint.geometric == geometric
    assert joint.angle_step == pytest.approx(angle, abs=1e-9)


def test_angle_step_is_wrapped():
    west = Line(0.0, 0.0, 10.0, math.radians(179.0))
    end = west.evaluate(1.0)
    (joint,) = CompositePath([west, Line(end.x, end.y, 10.0, math.radians(-179.0))]).joints
    assert joint.angle_step == pytest.approx(math.radians(2.0))


def test_a_gap_is_refused_with_its_size_in_metres():
    pieces = [Line(0.0, 0.0, 10.0, 0.0), Line(10.0, 0.0, 10.0, 0.0), Line(20.0, 0.25, 10.0, 0.0)]
    with pytest.raises(ConfigurationError, match=r"segments\[2\].*0\.25 m at joint 2.*0\.001 m"):
        CompositePath(pieces)
    assert CompositePath(pieces, tolerance=0.3).joints[1].gap == pytest.approx(0.25)


def test_a_gap_that_is_not_a_number_is_refused():
    with pytest.raises(ConfigurationError, match="joint 1"):
        CompositePath([Line(0.0, 0.0, 10.0, 0.0), Line(math.nan, 0.0, 10.0, 0.0)])


def test_an_empty_path_is_refused():
    with pytest.raises(ConfigurationError, match="empty path"):
        CompositePath([])


@pytest.mark.parametrize("spacing", [0.5, 7.0, 1000.0])
def test_polyline_is_dense_enough_and_keeps_every_joint(spacing):
    x, y, s = PATH.polyline(spacing)
    assert x.shape == y.shape == s.shape
    assert np.all(np.diff(s) > 0.0)
    assert set(range(8)) <= set(s)
    assert np.all(np.hypot(np.diff(x), np.diff(y)) <= spacing + 1e-9)
    for index in range(0, len(s), 50):
        point = PATH.at(float(s[index]))
        assert (x[index], y[index]) == pytest.approx((point.x, point.y), abs=1e-9)


_single = st.sampled_from(
    [
        Line(10.0, -5.0, 80.0, 0.7),
        Arc(0.0, 0.0, 60.0, 0.2, 5.9),
        Arc(0.0, 0.0, 60.0, 0.2, -2.0),
        FermatSpiral(5.0, 5.0, 118.1, 0.1329, -1.5, 1),
        FermatSpiral(5.0, 5.0, 60.0, 1.5, -1.5, -1),
        MirroredFermatSpiral(5.0, 5.0, 118.1, 0.1329, -0.8, -1),
    ]
)


@settings(max_examples=150)
@given(_single, st.floats(-120.0, 120.0), st.floats(-120.0, 120.0))
def test_distance_is_the_smallest_that_brute_force_finds(segment, x, y):
    (distance,) = CompositePath([segment]).distance(np.array([x]), np.array([y]), np.array([0]))
    low, high = 0.0, 1.0
    for _ in range(3):  # each round looks 1000 times closer
        t = np.linspace(low, high, 4001)
        point = segment.evaluate(t)
        squared = (point.x - x) ** 2 + (point.y - y) ** 2
        best = int(squared.argmin())
        low, high = t[max(best - 2, 0)], t[min(best + 2, 4000)]
    assert distance == pytest.approx(math.sqrt(squared[best]), abs=1e-9)


@given(st.integers(0, 6), st.floats(0.0, 1.0), st.floats(-20.0, 20.0))
def test_distance_beside_a_subpath_is_the_offset(i, t, offset):
    point = PATH.evaluate(i, t)
    x = point.x - offset * math.sin(point.chi)
    y = point.y + offset * math.cos(point.chi)
    alone = CompositePath([PATH.segments[i]])
    (distance,) = alone.distance(np.array([x]), np.array([y]), np.array([0]))
    assert distance == pytest.approx(abs(offset), abs=1e-9)


def test_distance_looks_at_the_active_subpath_and_its_neighbours_only():
    # 1 m beside subpath 6 (the last line), which crosses subpath 0 far from its joints.
    point = PATH.evaluate(6, 0.5)
    x, y = point.x - math.sin(point.chi), point.y + math.cos(point.chi)
    far, neighbour, own = PATH.distance(np.full(3, x), np.full(3, y), np.array([2, 5, 6]))
    assert own == pytest.approx(1.0)
    assert neighbour == pytest.approx(1.0)
    expected = min(
        float(np.hypot(p.x - x, p.y - y).min())
        for p in (PATH.segments[i].evaluate(np.linspace(0.0, 1.0, 20001)) for i in (1, 2, 3))
    )
    assert far == pytest.approx(expected, abs=1e-3)


def test_distance_past_the_ends_is_to_the_end_point():
    line = CompositePath([Line(0.0, 0.0, 10.0, 0.0)])
    distance = line.distance(np.array([-3.0, 13.0]), np.array([4.0, -4.0]), np.array([0, 0]))
    assert distance == pytest.approx([5.0, 5.0])


def test_distance_from_the_centre_of_an_arc_is_its_radius():
    arc = CompositePath([Arc(1.0, 2.0, 60.0, 0.0, 3.0)])
    assert arc.distance(np.array([1.0]), np.array([2.0]), np.array([0])) == pytest.approx([60.0])


def test_distance_of_a_sample_that_is_not_finite_is_nan():
    line = CompositePath([Line(0.0, 0.0, 10.0, 0.0)])
    distance = line.distance(np.array([5.0, np.nan, np.inf]), np.array([2.0, 0.0, 0.0]), np.zeros(3, int))
    assert distance[0] == pytest.approx(2.0)
    assert np.isnan(distance[1:]).all()


def test_distance_serves_a_whole_track_at_once():
    x, y, s = PATH.polyline(0.1)
    assert len(x) > 12_000
    i = np.minimum(s.astype(int), 6)
    assert PATH.distance(x, y, i).max() <= 1e-9
