"""Attitude as a quaternion, against matrices of rotation; the surface, against areas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following.vertical_hull import immersed_share
from auv_sim.vehicle.hulls.rigid_body import (
    BodyState,
    after_runge_kutta,
    angles_of,
    body_at,
    body_slope,
    quaternion_of,
    to_body,
    to_world,
)

angle = st.floats(-3.1, 3.1)
pitch = st.floats(-1.5, 1.5)
STILL = (0.0, 0.0, 0.0)


def matrix(phi: float, theta: float, psi: float) -> np.ndarray:
    """Rz(psi) Ry(theta) Rx(phi), written out."""
    cx, sx, cy, sy = math.cos(phi), math.sin(phi), math.cos(theta), math.sin(theta)
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_z = np.array([[math.cos(psi), -math.sin(psi), 0], [math.sin(psi), math.cos(psi), 0], [0, 0, 1]])
    return about_z @ about_y @ about_x


@given(angle, pitch, angle)
def test_a_quaternion_turns_as_the_matrix_does(phi: float, theta: float, psi: float) -> None:
    quaternion = quaternion_of(phi, theta, psi)
    vector = np.array([0.3, -1.2, 2.1])
    assert np.allclose(to_world(*quaternion, *vector), matrix(phi, theta, psi) @ vector, atol=1e-12)
    assert np.allclose(to_body(*quaternion, *to_world(*quaternion, *vector)), vector, atol=1e-12)
    body = BodyState(0.0, 0.0, 0.0, *quaternion, *(0.0,) * 6)
    assert np.allclose(angles_of(body), (phi, theta, psi), atol=1e-7)


def test_a_positive_pitch_is_bow_up_and_climbs() -> None:
    climbing = body_at(0.0, 0.0, 10.0, 0.0, 0.2, 0.0, 1.5)
    assert body_slope(climbing, (0.0,) * 6, STILL).z == pytest.approx(-1.5 * math.sin(0.2))


def test_starboard_down_is_a_positive_roll() -> None:
    quaternion = quaternion_of(0.2, 0.0, 0.0)
    assert to_world(*quaternion, 0.0, 1.0, 0.0)[2] > 0.0  # the starboard side is the deeper one


@given(angle, pitch, angle, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_the_rates_of_the_attitude_are_those_of_its_matrix(phi, theta, psi, p, q, r) -> None:
    body = BodyState(0.0, 0.0, 0.0, *quaternion_of(phi, theta, psi), 0.0, 0.0, 0.0, p, q, r)
    slope, h = body_slope(body, (0.0,) * 6, STILL), 1e-6
    later = np.array(body[3:7]) + h * np.array(slope[3:7])
    turned = np.array([to_world(*later, *axis) for axis in np.eye(3)]).T
    rate = (turned - matrix(phi, theta, psi)) / h
    skew = np.array([[0, -r, q], [r, 0, -p], [-q, p, 0]])
    assert np.allclose(rate, matrix(phi, theta, psi) @ skew, atol=1e-5)


def test_a_body_that_tumbles_keeps_a_unit_quaternion_and_no_singularity() -> None:
    body = BodyState(0.0, 0.0, 0.0, *quaternion_of(0.0, 1.5, 0.0), 0.0, 0.0, 0.0, 0.0, 0.5, 0.0)
    for _ in range(1000):
        k = body_slope(body, (0.0,) * 6, STILL)
        body = after_runge_kutta(body, k, k, k, k, 0.02)
    assert math.hypot(*body[3:7]) == pytest.approx(1.0, abs=1e-15)
    turned = 1.5 + 0.5 * 20.0  # rad: about y all the time, through +-90 degrees
    assert to_world(*body[3:7], 1.0, 0.0, 0.0)[2] == pytest.approx(-math.sin(turned), abs=1e-3)


@pytest.mark.parametrize(("z", "share"), [(1.0, 1.0), (0.095, 1.0), (0.0, 0.5), (-0.095, 0.0), (-1.0, 0.0)])
def test_immersed_share_at_its_corners(z: float, share: float) -> None:
    assert immersed_share(z, 0.095) == pytest.approx(share, abs=1e-12)


@given(st.floats(-0.095, 0.095))
def test_immersed_share_is_the_area_under_water(z: float) -> None:
    heights = np.linspace(-0.095, 0.095, 40_001)  # above the axis
    chords = 2.0 * np.sqrt(np.maximum(0.095**2 - heights**2, 0.0))
    under = np.trapezoid(np.where(heights <= z, chords, 0.0), heights) / (math.pi * 0.095**2)
    assert immersed_share(z, 0.095) == pytest.approx(under, abs=2e-4)
