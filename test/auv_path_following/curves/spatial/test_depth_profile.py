"""Depth profiles: knots, owners, the steepest and the sharpest place, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.spatial.depth_profile import DepthProfile

KNOTS = [(0.0, 5.0), (50.0, 30.0), (90.0, 30.0), (150.0, 10.0)]


@pytest.mark.parametrize("kind", ["smooth", "linear"])
def test_the_depth_is_that_of_the_knots(kind) -> None:
    profile = DepthProfile(KNOTS, kind)
    assert [profile.at(way)[0] for way, _ in KNOTS] == pytest.approx([depth for _, depth in KNOTS])
    assert profile.length == 150.0


def test_at_a_knot_the_slope_is_that_of_its_owner() -> None:
    profile = DepthProfile(KNOTS, "linear")
    assert profile.at(50.0, 0)[1] == pytest.approx(0.5)
    assert profile.at(50.0, 1)[1] == 0.0
    assert profile.at(50.0)[1] == 0.0  # the ramp that begins there


@pytest.mark.parametrize("kind", ["smooth", "linear"])
def test_steepest_and_sharpest_are_found(kind) -> None:
    profile = DepthProfile(KNOTS, kind)
    ways = np.linspace(0.0, 150.0, 150_001)
    slopes = [abs(profile.at(way)[1]) for way in ways]
    bends = [abs(profile.at(way)[2]) for way in ways]
    assert profile.steepest() == (pytest.approx(max(slopes), rel=1e-6), 0)
    assert profile.sharpest()[0] == pytest.approx(max(bends), rel=1e-4)


@pytest.mark.parametrize("kind", ["smooth", "linear"])
def test_the_length_that_would_do_does(kind) -> None:
    steepest, radius = math.tan(math.radians(20.0)), 20.0
    profile = DepthProfile(KNOTS, kind)
    length = profile.least_length(25.0, steepest, radius)
    mended = DepthProfile([(0.0, 5.0), (length, 30.0)], kind)
    assert mended.steepest()[0] <= steepest * (1.0 + 1e-12)
    assert mended.sharpest()[0] <= 1.0 / radius * (1.0 + 1e-12)
    assert length < 1.2 * 25.0 * 1.875 / steepest


def test_one_depth() -> None:
    assert DepthProfile.constant(10.0, 80.0).at(33.0) == (10.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("knots", "message"),
    [
        ([(0.0, 5.0)], "knots: found 1 of them, expected at least two"),
        ([(1.0, 5.0), (2.0, 6.0)], r"knots\[0\]: found 1 m, expected 0: where the path starts"),
        ([(0.0, 5.0), (0.0, 6.0)], r"knots\[1\]: found 0 m behind 0 m, expected lengths that increase"),
        (
            [(0.0, 5.0), (9.0, -1.0)],
            r"knots\[1\]: found \(9, -1\), expected a length and a depth of 0 m or more",
        ),
        ([(0.0, math.nan), (9.0, 1.0)], r"knots\[0\]: found \(0, nan\)"),
        ([(0.0, 5.0), (math.inf, 1.0)], r"knots\[1\]: found \(inf, 1\)"),
    ],
)
def test_knots_that_make_no_profile_are_refused(knots, message: str) -> None:
    with pytest.raises(ConfigurationError, match=message):
        DepthProfile(knots)


def test_an_unknown_kind_is_refused() -> None:
    with pytest.raises(ConfigurationError, match="kind: found 'cubic', expected smooth or linear"):
        DepthProfile(KNOTS, "cubic")  # type: ignore[arg-type]
