"""Lifted subpaths: lengths against quadrature, depth pieces against the depth, knots by their side."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.curves.spatial.spatial_segment import DEPTH_WIDTH, depths_at
from one_of_each import IDS, SEGMENTS


def ramps(length: float, kind) -> DepthProfile:
    shares = [(0.0, 5.0), (0.3, 15.0), (0.6, 15.0), (1.0, 2.0)]
    return DepthProfile([(share * length, depth) for share, depth in shares], kind)


@pytest.mark.parametrize("kind", ["smooth", "linear"])
@pytest.mark.parametrize("segment", SEGMENTS, ids=IDS)
def test_pieces_of_depth_are_the_depth(segment, kind) -> None:
    path = SpatialPath([segment], ramps(segment.length, kind))
    for i in range(path.n):
        t = np.linspace(0.0, 1.0, 23)
        found = np.column_stack(depths_at(path.subpaths[i].depth_pieces, t))
        points = [path.evaluate(i, float(one)) for one in t]
        for axis, values in enumerate(zip(*((p.z, p.dz, p.ddz) for p in points), strict=True)):
            assert found[:, axis] == pytest.approx(values, abs=1e-9 * max(1.0, *map(abs, values)))
        assert path.sampled(i, t).z == pytest.approx(found[:, 0])


def test_over_a_line_or_an_arc_a_ramp_is_one_piece() -> None:
    plan = [Line(0.0, 0.0, 40.0, 0.0), Arc(40.0, 9.0, 9.0, -0.5 * math.pi, 2.0)]
    path = SpatialPath(plan, ramps(40.0 + plan[1].length, "smooth"))
    assert {len(subpath.depth_pieces) for subpath in path.subpaths} == {DEPTH_WIDTH}


@pytest.mark.parametrize("kind", ["smooth", "linear"])
@pytest.mark.parametrize("segment", SEGMENTS, ids=IDS)
def test_lengths_are_those_of_the_curve(segment, kind) -> None:
    path = SpatialPath([segment], ramps(segment.length, kind))
    t = np.linspace(0.0, 1.0, 4001)
    total = 0.0
    for i, subpath in enumerate(path.subpaths):
        place = np.column_stack(path.sampled(i, t)[:3])
        chords = np.hypot(np.hypot(*np.diff(place[:, :2], axis=0).T), np.diff(place[:, 2]))
        assert subpath.length == pytest.approx(chords.sum(), rel=1e-5)
        assert subpath.length_to_go(0.3) == pytest.approx(chords[1200:].sum(), rel=1e-5)
        total += subpath.length
    assert path.length == pytest.approx(total)
    assert path.distance_to_go(0, 0.0) == pytest.approx(path.length)
    assert path.distance_to_go(path.n - 1, 1.0) == pytest.approx(0.0, abs=1e-9)


DEPTHS = st.floats(0.5, 40.0)


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(5.0, 60.0), DEPTHS), min_size=2, max_size=6), DEPTHS)
def test_at_a_knot_each_side_has_its_own_slope(steps, first: float) -> None:
    """t = 1 of the subpath before is the slope of its ramp, t = 0 of the next one that of the next."""
    knots = [(0.0, first)]
    for step, depth in steps:
        knots.append((knots[-1][0] + step, depth))
    path = SpatialPath([Line(0.0, 0.0, knots[-1][0], 0.7)], DepthProfile(knots, "linear"))
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in itertools.pairwise(knots)]
    assert path.n == len(slopes)
    for i, slope in enumerate(slopes):
        for t in (0.0, 1.0):
            assert math.tan(tangent_of(path.evaluate(i, t)).gamma) == pytest.approx(-slope, abs=1e-9)


@settings(max_examples=20)
@given(st.integers(0, 2**31), st.sampled_from(["smooth", "linear"]))
@example(21121, "smooth")  # a point 6 mm off the path, less than half the way between two samples
def test_the_distance_is_that_of_the_nearest_sample(seed: int, kind) -> None:
    draw = np.random.default_rng(seed)
    arc = Arc(0.0, 0.0, 15.0, 0.0, 4.0 * math.pi)
    path = SpatialPath([Line(15.0, -30.0, 30.0, 0.5 * math.pi), arc], ramps(30.0 + arc.length, kind))
    i = draw.integers(0, path.n, 30)
    t = draw.uniform(0.0, 1.0, 30)
    on_path = np.array([path.evaluate(int(a), float(b))[:3] for a, b in zip(i, t, strict=True)])
    offset = draw.normal(0.0, 0.5, (30, 3))
    x, y, z = (on_path + offset).T
    found = path.distance(x, y, z, i)
    fine = np.linspace(0.0, 1.0, 6001)
    for k in range(30):
        near = [j for j in (i[k] - 1, i[k], i[k] + 1) if 0 <= j < path.n]
        pieces = [np.column_stack(path.sampled(int(j), fine)[:3]) for j in near]
        brute = min(np.linalg.norm(piece - (x[k], y[k], z[k]), axis=1).min() for piece in pieces)
        half = 0.5 * max(np.linalg.norm(np.diff(piece, axis=0), axis=1).max() for piece in pieces)
        assert found[k] <= brute + 1e-9
        # The closest point is at most half the way between two samples off one of them; 1.1: on a curve.
        assert brute <= math.hypot(found[k], 1.1 * half) + 1e-9


def test_a_point_that_is_not_finite_has_no_distance() -> None:
    path = SpatialPath([Line(0.0, 0.0, 30.0, 0.0)], DepthProfile.constant(5.0, 30.0))
    found = path.distance(np.array([1.0, 1.0]), np.zeros(2), np.array([math.nan, 8.0]), np.zeros(2, int))
    assert math.isnan(found[0])
    assert found[1] == pytest.approx(3.0)


def test_the_path_starts_with_its_own_pitch() -> None:
    """Down is a positive depth and a negative elevation."""
    path = SpatialPath([Line(1.0, 2.0, 100.0, 0.3)], DepthProfile([(0.0, 5.0), (100.0, 30.0)], "linear"))
    assert path.start_pose == pytest.approx((1.0, 2.0, 5.0, -math.atan(0.25), 0.3))
