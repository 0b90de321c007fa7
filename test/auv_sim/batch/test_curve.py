"""A path as numbers is the same path: points, derivatives and distances against the segments themselves."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following.paths import mission_file
from auv_path_following.paths.arc import Arc
from auv_path_following.paths.archimedean import ArchimedeanSpiral
from auv_path_following.paths.closest import closest_distance
from auv_path_following.paths.clothoid import Clothoid
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.paths.line import Line
from auv_path_following.paths.polynomial import Polynomial
from auv_path_following.paths.reverse import Reversed
from auv_path_following.paths.segment import PathPoint
from auv_path_following.paths.spline import Spline
from auv_sim.batch.curve import PIECES, curve_of
from auv_sim.batch.path_point import distance_to, evaluate

POINTS = [(0.0, 0.0), (60.0, 5.0), (80.0, 70.0), (10.0, 90.0), (-40.0, 30.0)]
SEGMENTS = [
    Line(3.0, -4.0, 50.0, 2.0),
    Arc(10.0, 20.0, 15.0, -1.0, 3.5),
    Arc(10.0, 20.0, 15.0, 3.5, -1.0),
    Arc(-5.0, 0.0, 40.0, 0.3, 0.3 + 2.0 * math.pi),
    FermatSpiral(-20.0, 265.0, 118.0, 0.1329, -1.57, 1),
    FermatSpiral(0.0, 0.0, 12.0, 2.5, 0.4, -1),
    MirroredFermatSpiral(12.0, 188.0, 118.0, 0.1329, -0.785, 1),
    Clothoid(0.0, 0.0, 40.0, 0.3, 0.0, 1.0 / 12.0),
    Clothoid(0.0, 0.0, 40.0, 0.3, -0.05, -0.05),
    ArchimedeanSpiral(0.0, 0.0, 12.0, 72.0, 0.0, 8.0 * math.pi),
    Polynomial([0.0, 30.0, 40.0, -20.0], [0.0, -10.0, 5.0, 60.0]),
    Spline(POINTS),
    Spline(POINTS, chi_start=1.0, chi_end=-2.0),
    Reversed(Spline(POINTS)),
    Reversed(Arc(10.0, 20.0, 15.0, -1.0, 3.5)),
]
IDS = [f"{number}-{segment.kind}" for number, segment in enumerate(SEGMENTS)]
CURVES = [curve_of(CompositePath([segment])) for segment in SEGMENTS]
FRACTION = st.floats(0.0, 1.0)


def assert_same_point(found: PathPoint, wanted: PathPoint) -> None:
    size = max(map(abs, wanted))
    assert np.allclose(found, wanted, rtol=0.0, atol=3e-12 * max(size, 1.0))


@pytest.mark.parametrize("number", range(len(SEGMENTS)), ids=IDS)
@settings(max_examples=60, deadline=None)
@given(t=FRACTION)
def test_points_and_derivatives(number: int, t: float) -> None:
    assert_same_point(evaluate(CURVES[number], 0, t), SEGMENTS[number].evaluate(t))


@pytest.mark.parametrize("number", range(len(SEGMENTS)), ids=IDS)
@settings(max_examples=40, deadline=None)
@given(t=FRACTION, away=st.floats(-60.0, 60.0), bearing=st.floats(0.0, 6.3))
def test_distances(number: int, t: float, away: float, bearing: float) -> None:
    segment = SEGMENTS[number]
    p = segment.evaluate(t)
    x, y = p.x + away * math.cos(bearing), p.y + away * math.sin(bearing)
    wanted = closest_distance(segment, np.array([x]), np.array([y]))[0]
    assert distance_to(CURVES[number], 0, x, y) == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("name", config_files.shipped("missions"))
def test_every_shipped_mission(name: str) -> None:
    path = mission_file.load(name).path
    curve = curve_of(path)
    for i in range(path.n):
        for t in (0.0, 0.1, 0.5, 0.999, 1.0):
            assert_same_point(evaluate(curve, i, t), path.evaluate(i, t))


def test_a_path_that_repeats_itself_is_kept_once() -> None:
    lap = Spline([*POINTS, POINTS[0]])
    once, thrice = curve_of(CompositePath([lap])), curve_of(CompositePath([lap] * 3))
    assert len(thrice.piece) == len(once.piece)
    assert thrice.subpath[:, 0].tolist() == [PIECES] * 3
    assert evaluate(thrice, 2, 0.3) == evaluate(once, 0, 0.3)


def test_a_kink_inside_a_segment_is_refused() -> None:
    class Kinked:
        kind = "kinked"
        length = 20.0

        def evaluate(self, t):
            bend = 10.0 * np.abs(t - 0.3)
            return PathPoint(10.0 * t, bend, 10.0 + 0.0 * t, 10.0 * np.sign(t - 0.3), 0.0 * t, 0.0 * t)

        def length_to_go(self, t):
            return self.length * (1.0 - t)

    with pytest.raises(ConfigurationError, match=r"segments\[0\]: found a kink at t = 0\.3"):
        curve_of(CompositePath([Kinked()]))
