"""The virtual point: its errors, its speed, its way along the path."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.polynomial import Polynomial
from auv_path_following.curves.rows import evaluate
from auv_path_following.guidance.virtual_point import (
    VirtualPoint,
    driven,
    moved,
    path_errors,
    saturated,
    tangential_speed,
)

_place = st.floats(-100.0, 100.0)
_angle = st.floats(-3.0, 3.0)
_speed = st.floats(-2.0, 2.0)


def two_legs():
    """40 m north, then 20 m east."""
    return CompositePath([Line(0.0, 0.0, 40.0, 0.0), Line(40.0, 0.0, 20.0, math.pi / 2)]).rows


@pytest.mark.parametrize(
    ("x", "y", "chi_p", "xe", "ye"),
    [
        (3.0, 1.0, 0.0, 2.0, -1.0),
        (1.0, 5.0, 0.0, 0.0, 3.0),  # east of a path to the north: starboard
        (3.0, 2.0, math.pi / 2, 0.0, -2.0),  # north of a path to the east: port
        (1.0, 0.0, -math.pi / 2, 2.0, 0.0),
    ],
)
def test_errors_are_ahead_and_to_starboard(x, y, chi_p, xe, ye):
    found = path_errors(Navigation(x, y, 0.7, 0.0), 1.0, 2.0, chi_p)
    assert found == pytest.approx((xe, ye), abs=1e-12)


@given(_place, _place, _angle, _angle)
def test_errors_are_the_offset_turned_into_the_paths_axes(x, y, chi_p, turn):
    at = path_errors(Navigation(x, y, 0.0, 0.0), 0.0, 0.0, chi_p)
    assert math.hypot(*at) == pytest.approx(math.hypot(x, y))
    # Turning the world about P changes nothing.
    c, s = math.cos(turn), math.sin(turn)
    turned = path_errors(Navigation(c * x - s * y, s * x + c * y, 0.0, 0.0), 0.0, 0.0, chi_p + turn)
    assert turned == pytest.approx(at, abs=1e-9)


@given(st.floats(-20.0, 20.0), _angle, st.floats(0.01, 3.0), _speed, _angle, _speed, _speed)
def test_speed_of_p_is_eq_22(xe, psi, ur, vr, chi_p, Vx, Vy):
    Ur, beta_r = math.hypot(ur, vr), math.atan2(vr, ur)
    expected = Ur * math.cos(psi + beta_r - chi_p) + 0.7 * xe + math.cos(chi_p) * Vx + math.sin(chi_p) * Vy
    found = tangential_speed(0.7, xe, psi, WaterVelocity(ur, vr), chi_p, Current(Vx, Vy))
    assert found == pytest.approx(expected, abs=1e-12)


@given(
    k=st.floats(0.1, 3.0),
    xe=st.floats(-10.0, 10.0),
    ye=st.floats(-10.0, 10.0),
    psi=_angle,
    ur=_speed,
    vr=_speed,
    Vx=_speed,
    Vy=_speed,
)
def test_the_along_track_error_decays_on_any_heading(k, xe, ye, psi, ur, vr, Vx, Vy):
    """Eq. (23), xe' = -k xe + r_p ye: Eq. (22) takes everything else out of Eq. (21)."""
    path = Arc(0.0, 0.0, 50.0, 0.0, 3.0)
    P = path.evaluate(0.5)
    c, s = math.cos(P.chi), math.sin(P.chi)
    x, y = P.x + xe * c - ye * s, P.y + xe * s + ye * c
    U_P = tangential_speed(k, xe, psi, WaterVelocity(ur, vr), P.chi, Current(Vx, Vy))
    x_dot = ur * math.cos(psi) - vr * math.sin(psi) + Vx
    y_dot = ur * math.sin(psi) + vr * math.cos(psi) + Vy

    def xe_at(seconds):
        there = path.evaluate(0.5 + U_P / P.speed * seconds)
        navigation = Navigation(x + x_dot * seconds, y + y_dot * seconds, psi, 0.0)
        return path_errors(navigation, there.x, there.y, there.chi)[0]

    h = 1e-4
    assert (xe_at(h) - xe_at(-h)) / (2.0 * h) == pytest.approx(-k * xe + P.kappa * U_P * ye, abs=1e-5)


def after(path, P, U_P, dt):
    """P after `dt` seconds at U_P, and how far that led beyond the end of the path; it rests then."""
    _, _, dx, dy, _, _ = evaluate(path, path.subpath[P.i], P.t)
    P, _ = driven(P.i, P.t, P.finished, U_P, math.hypot(dx, dy))
    i, t, finished, beyond = moved(path, P, dt)
    return VirtualPoint(i, t, finished=finished), beyond


def place_of(path, P):
    return evaluate(path, path.subpath[P.i], P.t)[:2]


@given(st.floats(0.1, 3.0), st.floats(0.01, 1.0))
def test_p_covers_metres_not_units_of_s(U_P, dt):
    path = two_legs()
    assert driven(0, 0.0, False, U_P, 40.0)[1] == U_P
    P, _ = after(path, VirtualPoint(), U_P, dt)
    assert place_of(path, P)[0] == pytest.approx(U_P * dt)
    assert P.s == pytest.approx(U_P * dt / 40.0)


def test_at_the_end_of_a_subpath_the_rest_of_the_way_is_carried_over_as_length():
    path = two_legs()
    P, _ = after(path, VirtualPoint(), 39.0, 1.0)
    assert P.i == 0
    P, _ = after(path, P, 7.0, 1.0)
    # 6 m beyond the first leg of 40 m are 6 m of the second one of 20 m.
    assert P.i == 1
    assert place_of(path, P) == pytest.approx((40.0, 6.0))
    # And it stays there until it has a speed for the new subpath.
    assert moved(path, P, 1.0)[:2] == (1, pytest.approx(0.3))


def test_any_number_of_subpaths_is_passed_in_a_step_and_what_is_left_beyond_the_end_is_known():
    path = CompositePath([Line(0.05 * k, 0.0, 0.05, 0.0) for k in range(4000)]).rows
    P = VirtualPoint()
    for step in range(1, 100):
        P, _ = after(path, P, 2.0, 1.0)
        assert place_of(path, P)[0] == pytest.approx(2.0 * step, abs=1e-9)
    P, beyond = after(path, P, 5.0, 1.0)
    assert P.finished
    assert beyond == pytest.approx(3.0)


def test_the_way_is_length_where_the_speed_changes_along_a_subpath_too():
    slow_start = Polynomial([0.0, 0.5, 0.0, 0.5], [0.0, 0.0, 0.0, 0.0])  # 1 m, dp/dt from 0.5 to 2
    path = CompositePath([Line(-10.0, 0.0, 10.0, 0.0), slow_start, Line(1.0, 0.0, 10.0, 0.0)]).rows
    P, _ = after(path, VirtualPoint(), 13.0, 1.0)
    assert place_of(path, P)[0] == pytest.approx(3.0)


def test_at_the_end_of_the_path_it_is_finished_and_stays():
    path = two_legs()
    P, _ = after(path, VirtualPoint(1, 0.0), 25.0, 1.0)
    assert P.finished
    assert (P.i, P.t, P.s) == (1, 1.0, 2.0)
    assert driven(P.i, P.t, P.finished, 2.0, 20.0)[1] == 0.0
    P, _ = after(path, P, 2.0, 1.0)
    assert P.s == 2.0
    assert place_of(path, P) == pytest.approx((40.0, 20.0))


def test_it_waits_at_the_start_for_a_vehicle_that_is_still_behind():
    path = two_legs()
    assert driven(0, 0.0, False, -3.0, 40.0) == (VirtualPoint(), 0.0)
    P, _ = after(path, VirtualPoint(), -3.0, 1.0)
    assert P.s == 0.0
    P, _ = after(path, P, 1.0, 1.0)
    assert place_of(path, P)[0] == pytest.approx(1.0)


def test_within_a_subpath_it_may_go_back_but_never_into_the_one_before():
    path = two_legs()
    P, _ = after(path, VirtualPoint(1, 0.0), 5.0, 1.0)
    assert driven(P.i, P.t, P.finished, -2.0, 20.0)[1] == -2.0
    P, _ = after(path, P, -2.0, 1.0)
    assert place_of(path, P)[1] == pytest.approx(3.0)
    P, _ = after(path, P, -50.0, 1.0)
    assert (P.i, P.t) == (1, 0.0)


@given(st.lists(st.tuples(st.floats(-30.0, 60.0), st.floats(0.0, 2.0)), max_size=30))
def test_whatever_happens_the_subpath_never_decreases_and_s_stays_on_the_path(course):
    path, P = two_legs(), VirtualPoint()
    for U_P, dt in course:
        last = P.i
        P, _ = after(path, P, U_P, dt)
        assert P.i in (last, last + 1)
        assert 0.0 <= P.t <= 1.0
        assert P.t < 1.0 or P.finished
        assert moved(path, P, dt) == (P.i, P.t, P.finished, 0.0)  # at rest


def test_at_rest_p_is_drawn_towards_the_vehicle_only():
    assert tangential_speed(2.0, 3.0, 0.4, WaterVelocity(0.0, 0.0), 1.0, NO_CURRENT) == 6.0


@given(st.floats(-1e3, 1e3), st.floats(1.0, 20.0))
def test_near_the_path_xe_counts_as_it_is_and_farther_away_no_more(xe, limit):
    if abs(xe) <= limit:
        assert saturated(xe, limit) == xe
    else:
        assert saturated(xe, limit) == math.copysign(limit, xe)
