"""Paths in three dimensions: divided at knots, without gaps, with corners where the direction jumps."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath, place_of
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_path_following.missions import mission_file
from one_of_each import IDS, SEGMENTS


@pytest.fixture(scope="module")
def segments():
    return mission_file.load("paper_composite").path.segments


def profile_over(length: float, kind="smooth") -> DepthProfile:
    shares = [(0.0, 5.0), (0.1, 30.0), (0.37, 12.0), (0.37001, 12.0), (0.8, 20.0), (1.0, 5.0)]
    return DepthProfile([(share * length, depth) for share, depth in shares], kind)


def test_each_knot_is_a_joint_and_the_path_has_no_gap(segments) -> None:
    length = math.fsum(segment.length for segment in segments)
    profile = profile_over(length)
    path = SpatialPath(segments, profile)
    assert path.n == len(segments) + len(profile.knots) - 2
    for i in range(path.n - 1):
        assert path.evaluate(i, 1.0)[:3] == pytest.approx(path.evaluate(i + 1, 0.0)[:3], abs=1e-6)
    depths = [joint.z for joint in path.joints]
    for knot in profile.knots[1:-1]:
        assert min(abs(depth - knot.depth) for depth in depths) < 1e-6


def test_a_smooth_profile_adds_no_corner(segments) -> None:
    length = math.fsum(segment.length for segment in segments)
    flat = SpatialPath(segments, DepthProfile.constant(10.0, length))
    lifted = SpatialPath(segments, DepthProfile([(0.0, 5.0), (0.3 * length, 30.0), (length, 5.0)]))
    assert (
        sum(joint.is_corner for joint in lifted.joints) == sum(joint.is_corner for joint in flat.joints) > 0
    )


def test_a_linear_profile_has_a_corner_at_its_knot() -> None:
    profile = DepthProfile([(0.0, 5.0), (40.0, 5.0), (100.0, 15.0)], "linear")
    path = SpatialPath([Line(0.0, 0.0, 100.0, 0.5)], profile)
    (joint,) = path.joints
    assert joint.is_corner
    assert (joint.gamma_in, joint.gamma_out) == pytest.approx((0.0, -math.atan2(10.0, 60.0)))
    assert (joint.x, joint.y, joint.z) == pytest.approx((40.0 * math.cos(0.5), 40.0 * math.sin(0.5), 5.0))


def test_a_helix_is_an_arc_with_a_linear_profile() -> None:
    turns, radius, slope = 3.0, 15.0, math.tan(math.radians(10.0))
    arc = Arc(0.0, 0.0, radius, 0.0, turns * 2.0 * math.pi)
    path = SpatialPath([arc], DepthProfile([(0.0, 5.0), (arc.length, 5.0 + slope * arc.length)], "linear"))
    elevations = [tangent_of(path.evaluate(0, t)).gamma for t in np.linspace(0.0, 1.0, 50)]
    assert elevations == pytest.approx([-math.radians(10.0)] * 50)


def test_the_derivatives_are_those_of_the_place(segments) -> None:
    length = math.fsum(segment.length for segment in segments)
    path, h = SpatialPath(segments, profile_over(length)), 1e-5
    for i, t in itertools.product(range(path.n), (0.2, 0.7)):
        before, here, after = (path.evaluate(i, t + step) for step in (-h, 0.0, h))
        scale = max(1.0, abs(here.dz))
        for axis in range(3):
            first = (after[axis] - before[axis]) / (2.0 * h)
            second = (after[axis + 3] - before[axis + 3]) / (2.0 * h)
            assert first == pytest.approx(here[axis + 3], abs=1e-5 * max(scale, abs(first)))
            assert second == pytest.approx(here[axis + 6], abs=1e-4 * max(scale, abs(second)))


@pytest.mark.parametrize("segment", SEGMENTS, ids=IDS)
def test_the_place_of_a_length_is_where_it_has_passed(segment) -> None:
    t = place_of(segment, 0.3 * segment.length)
    assert segment.length - segment.length_to_go(t) == pytest.approx(0.3 * segment.length, rel=1e-9)


def test_a_profile_of_another_length_is_refused() -> None:
    with pytest.raises(
        ConfigurationError, match=r"depth_profile: found a last knot at 90.000 m, expected .* 100.000 m"
    ):
        SpatialPath([Line(0.0, 0.0, 100.0, 0.0)], DepthProfile([(0.0, 5.0), (90.0, 6.0)]))
