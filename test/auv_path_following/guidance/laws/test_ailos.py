"""AILOS against the closed-loop error dynamics it is designed for, Eq. (32)."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.guidance.laws import ailos
from auv_path_following.guidance.laws.ailos import AilosConfig, adaptive_offset
from auv_path_following.guidance.laws.law import LawInputs
from auv_path_following.guidance.virtual_point import path_errors, tangential_speed
from laws import flown

DELTA, K = 6.0, 1.0
_angle = st.floats(-3.0, 3.0)
_flow = st.floats(-0.6, 0.6)


@given(st.floats(-500.0, 500.0), st.floats(-0.95, 0.95), st.floats(0.5, 50.0))
def test_alpha_solves_its_defining_equation(ye, theta_n, Delta):
    """The heading takes up the push across the path: alpha / sqrt(Delta^2 + (ye + alpha)^2) = theta_n."""
    alpha = adaptive_offset(ye, theta_n, Delta)
    assert alpha / math.hypot(Delta, ye + alpha) == pytest.approx(theta_n, abs=1e-9)


@given(st.floats(-100.0, 100.0), st.floats(0.0, 0.95))
def test_alpha_is_odd_and_vanishes_without_current(ye, theta_n):
    assert adaptive_offset(-ye, -theta_n, DELTA) == pytest.approx(-adaptive_offset(ye, theta_n, DELTA))
    assert adaptive_offset(ye, 0.0, DELTA) == 0.0


@given(
    radius=st.floats(20.0, 300.0),
    turn=st.sampled_from([1.0, -1.0]),
    t=st.floats(0.2, 0.8),
    ex=st.floats(-15.0, 15.0),
    ey=st.floats(-15.0, 15.0),
    ur=st.floats(1.0, 2.5),
    vr=st.floats(-0.4, 0.4),
    Vx=_flow,
    Vy=_flow,
)
def test_with_the_heading_reached_the_errors_obey_eq_32(radius, turn, t, ex, ey, ur, vr, Vx, Vy):
    """Vehicle, Eq. (14), and P, Eqs. (22) and (42), are moved a little: the errors change as designed."""
    path = Arc(10.0, -5.0, radius, 0.3, 0.3 + turn * 2.0)
    current, water = Current(Vx, Vy), WaterVelocity(ur, vr)
    P = path.evaluate(t)
    chi_p, Ur, beta_r = P.chi, math.hypot(ur, vr), math.atan2(vr, ur)
    x = P.x + ex * math.cos(chi_p) - ey * math.sin(chi_p)
    y = P.y + ex * math.sin(chi_p) + ey * math.cos(chi_p)

    law = flown(ailos.LAW, AilosConfig(lookahead=DELTA)).update(
        LawInputs(ey, chi_p, Ur, beta_r, current), 0.05
    )
    psi = law.psi_d
    U_P = tangential_speed(K, ex, psi, water, chi_p, current)
    x_dot = ur * math.cos(psi) - vr * math.sin(psi) + Vx
    y_dot = ur * math.sin(psi) + vr * math.cos(psi) + Vy

    def errors_at(seconds):
        there = path.evaluate(t + U_P / P.speed * seconds)
        return path_errors(
            Navigation(x + x_dot * seconds, y + y_dot * seconds, psi, 0.0), there.x, there.y, there.chi
        )

    h = 1e-4
    (xe_before, ye_before), (xe_after, ye_after) = errors_at(-h), errors_at(h)
    r_p = P.kappa * U_P
    assert (xe_after - xe_before) / (2.0 * h) == pytest.approx(-K * ex + r_p * ey, abs=1e-5)
    expected = -Ur * ey / math.hypot(DELTA, ey + law.alpha) - r_p * ex
    assert (ye_after - ye_before) / (2.0 * h) == pytest.approx(expected, abs=1e-5)


@given(st.floats(0.01, 200.0), _angle, st.floats(-0.3, 0.3))
def test_starboard_of_the_path_it_steers_to_port_and_the_other_way_round(ye, chi_p, beta_r):
    law = flown(ailos.LAW)
    to_starboard = law.update(LawInputs(ye, chi_p, 1.9, beta_r, NO_CURRENT), 0.05)
    to_port = law.update(LawInputs(-ye, chi_p, 1.9, beta_r, NO_CURRENT), 0.05)
    assert -math.pi / 2 < to_starboard.chi_r < 0.0 < to_port.chi_r < math.pi / 2
    assert to_port.chi_r == -to_starboard.chi_r
    assert to_starboard.psi_d == pytest.approx(chi_p + to_starboard.chi_r - beta_r)


@pytest.mark.parametrize(("Vy", "side"), [(0.3, -1.0), (-0.3, 1.0)])
def test_on_the_path_it_steers_against_the_current(Vy, side):
    """Northwards with the water going east the bow has to point west of north, by asin(Vy / Ur)."""
    law = flown(ailos.LAW).update(LawInputs(0.0, 0.0, 1.5, 0.0, Current(0.2, Vy)), 0.05)
    assert law.psi_d * side > 0.0
    assert math.sin(law.psi_d) == pytest.approx(-Vy / 1.5)
    assert law.theta_n == pytest.approx(Vy / 1.5)


def test_at_the_look_ahead_distance_it_aims_45_degrees_in():
    law = flown(ailos.LAW, AilosConfig(lookahead=4.0)).update(LawInputs(4.0, 0.0, 1.9, 0.0, NO_CURRENT), 0.05)
    assert law.psi_d == pytest.approx(-math.pi / 4)


@pytest.mark.parametrize(("Vy", "theta_n"), [(5.0, 0.95), (-5.0, -0.95)])
def test_a_current_stronger_than_the_vehicle_is_clipped(Vy, theta_n):
    law = flown(ailos.LAW, AilosConfig(theta_limit=0.95)).update(
        LawInputs(1.0, 0.0, 1.0, 0.0, Current(0.0, Vy)), 0.05
    )
    assert law.theta_n == theta_n
    assert math.isfinite(law.psi_d)
    assert abs(law.chi_r) < math.pi / 2


def test_at_rest_there_is_nothing_to_compensate():
    law = flown(ailos.LAW).update(LawInputs(2.0, 0.5, 0.0, 0.0, Current(0.3, 0.3)), 0.05)
    assert (law.alpha, law.theta_n) == (0.0, 0.0)
    assert law.psi_d == pytest.approx(0.5 - math.atan(2.0 / 6.0))
