"""Attitude: quaternions and angles, and the turn between the conventions."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.attitude import angles_of_quaternion, euler_rates, quaternion_of, turned_over

roll, pitch, heading = st.floats(-3.0, 3.0), st.floats(-1.5, 1.5), st.floats(-3.1, 3.1)


@given(roll, pitch, heading)
def test_angles_come_back(phi: float, theta: float, psi: float) -> None:
    found = angles_of_quaternion(*quaternion_of(phi, theta, psi))
    assert found == pytest.approx((phi, theta, psi), abs=1e-7)


@given(roll, pitch, heading)
def test_on_the_wire_roll_is_the_same_pitch_is_bow_down_and_yaw_is_counter_clockwise(phi, theta, psi) -> None:
    turned = turned_over(*quaternion_of(phi, theta, psi))
    assert sum(part * part for part in turned) == pytest.approx(1.0)
    wire_roll, wire_pitch, wire_yaw = angles_of_quaternion(*turned)
    assert (wire_roll, wire_pitch) == pytest.approx((phi, -theta), abs=1e-7)
    assert wrap(wire_yaw - flip_yaw(psi)) == pytest.approx(0.0, abs=1e-7)
    assert turned_over(*turned) == pytest.approx(quaternion_of(phi, theta, psi), abs=1e-15)


@given(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5))
def test_level_the_rates_are_those_about_the_body_axes(q: float, r: float) -> None:
    assert euler_rates(0.0, 0.0, q, r) == (r, q)


def test_near_the_vertical_the_rates_stay_finite() -> None:
    assert euler_rates(0.0, 0.5 * math.pi, 0.0, 1.0) == (10.0, 0.0)
