"""PID: signs, limits, anti-windup, no kick."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle
from auv_path_following.control import pid as pid_law
from auv_path_following.control.controller import HeadingInputs
from laws import flown

REMUS = vehicle.load("remus100")
RUDDER = REMUS.rudder
GAINS = pid_law.PidConfig()
DT = 0.05


def inputs(psi_e, r=0.0, r_d=0.0):
    return HeadingInputs(psi_e, r, 0.0, r_d, 0.0)


def settle(pid, seen, seconds):
    for _ in range(round(seconds / DT)):
        rudder = pid.update(seen, DT).rudder
    return rudder


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_too_far_to_starboard_turns_to_port(sign):
    assert sign * settle(flown(pid_law.LAW, vehicle=REMUS), inputs(sign * 0.1), 2.0) > 0.0
    assert sign * settle(flown(pid_law.LAW, vehicle=REMUS), inputs(0.0, r=sign * 0.1), 2.0) > 0.0


@settings(max_examples=50)
@given(st.lists(st.tuples(st.floats(-math.pi, math.pi), st.floats(-1.0, 1.0)), min_size=2, max_size=80))
def test_angle_and_rate_never_exceed_the_rudders(seen):
    pid, last = flown(pid_law.LAW, vehicle=REMUS), 0.0
    for psi_e, r in seen:
        rudder = pid.update(inputs(psi_e, r), DT).rudder
        assert abs(rudder) <= RUDDER.max_angle
        assert abs(rudder - last) <= RUDDER.max_rate * DT * (1 + 1e-9)
        last = rudder


def test_the_integral_does_not_wind_up():
    pid = flown(pid_law.LAW, vehicle=REMUS)
    settle(pid, inputs(3.0), 60.0)
    # Held at the stop for a minute, the rudder is back on the other side within a few seconds.
    assert settle(pid, inputs(-0.3), 6.0) < 0.0


def test_the_integral_holds_a_rudder_without_error():
    pid = flown(pid_law.LAW, vehicle=REMUS)
    settle(pid, inputs(0.05), 20.0)
    held = settle(pid, inputs(0.0), 5.0)
    assert 0.0 < held < RUDDER.max_angle
    assert settle(pid, inputs(0.0), 5.0) == pytest.approx(held)


def test_a_step_of_the_heading_is_no_kick():
    calm, kicked = flown(pid_law.LAW, vehicle=REMUS), flown(pid_law.LAW, vehicle=REMUS)
    settle(calm, inputs(0.0), 1.0)
    settle(kicked, inputs(0.0), 1.0)
    # kp alone acts, not the derivative of the step.
    step = kicked.update(inputs(0.01), DT).rudder
    assert step <= 0.01 * (GAINS.kp + GAINS.ki * DT) + 1e-12


def test_reset_forgets():
    pid = flown(pid_law.LAW, vehicle=REMUS)
    settle(pid, inputs(1.0), 10.0)
    pid.reset()
    assert pid.update(inputs(0.0), DT).rudder == 0.0
