"""The peer's hull against its published derivatives, and its signs."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from auv_sim.vehicle.hulls.mss_remus100 import (
    mss_accelerations,
    mss_remus100,
    mss_remus100_step,
)
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of, body_at, quaternion_of, to_world

CASES = json.loads((Path(__file__).parents[3] / "data" / "mss_remus100_derivatives.json").read_text())[
    "states"
]
HULL = mss_remus100()


@pytest.mark.parametrize("case", CASES, ids=range(len(CASES)))
def test_the_derivatives_are_those_of_the_published_model(case: dict) -> None:
    """The published state is the velocity over ground; its current turns with the heading alone."""
    u, v, w, p, q, r, x, y, z, phi, theta, psi = case["state_u_v_w_p_q_r_x_y_z_phi_theta_psi"]
    speed, towards = case["current_speed_m_s"], case["current_direction_rad"] - psi
    uc, vc = speed * math.cos(towards), speed * math.sin(towards)
    wc = case["vertical_current_body_z_m_s"]
    body = BodyState(x, y, z, *quaternion_of(phi, theta, psi), u - uc, v - vc, w - wc, p, q, r)
    fins = (-case["rudder_rad_starboard_positive"], case["sternplane_rad_bow_down_positive"])
    found = np.array(mss_accelerations(HULL, body, *fins, case["propeller_rpm"] / 60.0, (u, v, w)))
    found += (r * vc, -r * uc, 0.0, 0.0, 0.0, 0.0)
    expected = np.array(case["derivative"])
    assert np.abs(found - expected[:6]).max() < 1e-7
    assert np.abs(np.array(to_world(*body[3:7], u, v, w)) - expected[6:9]).max() < 1e-7


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_fins_have_the_signs_of_this_suite(sign: float) -> None:
    """A positive rudder turns to port (psi falls), positive planes put the bow down (theta falls)."""
    body = body_at(0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 1.5)
    fin, neutral = (sign * 0.1,) * 3, (0.0, 0.0, 0.0)
    turned = dived = body
    for _ in range(100):
        turned, _ = mss_remus100_step(HULL, turned, (fin, neutral, 5.0, (0.0, 0.0, 0.0)), 0.02)
        dived, _ = mss_remus100_step(HULL, dived, (neutral, fin, 5.0, (0.0, 0.0, 0.0)), 0.02)
    assert sign * angles_of(turned)[2] < -0.01
    assert sign * angles_of(dived)[1] < -0.01
    assert sign * (dived.z - 20.0) > 0.0


def test_a_constant_current_only_carries_the_hull_along() -> None:
    """Nearly: damping ahead and the propeller go by the speed over ground, as published."""
    body = body_at(0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 1.5)
    neutral, carried = (0.0, 0.0, 0.0), body
    for _ in range(500):
        body, _ = mss_remus100_step(HULL, body, (neutral, neutral, 5.0, (0.0, 0.0, 0.0)), 0.02)
        carried, _ = mss_remus100_step(HULL, carried, (neutral, neutral, 5.0, (0.0, 0.2, 0.1)), 0.02)
    assert carried.z - body.z == pytest.approx(1.0, abs=0.1)
    assert carried.y - body.y == pytest.approx(2.0, abs=0.1)
