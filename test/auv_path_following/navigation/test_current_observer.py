"""The observer against the solution of its own error system, Eq. (36)."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm, solve_continuous_lyapunov

from auv_msgs_py.values.types import NO_CURRENT, Navigation, WaterVelocity
from auv_path_following.navigation.current_observer import (
    CurrentObserver,
    CurrentObserverConfig,
    transition,
)

_gain = st.floats(0.05, 20.0)
_flow = st.floats(-1.0, 1.0)


def matrix_of_eq_36(k_ob1, k_ob2):
    """A of Eq. (36) for one axis; its state is (V - Vhat, eta - eta_hat)."""
    return np.array([[0.0, -k_ob1], [1.0, -k_ob2]])


def drifting(Vx, Vy, ur, vr, psi, x0=3.0, y0=-4.0):
    """Position at any time of a vehicle that keeps its heading: a straight line, Eq. (34)."""
    u = math.cos(psi) * ur - math.sin(psi) * vr + Vx
    v = math.sin(psi) * ur + math.cos(psi) * vr + Vy
    return lambda t: Navigation(x0 + u * t, y0 + v * t, psi, 0.0)


@given(_gain, _gain, st.floats(0.001, 20.0))
def test_transition_is_the_matrix_exponential(k_ob1, k_ob2, dt):
    # In the observer's own state (e, Vhat) the error of the current has the other sign.
    expected = expm(np.array([[-k_ob2, -1.0], [k_ob1, 0.0]]) * dt)
    assert np.reshape(transition(k_ob1, k_ob2, dt), (2, 2)) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("k_ob1", [0.25, 0.25 - 1e-15, 0.25 + 1e-15, 0.25 - 1e-9, 0.25 + 1e-9])
def test_transition_at_equal_poles(k_ob1):
    expected = expm(np.array([[-1.0, -1.0], [k_ob1, 0.0]]) * 0.7)
    assert np.reshape(transition(k_ob1, 1.0, 0.7), (2, 2)) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(("k_ob1", "k_ob2"), [(1.0, 100.0), (100.0, 100.0), (1e-3, 10.0), (100.0, 0.01)])
@pytest.mark.parametrize("dt", [0.0, 1e-9, 20.0, 1e3, 1e5])
def test_transition_bears_any_gap_between_measurements(k_ob1, k_ob2, dt):
    found = np.reshape(transition(k_ob1, k_ob2, dt), (2, 2))
    assert np.isfinite(found).all()
    assert np.abs(found).max() < 200.0
    slow = max(np.linalg.eigvals(matrix_of_eq_36(k_ob1, k_ob2)).real)
    assert np.abs(found).max() <= 400.0 * math.exp(slow * dt) + 1e-300


@settings(max_examples=40)
@given(
    _gain,
    _gain,
    st.lists(st.floats(0.01, 3.0), min_size=1, max_size=12),
    _flow,
    _flow,
    st.floats(0.0, 3.0),
    st.floats(-0.5, 0.5),
    st.floats(-3.0, 3.0),
)
def test_error_decays_as_eq_36_says_whatever_the_steps(k_ob1, k_ob2, steps, Vx, Vy, ur, vr, psi):
    """Eq. (35) on a vehicle that moves as Eq. (34) says; the error is e^(A t) times the first one."""
    at = drifting(Vx, Vy, ur, vr, psi)
    water = WaterVelocity(ur, vr)
    observer = CurrentObserver(CurrentObserverConfig(k_ob1=k_ob1, k_ob2=k_ob2))
    observer.update(at(0.0), water, 0.0)
    t = 0.0
    for dt in steps:
        t += dt
        output = observer.update(at(t), water, dt)
        # At the start eta_hat is the measured position and Vhat is zero.
        decay = expm(matrix_of_eq_36(k_ob1, k_ob2) * t)
        for V, Vhat, error in ((Vx, output.current.Vx, output.ex), (Vy, output.current.Vy, output.ey)):
            assert [V - Vhat, error] == pytest.approx(decay @ [V, 0.0], abs=1e-8)


@pytest.mark.parametrize("rate", [10.0, 20.0, 50.0])
def test_the_estimate_does_not_depend_on_the_rate_of_the_loop(rate):
    at, water = drifting(0.1, 0.2, 1.9, 0.02, 0.6), WaterVelocity(1.9, 0.02)
    observer = CurrentObserver(CurrentObserverConfig(k_ob1=1.0, k_ob2=1.0))
    for k in range(int(5.0 * rate) + 1):
        observer.update(at(k / rate), water, 1.0 / rate)
    remaining = expm(matrix_of_eq_36(1.0, 1.0) * 5.0)[0, 0]
    assert observer.current == pytest.approx((0.1 * (1.0 - remaining), 0.2 * (1.0 - remaining)), abs=1e-10)


@pytest.mark.parametrize(("k_ob1", "k_ob2"), [(1.0, 1.0), (0.25, 1.0), (0.1, 3.0)])
def test_theorem_2_a_quadratic_form_of_the_error_falls_all_the_time(k_ob1, k_ob2):
    """P of Eq. (38) with q = 1 is the one of Eq. (39), and V2 of Eq. (37) falls along the estimate."""
    A = matrix_of_eq_36(k_ob1, k_ob2)
    P = solve_continuous_lyapunov(A.T, -np.eye(2))
    printed = [
        [(k_ob1 + k_ob2**2 + 1.0) / (2.0 * k_ob1 * k_ob2), -0.5],
        [-0.5, (k_ob1 + 1.0) / (2.0 * k_ob2)],
    ]
    assert pytest.approx(np.array(printed)) == P
    at, water = drifting(0.3, -0.2, 1.5, 0.1, -1.0), WaterVelocity(1.5, 0.1)
    observer = CurrentObserver(CurrentObserverConfig(k_ob1=k_ob1, k_ob2=k_ob2))
    observer.update(at(0.0), water, 0.0)
    V2 = [0.3**2 * P[0, 0]]
    dt = -0.1 / max(np.linalg.eigvals(A).real)  # a tenth of the slowest time constant
    for k in range(1, 60):
        output = observer.update(at(dt * k), water, dt)
        X = np.array([0.3 - output.current.Vx, output.ex])
        V2.append(float(X @ P @ X))
    assert all(after < before for before, after in itertools.pairwise(V2))
    assert V2[-1] < 1e-3 * V2[0]


def test_turning_in_still_water_is_hardly_mistaken_for_a_current():
    """On a circle the mean velocity of a step and its chord differ by (r dt)^2/12 only."""
    speed, r, dt = 1.9, 0.2, 0.05
    observer = CurrentObserver(CurrentObserverConfig(k_ob1=1.0, k_ob2=1.0))
    worst = 0.0
    for k in range(1000):
        psi = r * k * dt
        navigation = Navigation(speed / r * math.sin(psi), -speed / r * math.cos(psi), psi, r)
        worst = max(worst, math.hypot(*observer.update(navigation, WaterVelocity(speed, 0.0), dt).current))
    assert 0.0 < worst < 2.0 * speed * (r * dt) ** 2 / 12.0


def test_it_begins_with_no_current_and_reset_begins_anew():
    at, water = drifting(0.5, 0.5, 1.0, 0.0, 0.0), WaterVelocity(1.0, 0.0)
    observer = CurrentObserver()
    seen = observer.update(at(0.0), water, 0.05)
    assert (seen.current, seen.ex, seen.ey) == (NO_CURRENT, 0.0, 0.0)
    for k in range(1, 20):
        observer.update(at(k), water, 1.0)
    assert observer.current == pytest.approx((0.5, 0.5), abs=1e-3)
    observer.reset()
    assert observer.current == NO_CURRENT
    # A jump of the position before the first measurement is no current.
    seen = observer.update(at(1e4), water, 1.0)
    assert (seen.current, seen.ex, seen.ey) == (NO_CURRENT, 0.0, 0.0)


def settled(psi=0.0):
    """An observer with an estimate of (0.1, 0.2) m/s, and the pose of its vehicle at time t."""
    at, water = drifting(0.1, 0.2, 1.9, 0.0, psi), WaterVelocity(1.9, 0.0)
    observer = CurrentObserver()
    for k in range(601):
        observer.update(at(0.05 * k), water, 0.05)
    return observer, at, water


def test_a_short_gap_without_velocity_through_water_is_bridged():
    observer, at, water = settled()
    for k in range(1, 21):
        assert observer.update(at(30.0 + 0.05 * k), None, 0.05).current == observer.current
    assert observer.update(at(31.05), water, 0.05).current == pytest.approx((0.1, 0.2), abs=1e-6)


@pytest.mark.parametrize("heard", [True, False])
def test_what_the_vehicle_did_in_a_long_gap_is_not_taken_for_a_current(heard):
    """It turned and stopped meanwhile; with or without odometry in the gap."""
    observer, at, _ = settled()
    x, y, psi, _ = at(30.0)
    somewhere = Navigation(x + 9.0, y - 3.0, psi + 1.6, 0.0)
    if heard:
        for _ in range(400):
            observer.update(somewhere, None, 0.05)
    output = observer.update(somewhere, WaterVelocity(0.5, 0.0), 0.05 if heard else 20.0)
    assert output.current == pytest.approx((0.1, 0.2), abs=1e-6)


def test_a_new_place_counts_also_when_it_is_found_without_velocity_through_water():
    observer, _, water = settled()
    observer.relocate()
    observer.update(Navigation(500.0, 0.0, 0.0, 0.0), None, 0.05)
    after = observer.update(Navigation(500.1, 0.0, 0.0, 0.0), water, 0.05)
    assert after.current == pytest.approx((0.1, 0.2), abs=1e-6)
