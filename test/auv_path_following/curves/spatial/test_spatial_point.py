"""Course, elevation and curvature against finite differences; depth profiles against their integrals."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following.curves.kinds.fermat import FermatSpiral
from auv_path_following.curves.rows import PathRows, evaluate
from auv_path_following.curves.spatial.spatial_point import (
    SpatialPoint,
    curvatures_of,
    lifted,
    linear_ramp,
    smooth_ramp,
    tangent_of,
    turning_of,
)

H = 1e-6


def curve(t: float) -> SpatialPoint:
    """A twisted cubic."""
    return SpatialPoint(
        30.0 * t - 5.0 * t * t, 4.0 + 20.0 * t * t, 10.0 + 6.0 * t - 4.0 * t**3,
        30.0 - 10.0 * t, 40.0 * t, 6.0 - 12.0 * t * t, -10.0, 40.0, -24.0 * t,
    )  # fmt: skip


@given(st.floats(0.05, 0.95))
def test_turning_is_the_rate_of_course_and_elevation(t: float) -> None:
    before, after = tangent_of(curve(t - H)), tangent_of(curve(t + H))
    course, elevation = turning_of(curve(t))
    assert (after.chi - before.chi) / (2 * H) == pytest.approx(course, abs=1e-6)
    assert (after.gamma - before.gamma) / (2 * H) == pytest.approx(elevation, abs=1e-6)


@given(st.floats(0.05, 0.95))
def test_curvature_is_the_turning_of_the_direction_along_the_length(t: float) -> None:
    """Total curvature squared is that of the course, foreshortened, and that of the elevation."""
    tangent, (course, elevation) = tangent_of(curve(t)), turning_of(curve(t))
    total, horizontal, vertical = curvatures_of(curve(t))
    turn = math.hypot(course * math.cos(tangent.gamma), elevation) / tangent.speed
    assert total == pytest.approx(turn, rel=1e-9)
    assert horizontal == pytest.approx(course / tangent.horizontal, rel=1e-12)
    assert vertical == pytest.approx(elevation / tangent.speed, rel=1e-12)


def test_a_helix_has_the_curvature_of_its_formula() -> None:
    """R = 15 m, 10 degrees down: total curvature cos^2(gamma)/R, no vertical one."""
    radius, slope, t = 15.0, math.tan(math.radians(10.0)), 0.3
    sweep = 2.0 * math.pi
    a = sweep * t
    planar = (
        radius * math.cos(a), radius * math.sin(a), -radius * sweep * math.sin(a),
        radius * sweep * math.cos(a), -radius * sweep**2 * math.cos(a), -radius * sweep**2 * math.sin(a),
    )  # fmt: skip
    helix = lifted(planar, linear_ramp(5.0, 5.0 + slope * radius * sweep, radius * sweep, radius * a))
    total, horizontal, vertical = curvatures_of(helix)
    assert tangent_of(helix).gamma == pytest.approx(-math.radians(10.0))
    assert total == pytest.approx(math.cos(math.radians(10.0)) ** 2 / radius)
    assert (horizontal, vertical) == pytest.approx((1.0 / radius, 0.0), abs=1e-12)
    assert helix.z == pytest.approx(5.0 + slope * radius * a)


@pytest.mark.parametrize("ramp", [linear_ramp, smooth_ramp])
@given(way=st.floats(1.0, 49.0))
def test_slope_and_bend_are_the_derivatives_of_the_depth(ramp, way: float) -> None:
    before, here, after = (ramp(5.0, 30.0, 50.0, way + step) for step in (-1e-4, 0.0, 1e-4))
    assert (after[0] - before[0]) / 2e-4 == pytest.approx(here[1], abs=1e-7)
    assert (after[1] - before[1]) / 2e-4 == pytest.approx(here[2], abs=1e-7)


def test_a_smooth_ramp_begins_and_ends_level_and_is_steepest_in_the_middle() -> None:
    assert smooth_ramp(5.0, 30.0, 50.0, 0.0) == (5.0, 0.0, 0.0)
    assert smooth_ramp(5.0, 30.0, 50.0, 50.0) == pytest.approx((30.0, 0.0, 0.0))
    assert smooth_ramp(5.0, 30.0, 50.0, 25.0)[1] == pytest.approx(1.875 * 25.0 / 50.0)
    largest = max(abs(smooth_ramp(5.0, 30.0, 50.0, 0.01 * k)[2]) for k in range(5001))
    assert largest == pytest.approx(5.774 * 25.0 / 50.0**2, rel=1e-3)


@given(st.floats(0.05, 0.95))
def test_a_lifted_spiral_has_the_derivatives_of_its_depth_over_t(t: float) -> None:
    segment = FermatSpiral(0.0, 0.0, 0.4, 30.0, 0.5, 1.0)
    row = [*segment.row(), *[0.0] * 20]
    path = PathRows(1, [row], [])
    length = segment.length

    def at(u: float) -> SpatialPoint:
        return lifted(
            evaluate(path, row, u), smooth_ramp(5.0, 12.0, length, length - segment.length_to_go(u))
        )

    before, here, after = at(t - 1e-4), at(t), at(t + 1e-4)
    assert (after.z - before.z) / 2e-4 == pytest.approx(here.dz, rel=1e-5, abs=1e-4)
    assert (after.dz - before.dz) / 2e-4 == pytest.approx(here.ddz, rel=1e-5, abs=1e-3)
