"""Line, arc and Fermat's spiral: what holds for every segment, and what is known of each."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.curves.kinds.line import Line

_place = st.floats(-500.0, 500.0)
_angle = st.floats(-7.0, 7.0)
_size = st.floats(5.0, 500.0)
_theta = st.floats(0.01, 2.0)
_turn = st.sampled_from([1, -1])
_sweep = st.floats(0.05, 6.0) | st.floats(-6.0, -0.05)

lines = st.builds(Line, _place, _place, _size, _angle)
arcs = st.builds(
    lambda x, y, radius, a0, sweep: Arc(x, y, radius, a0, a0 + sweep), _place, _place, _size, _angle, _sweep
)
spirals = st.builds(FermatSpiral, _place, _place, _size, _theta, _angle, _turn)
mirrored = st.builds(MirroredFermatSpiral, _place, _place, _size, _theta, _angle, _turn)
segments = lines | arcs | spirals | mirrored
inside = st.floats(0.01, 0.99)


REFERENCE = np.polynomial.legendre.leggauss(200)


def _length_by_reference(segment, start, end):
    """Gauss-Legendre with many more nodes than the code under test uses."""
    nodes, weights = REFERENCE
    t = start + (end - start) * (nodes + 1.0) / 2.0
    return float(np.sum(weights * segment.evaluate(t).speed)) * (end - start) / 2.0


@given(segments, inside)
def test_first_derivative_is_that_of_the_position(segment, t):
    h = 1e-5
    before, at, after = (segment.evaluate(t + step) for step in (-h, 0.0, h))
    scale = max(segment.length, 1.0)
    assert (after.x - before.x) / (2 * h) == pytest.approx(at.dx, abs=1e-6 * scale)
    assert (after.y - before.y) / (2 * h) == pytest.approx(at.dy, abs=1e-6 * scale)


@given(segments, inside)
def test_second_derivative_is_that_of_the_first(segment, t):
    h = 1e-5
    before, at, after = (segment.evaluate(t + step) for step in (-h, 0.0, h))
    scale = max(segment.length, 1.0)
    assert (after.dx - before.dx) / (2 * h) == pytest.approx(at.ddx, abs=1e-6 * scale)
    assert (after.dy - before.dy) / (2 * h) == pytest.approx(at.ddy, abs=1e-6 * scale)


@given(segments, st.floats(0.0, 1.0))
def test_length_to_go_is_the_integral_of_the_speed(segment, t):
    expected = _length_by_reference(segment, t, 1.0)
    assert segment.length_to_go(t) == pytest.approx(expected, rel=1e-12, abs=1e-12 * segment.length)


@given(segments)
def test_length_to_go_spans_the_whole_length_and_ends_at_zero(segment):
    assert segment.length_to_go(0.0) == pytest.approx(segment.length, rel=1e-15)
    assert segment.length_to_go(1.0) == 0.0


@given(segments, st.lists(st.floats(0.0, 1.0), min_size=1, max_size=5))
def test_an_array_gives_what_the_numbers_give(segment, parameters):
    many = segment.evaluate(np.array(parameters))
    for index, t in enumerate(parameters):
        one = segment.evaluate(t)
        for name in ("x", "y", "dx", "dy", "ddx", "ddy", "speed", "chi", "kappa"):
            scale = 1e-12 * max(1.0, abs(getattr(one, name)), segment.length)
            difference = getattr(many, name)[index] - getattr(one, name)
            if name == "chi":
                difference = math.remainder(difference, 2.0 * math.pi)
            assert abs(difference) <= scale
            assert isinstance(getattr(one, name), float)


@given(segments, inside)
def test_curvature_is_the_rate_of_the_course_along_the_path(segment, t):
    h = 1e-5
    before, after = segment.evaluate(t - h), segment.evaluate(t + h)
    turned = math.remainder(after.chi - before.chi, 2.0 * math.pi)
    run = segment.evaluate(t).speed * 2 * h
    assert turned / run == pytest.approx(segment.evaluate(t).kappa, rel=1e-4, abs=1e-7)


def test_line_runs_straight_on_its_course():
    line = Line(-20.0, 20.0, 200.0 * math.sqrt(2.0), math.pi / 4.0)
    end = line.evaluate(1.0)
    assert (end.x, end.y) == pytest.approx((180.0, 220.0))
    assert end.chi == pytest.approx(math.pi / 4.0)
    assert end.kappa == 0.0
    assert line.length_to_go(0.25) == pytest.approx(150.0 * math.sqrt(2.0))


@pytest.mark.parametrize(("a1", "sign"), [(math.pi, 1.0), (-math.pi, -1.0)])
def test_arc_turns_to_starboard_when_its_bearing_grows(a1, sign):
    arc = Arc(80.0, 420.0, 100.0, 0.0, a1)
    start, middle, end = (arc.evaluate(t) for t in (0.0, 0.5, 1.0))
    assert (start.x, start.y) == pytest.approx((180.0, 420.0))
    assert start.chi == pytest.approx(sign * math.pi / 2.0)
    assert (middle.x, middle.y) == pytest.approx((80.0, 420.0 + sign * 100.0))
    assert (end.x, end.y) == pytest.approx((-20.0, 420.0))
    assert middle.kappa == pytest.approx(sign * 0.01)
    assert arc.length == pytest.approx(100.0 * math.pi)


@given(_size, st.floats(0.01, 1.0), _angle, _turn, inside)
def test_spiral_has_the_curvature_of_the_closed_formula(k, theta_end, chi0, rho, t):
    theta = theta_end * t * t
    expected = 2.0 * math.sqrt(theta) * (3.0 + 4.0 * theta**2) / (k * (1.0 + 4.0 * theta**2) ** 1.5)
    there = FermatSpiral(0.0, 0.0, k, theta_end, chi0, rho).evaluate(t).kappa
    back = MirroredFermatSpiral(0.0, 0.0, k, theta_end, chi0, rho).evaluate(1.0 - t).kappa
    assert there == pytest.approx(rho * expected, rel=1e-9)
    assert back == pytest.approx(rho * expected, rel=1e-9)


@pytest.mark.parametrize("rho", [1, -1])
def test_spiral_leaves_and_its_mirror_arrives_straight(rho):
    start = FermatSpiral(3.0, 4.0, 100.0, 0.5, 1.2, rho).evaluate(0.0)
    end = MirroredFermatSpiral(3.0, 4.0, 100.0, 0.5, 1.2, rho).evaluate(1.0)
    for point in (start, end):
        assert (point.x, point.y) == (3.0, 4.0)
        assert point.chi == pytest.approx(1.2)
        assert point.kappa == 0.0


@pytest.mark.parametrize("rho", [1, -1])
def test_spiral_turns_by_theta_and_the_angle_off_its_radius(rho):
    theta = 0.4
    end = FermatSpiral(0.0, 0.0, 100.0, theta, 0.1, rho).evaluate(1.0)
    assert end.chi == pytest.approx(0.1 + rho * (theta + math.atan(2.0 * theta)))
    assert math.hypot(end.x, end.y) == pytest.approx(100.0 * math.sqrt(theta))


@given(_size, _theta, _angle, st.floats(0.0, 1.0))
def test_the_other_turn_is_the_mirror_image(k, theta_end, chi, t):
    for kind in (FermatSpiral, MirroredFermatSpiral):
        starboard = kind(0.0, 0.0, k, theta_end, chi, 1)
        port = kind(0.0, 0.0, k, theta_end, -chi, -1)
        p, q = starboard.evaluate(t), port.evaluate(t)
        assert (q.x, q.y) == pytest.approx((p.x, -p.y), abs=1e-9)
        assert q.kappa == pytest.approx(-p.kappa)
        assert port.length == starboard.length


@given(_theta, _angle, st.floats(0.0, 1.0))
def test_the_mirror_is_the_spiral_flown_backwards(theta_end, chi, t):
    # Turned round, the mirror starts where it ended, on the opposite course, and turns to the other side.
    mirror = MirroredFermatSpiral(10.0, -5.0, 80.0, theta_end, chi, 1)
    spiral = FermatSpiral(10.0, -5.0, 80.0, theta_end, chi + math.pi, -1)
    p, q = mirror.evaluate(t), spiral.evaluate(1.0 - t)
    assert (p.x, p.y) == pytest.approx((q.x, q.y), abs=1e-9)
    assert (p.dx, p.dy) == pytest.approx((-q.dx, -q.dy), abs=1e-9)
    assert (p.ddx, p.ddy) == pytest.approx((q.ddx, q.ddy), abs=1e-9)


def test_a_spiral_of_many_turns_keeps_its_length_exact():
    spiral = FermatSpiral(0.0, 0.0, 10.0, 100.0, 0.0, 1)
    pieces = np.linspace(0.0, 1.0, 101)
    expected = sum(_length_by_reference(spiral, a, b) for a, b in itertools.pairwise(pieces))
    assert spiral.length == pytest.approx(expected, rel=1e-12)
    assert spiral.length_to_go(0.37) == pytest.approx(
        expected - _length_by_reference(spiral, 0.0, 0.37), rel=1e-12
    )
