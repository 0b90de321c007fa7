"""Splines with depth: through their points, smooth, derivatives, length, and the way back."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.curves.spatial.spatial_rows import evaluate_spatial, spatial_rows
from auv_path_following.curves.spatial.spatial_spline import SpatialSpline

POINTS = [(0.0, 0.0, 5.0), (60.0, 5.0, 15.0), (110.0, 60.0, 30.0), (60.0, 120.0, 20.0), (0.0, 110.0, 10.0)]


@pytest.fixture(scope="module", params=[(None, None), (0.4, -2.0)], ids=["natural", "clamped"])
def spline(request) -> SpatialSpline:
    return SpatialSpline(POINTS, *request.param)


def test_it_passes_its_points_and_its_knots_hold_their_depths(spline) -> None:
    t = np.linspace(0.0, 1.0, 40_001)
    way = np.column_stack(SpatialPath([spline]).sampled(0, t)[:3])
    for point in POINTS:
        assert np.sqrt(((way - point) ** 2).sum(axis=1)).min() < 5e-3
    assert [knot.depth for knot in spline.knots] == [point[2] for point in POINTS]
    assert spline.knots[0].way == 0.0
    assert spline.knots[-1].way == pytest.approx(spline.plan.length)


def test_derivatives_and_length(spline) -> None:
    h, path = 1e-5, SpatialPath([spline])
    for t in np.linspace(0.05, 0.95, 19):
        before, here, after = (spline.evaluate(float(t) + step) for step in (-h, 0.0, h))
        for axis in range(3):
            assert (after[axis] - before[axis]) / (2 * h) == pytest.approx(here[axis + 3], abs=2e-3)
            assert (after[axis + 3] - before[axis + 3]) / (2 * h) == pytest.approx(here[axis + 6], abs=0.1)
    way = np.column_stack(path.sampled(0, np.linspace(0.0, 1.0, 20_001))[:3])
    chords = np.sqrt((np.diff(way, axis=0) ** 2).sum(axis=1))
    assert path.length == pytest.approx(chords.sum(), rel=1e-7)
    assert path.distance_to_go(0, 0.25) == pytest.approx(chords[5000:].sum(), rel=1e-7)


def test_an_end_with_a_course_is_level_and_one_without_is_not_bent() -> None:
    clamped, natural = SpatialSpline(POINTS, 0.4, -2.0), SpatialSpline(POINTS)
    for t, chi in ((0.0, 0.4), (1.0, -2.0)):
        tangent = tangent_of(clamped.evaluate(t))
        assert (tangent.chi, tangent.gamma) == pytest.approx((chi, 0.0))
        assert natural.evaluate(t)[6:] == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


def test_the_way_back_is_the_same_curve(spline) -> None:
    back = spline.reversed()
    for t in np.linspace(0.0, 1.0, 11):
        there, returned = spline.evaluate(float(t)), back.evaluate(1.0 - float(t))
        assert returned[:3] == pytest.approx(there[:3], abs=1e-9)
        assert returned[3:6] == pytest.approx([-v for v in there[3:6]], abs=1e-7)


def test_its_rows_are_the_spline(spline) -> None:
    rows = spatial_rows(SpatialPath([spline]))
    for t in np.linspace(0.0, 1.0, 31):
        own = spline.evaluate(float(t))
        assert evaluate_spatial(rows, 0, float(t)) == pytest.approx(own, abs=1e-9 * max(map(abs, own)))


def test_a_vertical_leg_is_refused() -> None:
    with pytest.raises(ConfigurationError, match=r"points\[1\]: found the place of points\[0\], expected"):
        SpatialSpline([(0.0, 0.0, 5.0), (0.0, 0.0, 15.0), (20.0, 0.0, 15.0)])


def test_splines_that_meet_in_the_plan_have_to_meet_in_depth() -> None:
    first = SpatialSpline([(0.0, 0.0, 5.0), (50.0, 0.0, 9.0)])
    second = SpatialSpline([(50.0, 0.0, 8.0), (90.0, 5.0, 9.0)])
    with pytest.raises(ConfigurationError, match=r"segments\[1\]: found a depth of 8 m where segments\[0\]"):
        SpatialPath([first, second])
    assert math.isfinite(SpatialPath([first, SpatialSpline([(50.0, 0.0, 9.0), (90.0, 5.0, 9.0)])]).length)
