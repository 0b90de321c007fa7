"""Velocity over ground, against the rotation matrix of the attitude."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import SpatialNavigation
from auv_sim.nodes.console.ground_velocity import over_ground

ANGLES = st.floats(-math.pi, math.pi)
SPEEDS = st.floats(-3.0, 3.0)


def rotation(phi: float, theta: float, psi: float) -> np.ndarray:
    """Rz(psi) Ry(theta) Rx(phi)."""
    c, s = np.cos, np.sin
    z = np.array([[c(psi), -s(psi), 0], [s(psi), c(psi), 0], [0, 0, 1]])
    y = np.array([[c(theta), 0, s(theta)], [0, 1, 0], [-s(theta), 0, c(theta)]])
    x = np.array([[1, 0, 0], [0, c(phi), -s(phi)], [0, s(phi), c(phi)]])
    return z @ y @ x


@given(ANGLES, ANGLES, ANGLES, SPEEDS, SPEEDS, SPEEDS)
def test_it_is_the_bodys_velocity_turned(
    phi: float, theta: float, psi: float, u: float, v: float, w: float
) -> None:
    at = SpatialNavigation(0.0, 0.0, 0.0, phi, theta, psi, 0.0, 0.0)
    assert over_ground(at, (u, v, w)) == pytest.approx((rotation(phi, theta, psi) @ [u, v, w])[:2], abs=1e-12)


def test_without_bottom_lock_there_is_none() -> None:
    level = SpatialNavigation(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert all(map(math.isnan, over_ground(level, (math.nan, math.nan, 0.0))))
    assert over_ground(level, (2.0, 0.5, math.nan)) == (2.0, 0.5)
