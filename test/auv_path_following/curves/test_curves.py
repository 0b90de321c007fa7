"""Clothoid, polynomial, spline, Archimedean spiral and the reversed segment: what holds for every curve."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.archimedean import ArchimedeanSpiral
from auv_path_following.curves.kinds.clothoid import Clothoid
from auv_path_following.curves.kinds.fermat import FermatSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.curves.kinds.reverse import Reversed
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.outline import look, polygon, tightest

place = st.floats(-500.0, 500.0)
angle = st.floats(-7.0, 7.0)
curvature = st.floats(-0.1, 0.1) | st.sampled_from([0.0, 1e-9, -1e-7, 0.05])
clothoids = st.builds(Clothoid, place, place, st.floats(1.0, 150.0), angle, curvature, curvature)
# The east coordinate always goes on, so that no curve stands still.
polynomials = st.builds(
    lambda north, rest: Polynomial(north, [rest, 50.0, 0.0, 10.0]),
    st.lists(st.floats(-80.0, 80.0), min_size=2, max_size=6),
    place,
)
spirals = st.builds(
    lambda x, y, r, g, a, sweep: ArchimedeanSpiral(x, y, r, r + g, a, a + sweep),
    place, place, st.floats(0.0, 80.0), st.floats(1.0, 60.0), angle,
    st.floats(0.3, 12.0) | st.floats(-12.0, -0.3),
)  # fmt: skip


@st.composite
def splines(draw: st.DrawFn) -> Spline:
    steps = draw(st.lists(st.tuples(st.floats(10.0, 80.0), st.floats(-1.2, 1.2)), min_size=1, max_size=6))
    points, chi = [(draw(place), draw(place))], draw(angle)
    for length, turn in steps:
        chi += turn
        x, y = points[-1]
        points.append((x + length * math.cos(chi), y + length * math.sin(chi)))
    return Spline(points, draw(st.none() | st.just(chi)), None)


segments = clothoids | polynomials | spirals | splines()
curves = segments | st.builds(Reversed, segments)
inside = st.floats(0.02, 0.98)


def length_by_reference(segment, start, end):
    """Gauss-Legendre on many short panels."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    edges = np.linspace(start, end, 201)
    t = edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1.0) / 2.0
    return float(np.sum(segment.evaluate(t).speed @ weights * np.diff(edges) / 2.0))


@given(curves, inside)
def test_derivatives_agree_with_finite_differences(segment, t):
    h = 1e-5
    before, at, after = (segment.evaluate(t + step) for step in (-h, 0.0, h))
    scale = max(segment.length, float(np.abs(segment.evaluate(np.linspace(0, 1, 21)).ddx).max()), 1.0)
    for value, slope in (("x", "dx"), ("y", "dy"), ("dx", "ddx"), ("dy", "ddy")):
        found = (getattr(after, value) - getattr(before, value)) / (2 * h)
        # A spline's third derivative jumps, so its second one is only met to first order.
        assert found == pytest.approx(
            getattr(at, slope), abs=2e-3 * scale if value[0] == "d" else 1e-5 * scale
        )


@given(curves, inside)
def test_length_agrees_with_quadrature(segment, t):
    assert segment.length == pytest.approx(length_by_reference(segment, 0.0, 1.0), rel=1e-8, abs=1e-9)
    rest = length_by_reference(segment, t, 1.0)
    assert segment.length_to_go(t) == pytest.approx(rest, rel=1e-8, abs=1e-8 * segment.length)
    assert segment.length_to_go(1.0) == pytest.approx(0.0, abs=1e-9 * segment.length)


@given(curves)
def test_numbers_and_arrays_give_the_same_points(segment):
    t = np.linspace(0.0, 1.0, 9)
    together = segment.evaluate(t)
    for k, value in enumerate(t.tolist()):
        alone = segment.evaluate(value)
        assert all(type(number) is float for number in alone)
        assert [field[k] for field in together] == pytest.approx(list(alone), rel=1e-12, abs=1e-9)


@given(clothoids, inside)
def test_clothoid_bends_evenly(segment, t):
    start, end = segment.evaluate(0.0).kappa, segment.evaluate(1.0).kappa
    assert segment.evaluate(t).kappa == pytest.approx(start + t * (end - start), abs=1e-12)


@given(place, place, st.floats(5.0, 80.0), angle, st.floats(-0.05, 0.05))
def test_clothoid_of_one_curvature_is_an_arc_or_a_line(x, y, length, chi, kappa):
    assume(abs(kappa) > 1e-3 or kappa == 0.0)
    side = math.copysign(1.0, kappa)
    if kappa:
        radius = 1.0 / abs(kappa)
        centre = x - side * radius * math.sin(chi), y + side * radius * math.cos(chi)
        a0 = chi - side * 0.5 * math.pi
        plain = Arc(*centre, radius, a0, a0 + kappa * length)
    else:
        plain = Line(x, y, length, chi)
    bent = Clothoid(x, y, length, chi, kappa, kappa)
    for t in (0.0, 0.3, 1.0):
        assert list(bent.evaluate(t)) == pytest.approx(list(plain.evaluate(t)), rel=1e-9, abs=1e-8)


def test_both_forms_of_the_clothoid_agree():
    """Just before and behind the border between Fresnel's integrals and quadrature."""
    for change in (9.9e-7, 1.01e-6):
        segment = Clothoid(0.0, 0.0, 1.0, 0.3, 0.0, change)
        assert segment.evaluate(1.0).y == pytest.approx(
            math.sin(0.3) + math.cos(0.3) * change / 6.0, abs=1e-14
        )


def test_spline_goes_through_its_points_smoothly():
    points = [(0.0, 0.0), (50.0, 10.0), (80.0, 60.0), (70.0, 120.0), (0.0, 150.0)]
    segment = Spline(points, math.pi / 4, -math.pi / 2)
    chords = np.hypot(*np.diff(np.array(points), axis=0).T)
    knots = np.concatenate(([0.0], np.cumsum(chords))) / chords.sum()
    for (x, y), knot in zip(points, knots.tolist(), strict=True):
        assert segment.evaluate(knot)[:2] == pytest.approx((x, y), abs=1e-9)
    for knot in knots[1:-1].tolist():
        before, after = segment.evaluate(knot - 1e-12), segment.evaluate(knot)
        assert before[2:] == pytest.approx(after[2:], abs=1e-5)
    assert segment.evaluate(0.0).chi == pytest.approx(math.pi / 4)
    assert segment.evaluate(1.0).chi == pytest.approx(-math.pi / 2)


def test_a_spline_without_end_courses_ends_straight():
    segment = Spline([(0.0, 0.0), (50.0, 10.0), (80.0, 60.0)])
    assert segment.evaluate(0.0).kappa == pytest.approx(0.0, abs=1e-12)
    assert segment.evaluate(1.0).kappa == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Polynomial([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]), "stands still at t = 0"),
        (lambda: Polynomial([0.25, -1.0, 1.0], [0.0, 0.0]), "stands still at t = 0.5"),
        (lambda: Polynomial([3.0, 0.0], [1.0, 0.0]), "stands still"),
        (lambda: Spline([(0.0, 0.0), (5.0, 5.0), (5.0, 5.0)]), r"points\[1\] and points\[2\] in one place"),
    ],
)
def test_a_curve_without_a_course_is_refused(make, said):
    with pytest.raises(ConfigurationError, match=said):
        make()


@given(segments, inside)
def test_reversed_is_the_same_way_back(segment, t):
    back = Reversed(segment)
    there, here = segment.evaluate(1.0 - t), back.evaluate(t)
    assert (here.x, here.y) == (there.x, there.y)
    assert wrap(here.chi - there.chi - math.pi) == pytest.approx(0.0, abs=1e-12) or abs(
        wrap(here.chi - there.chi)
    ) == pytest.approx(math.pi)
    assert here.kappa == pytest.approx(-there.kappa, rel=1e-9, abs=1e-15)


def test_tightest_finds_the_peak_inside_a_spiral():
    # Above theta = 0.27 the spiral's curvature falls again: the peak is no end.
    segment = FermatSpiral(0.0, 0.0, 50.0, 1.0, 0.0, -1)
    theta = math.sqrt(0.5 * math.sqrt(7.0) - 1.25)
    square = 4.0 * theta * theta
    peak = 2.0 * math.sqrt(theta) * (3.0 + square) / (50.0 * (1.0 + square) ** 1.5)
    t, kappa = tightest(segment)
    assert kappa == pytest.approx(-peak, rel=1e-9)
    assert t == pytest.approx(math.sqrt(theta), abs=1e-4)


@settings(max_examples=30)
@given(curves)
def test_straight_pieces_stay_near_the_curve(segment):
    x, y = polygon(segment, 0.05)
    fine = segment.evaluate(np.linspace(0.0, 1.0, 400))
    p = np.column_stack((x, y))
    r = np.diff(p, axis=0)
    gap = np.column_stack((fine.x, fine.y))[:, None, :] - p[None, :-1, :]
    u = np.clip(np.sum(gap * r, axis=2) / np.maximum(np.sum(r * r, axis=1), 1e-30), 0.0, 1.0)
    off = np.min(np.hypot(*np.moveaxis(gap - u[..., None] * r, 2, 0)), axis=1)
    assert off.max() < 0.15
    t, _ = look(segment)
    assert (t[0], t[-1]) == (0.0, 1.0)
