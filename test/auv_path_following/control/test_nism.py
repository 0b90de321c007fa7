"""NISM against finite differences of its own surfaces, and its bounds."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.pure import numbers_of
from auv_path_following.control.controller import HeadingInputs
from auv_path_following.control.nism import Nism, NismConfig, NismState, nism
from laws import Stepped

#: Table 4.
GAINS = NismConfig(k1=0.8, k2=1.5, k3=0.8, k4=1.0, k5=15.0, kp=0.1745, ks=0.0)
LIMIT = math.radians(35.0)

_error = st.floats(-3.1, 3.1)
_rate = st.floats(-1.0, 1.0)
_acceleration = st.floats(-2.0, 2.0)
_inputs = st.builds(HeadingInputs, _error, _rate, _acceleration, _rate, _acceleration)
_gains = st.builds(
    lambda k1, k2, k3, k4, k5: NismConfig(k1=k1, k2=k2, k3=k3, k4=k4, k5=k5, kp=0.1745, ks=0.0),
    *[st.floats(0.1, 5.0)] * 5,
)


def law_with(gains, max_angle=LIMIT):
    return Stepped(nism, Nism(numbers_of(gains), max_angle), NismState())


def signals(t):
    """A heading error and its first two derivatives, split into the vehicle's and the reference's share."""
    psi_e = 0.7 * math.sin(1.3 * t) + 0.3 * math.cos(2.1 * t + 0.4)
    rate = 0.91 * math.cos(1.3 * t) - 0.63 * math.sin(2.1 * t + 0.4)
    acceleration = -1.183 * math.sin(1.3 * t) - 1.323 * math.cos(2.1 * t + 0.4)
    r_d, r_d_dot = 0.1 * math.sin(t), 0.1 * math.cos(t)
    return HeadingInputs(psi_e, rate + r_d, acceleration + r_d_dot, r_d, r_d_dot)


def surfaces(gains, t):
    out = law_with(gains, LIMIT).update(signals(t), 0.0)
    return out.sigma_1, out.sigma_2


@given(_gains, st.floats(0.0, 20.0))
def test_surfaces_are_eq_45_with_derivatives_along_the_signal(gains, t):
    h = 1e-5
    psi_e_dot = (signals(t + h).psi_e - signals(t - h).psi_e) / (2.0 * h)
    sigma_1_dot = (surfaces(gains, t + h)[0] - surfaces(gains, t - h)[0]) / (2.0 * h)
    sigma_1, sigma_2 = surfaces(gains, t)
    psi_e = signals(t).psi_e
    assert sigma_1 == pytest.approx(gains.k1 * math.tanh(gains.k2 * psi_e) + psi_e_dot, abs=1e-7)
    assert sigma_2 == pytest.approx(gains.k3 * math.tanh(gains.k4 * sigma_1) + sigma_1_dot, abs=1e-6)


def test_the_derivative_of_tanh_is_sech_squared_not_secant_squared():
    # With sigma_1 = 0 only k1 k2 sech^2(k2 psi_e) psi_e' is left of sigma_2.
    psi_e = 0.4
    rate = -GAINS.k1 * math.tanh(GAINS.k2 * psi_e)
    out = law_with(GAINS).update(HeadingInputs(psi_e, rate, 0.0, 0.0, 0.0), 0.0)
    assert out.sigma_1 == pytest.approx(0.0, abs=1e-15)
    assert out.sigma_2 == pytest.approx(GAINS.k1 * GAINS.k2 * rate / math.cosh(GAINS.k2 * psi_e) ** 2)


@pytest.mark.parametrize("ks", [0.0, 0.05])
def test_the_rudder_is_the_integral_of_eq_46(ks):
    gains = NismConfig(k1=0.8, k2=1.5, k3=0.8, k4=1.0, k5=2.0, kp=0.1745, ks=ks)
    law, expected, dt = law_with(gains, 10.0), 0.0, 0.05
    for k in range(400):
        out = law.update(signals(k * dt), dt)
        rate = gains.kp * math.tanh(gains.k5 * out.sigma_2) + ks * math.copysign(1.0, out.sigma_2)
        expected += rate * dt
        assert out.rudder == pytest.approx(expected, abs=1e-12)


def test_the_switching_part_rests_on_the_surface():
    gains = NismConfig(ks=0.1)
    assert law_with(gains).update(HeadingInputs(0.0, 0.0, 0.0, 0.0, 0.0), 1.0).rudder == 0.0


@given(st.lists(_inputs, min_size=2, max_size=30), st.floats(0.0, 0.2), st.floats(0.001, 2.0))
def test_rate_and_angle_stay_within_their_bounds(inputs, ks, dt):
    law = law_with(NismConfig(kp=0.1745, ks=ks), LIMIT)
    last = 0.0
    for each in inputs:
        rudder = law.update(each, dt).rudder
        assert abs(rudder - last) <= (0.1745 + ks) * dt + 1e-12
        assert abs(rudder) <= LIMIT
        last = rudder


def test_the_clamp_is_inside_the_integral_so_nothing_winds_up():
    law = law_with(GAINS, LIMIT)
    hard = HeadingInputs(1.5, 0.0, 0.0, 0.0, 0.0)
    for _ in range(400):  # 20 s: without the clamp 200 degrees
        out = law.update(hard, 0.05)
    assert out.rudder == LIMIT
    back = HeadingInputs(-1.5, 0.0, 0.0, 0.0, 0.0)
    assert law.update(back, 0.05).rudder == pytest.approx(LIMIT - 0.1745 * 0.05)


@given(st.floats(0.05, 3.0))
def test_a_heading_too_far_to_starboard_puts_the_rudder_to_port(psi_e):
    steady = HeadingInputs(psi_e, 0.0, 0.0, 0.0, 0.0)
    assert law_with(GAINS, LIMIT).update(steady, 0.05).rudder > 0.0  # positive turns to port


@given(_inputs)
def test_port_and_starboard_are_mirror_images(inputs):
    here = law_with(GAINS, LIMIT).update(inputs, 0.05)
    there = law_with(GAINS, LIMIT).update(HeadingInputs(*[-value for value in inputs]), 0.05)
    assert there == tuple(-value for value in here)


@given(_inputs, _rate, _acceleration)
def test_only_differences_from_the_reference_count(inputs, rate, acceleration):
    psi_e, r, r_dot, r_d, r_d_dot = inputs[:5]
    moved = HeadingInputs(psi_e, r + rate, r_dot + acceleration, r_d + rate, r_d_dot + acceleration)
    here, there = law_with(GAINS).update(inputs, 0.05), law_with(GAINS).update(moved, 0.05)
    assert there == pytest.approx(here, abs=1e-9)


@pytest.mark.parametrize("psi_e", [3.0, 1.0, -2.0])
def test_held_on_the_surface_the_error_goes_to_zero_and_the_rudder_rests(psi_e):
    """Eqs. (47), (48): while sigma_2 is 0 first sigma_1 falls to 0, and then psi_e does."""
    g, law, dt, rate = GAINS, law_with(GAINS, LIMIT), 0.001, 0.0
    for _ in range(20_000):
        sigma_1 = g.k1 * math.tanh(g.k2 * psi_e) + rate
        bend_dot = g.k1 * g.k2 * rate / math.cosh(g.k2 * psi_e) ** 2
        acceleration = -g.k3 * math.tanh(g.k4 * sigma_1) - bend_dot
        out = law.update(HeadingInputs(psi_e, rate, acceleration, 0.0, 0.0), dt)
        assert out.sigma_2 == pytest.approx(0.0, abs=1e-12)
        psi_e, rate = psi_e + rate * dt, rate + acceleration * dt
    assert abs(psi_e) < 1e-4
    assert out.rudder == pytest.approx(0.0, abs=1e-9)


def test_with_no_time_passed_it_reports_and_does_not_move():
    out = law_with(GAINS).update(HeadingInputs(1.0, 0.2, 0.0, 0.0, 0.0), 0.0)
    assert out.rudder == 0.0
    assert out.sigma_1 > 0.0


def test_reset_puts_the_rudder_to_neutral():
    law = law_with(GAINS)
    first = law.update(HeadingInputs(1.0, 0.0, 0.0, 0.0, 0.0), 0.05)
    law.update(HeadingInputs(1.0, 0.0, 0.0, 0.0, 0.0), 0.05)
    law.reset()
    assert law.update(HeadingInputs(1.0, 0.0, 0.0, 0.0, 0.0), 0.05) == first
