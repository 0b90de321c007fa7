"""The laws in three dimensions: reduction to the paper's, convergence, signs up and down."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from auv_msgs_py.values.attitude import euler_rates
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity
from auv_path_following.curves.spatial.spatial_point import Tangent
from auv_path_following.guidance.laws.ailos import AilosConfig, adaptive_offset, ailos
from auv_path_following.guidance.laws.law import LawInputs, NoState
from auv_path_following.guidance.spatial.spatial_laws import (
    VerticalLaw,
    current_along,
    elevation_seen,
    error_rates,
    spatial_errors,
    spatial_speed,
    vertical_ailos,
)
from auv_path_following.guidance.virtual_point import path_errors, tangential_speed
from auv_path_following.navigation.levelled import levelled

angle, speed = st.floats(-3.1, 3.1), st.floats(0.3, 2.5)
small, metres, drift = st.floats(-0.5, 0.5), st.floats(-50.0, 50.0), st.floats(-0.4, 0.4)
LAW = VerticalLaw(lookahead=5.2, limit=0.95, minimum_speed=0.2)
STEEPEST = math.radians(30.0)


def rotation(phi: float, theta: float, psi: float) -> np.ndarray:
    cx, sx, cy, sy, cz, sz = (f(a) for a in (phi, theta, psi) for f in (math.cos, math.sin))
    about_x = np.array([[1, 0, 0], [0, cx, -sx], [0, sx, cx]])
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    return np.array([[cz, -sz, 0], [sz, cz, 0], [0, 0, 1]]) @ about_y @ about_x


def tangent(chi: float, gamma: float) -> Tangent:
    return Tangent(chi, gamma, math.cos(gamma), 1.0)


@given(angle, angle, speed, small, metres, metres, drift, drift)
def test_at_one_depth_the_laws_are_the_papers(chi, psi, ur, vr, x, y, Vx, Vy) -> None:
    """(3D-12), (3D-16), (3D-20), (3D-21) against Eqs. (20), (22), (24), (25), (30), (31)."""
    flow, current = levelled((ur, vr, 0.0), 0.0, 0.0), Current(Vx, Vy)
    xe, ye, ze = spatial_errors((x, y, 0.0), chi, 0.0)
    assert (xe, ye, ze) == pytest.approx(
        (*path_errors(Navigation(x, y, psi, 0.0), 0.0, 0.0, chi), 0.0), abs=1e-12
    )
    Vt, Vn, Vb = current_along((Vx, Vy, 0.0), chi, 0.0)
    U_P = spatial_speed(1.0, xe, psi, flow, tangent(chi, 0.0), Vt)
    assert (
        pytest.approx(tangential_speed(1.0, xe, psi, WaterVelocity(ur, vr), chi, current), abs=1e-12) == U_P
    )
    assert (flow.Uh, flow.Ur, flow.beta_h) == pytest.approx(
        (math.hypot(ur, vr), math.hypot(ur, vr), math.atan2(vr, ur)), abs=1e-15
    )
    seen = LawInputs(ye, chi, flow.Uh, flow.beta_h, current)
    _, output = ailos(AilosConfig(lookahead=5.2), NoState(), seen, 0.1)
    alpha = adaptive_offset(ye, max(-0.95, min(0.95, Vn / flow.Uh)), 5.2)
    assert output.psi_d == pytest.approx(chi + math.atan(-(ye + alpha) / 5.2) - flow.beta_h, abs=1e-12)
    assert Vb == 0.0


@given(angle, small, small, speed, small, small)
def test_levelled_velocity_is_what_the_attitude_makes_of_it(psi, theta, phi, ur, vr, wr) -> None:
    flow = levelled((ur, vr, wr), phi, theta)
    world = rotation(phi, theta, psi) @ (ur, vr, wr)
    cos, sin = math.cos(psi), math.sin(psi)
    expected = (cos * flow.ahead - sin * flow.starboard, sin * flow.ahead + cos * flow.starboard, flow.down)
    assert world == pytest.approx(expected, abs=1e-12)
    assert flow.gamma_w == pytest.approx(math.atan2(-world[2], math.hypot(world[0], world[1])), abs=1e-12)


@given(angle, small, metres, metres, metres)
def test_errors_are_the_offset_in_the_frame_of_the_path(chi, gamma, x, y, z) -> None:
    frame = rotation(0.0, gamma, chi)
    assert frame.T @ (x, y, z) == pytest.approx(spatial_errors((x, y, z), chi, gamma), abs=1e-11)


@given(
    st.tuples(angle, small), st.tuples(angle, small, small), st.tuples(speed, small, small),
    st.tuples(metres, metres, metres), st.tuples(drift, drift, drift), st.tuples(small, small),
)  # fmt: skip
def test_the_error_rates_are_those_of_the_motion(path, attitude, water, errors, current, turning) -> None:
    """(3D-18) against the frame turned by hand: e' = -omega x e + Rp^T (velocity) - (U_P, 0, 0)."""
    (chi, gamma), (psi, theta, phi), U_P = path, attitude, 1.3
    frame = rotation(0.0, gamma, chi)
    velocity = rotation(phi, theta, psi) @ water + current
    course, elevation = turning
    omega = np.array([-course * math.sin(gamma), elevation, course * math.cos(gamma)])
    expected = frame.T @ velocity - (U_P, 0.0, 0.0) - np.cross(omega, errors)
    found = error_rates(
        errors, levelled(water, phi, theta), psi, tangent(chi, gamma), turning,
        current_along(current, chi, gamma), U_P,
    )  # fmt: skip
    assert found == pytest.approx(expected, abs=1e-10)


@given(
    st.tuples(angle, st.floats(-0.4, 0.4)), st.tuples(speed, drift, st.floats(-0.2, 0.2)), small,
    st.tuples(st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)),
    st.tuples(drift, drift, st.floats(-0.1, 0.1)), st.tuples(small, small),
)  # fmt: skip
def test_the_distance_falls_as_the_proof_says(path, water, phi, errors, current, turning) -> None:
    """(3D-26): with heading, pitch and current as the laws have them, all cross terms cancel."""
    chi, gamma = path
    along = tangent(chi, gamma)
    xe, ye, ze = errors
    Vt, Vn, Vb = current_along(current, chi, gamma)
    theta = gamma
    for _ in range(60):  # a pitch that is its own desired one; the crab angle depends on it
        flow = levelled(water, phi, theta)
        _, across = ailos(
            AilosConfig(lookahead=5.2), NoState(),
            LawInputs(ye, chi, flow.Uh, flow.beta_h, Current(current[0], current[1])), 0.1,
        )  # fmt: skip
        chi_w = across.psi_d + flow.beta_h
        gamma_a, rho = elevation_seen(chi_w, along)
        vertical = vertical_ailos(LAW, ze, gamma_a, rho, flow, water, phi, Vb, math.radians(85.0))
        theta = vertical.theta_d
    flow = levelled(water, phi, theta)
    # The proof holds where nothing is clipped: the currents can be compensated, the elevation can be reached.
    assume(abs(Vn) < 0.9 * flow.Uh and abs(Vb) < 0.9 * flow.Ur * rho)
    assume(abs(flow.gamma_w - vertical.gamma_d) < 1e-9)
    U_P = spatial_speed(1.0, xe, across.psi_d, flow, along, Vt)
    rates = error_rates(errors, flow, across.psi_d, along, turning, (Vt, Vn, Vb), U_P)
    falls = (
        -xe * xe
        - flow.Uh * ye * ye / math.hypot(5.2, ye + across.alpha)
        - flow.Ur * rho * ze * ze / math.hypot(5.2, ze + vertical.alpha_b)
    )
    assert np.dot(errors, rates) == pytest.approx(falls, abs=1e-7)
    assert falls <= 0.0


@pytest.mark.parametrize(("ze", "sign"), [(2.0, 1.0), (-2.0, -1.0)], ids=["below", "above"])
def test_a_vehicle_below_the_path_climbs_and_one_above_dives(ze: float, sign: float) -> None:
    water = (1.5, 0.0, 0.0)
    found = vertical_ailos(LAW, ze, 0.0, 1.0, levelled(water, 0.0, 0.0), water, 0.0, 0.0, STEEPEST)
    assert sign * found.theta_d > 0.1


@pytest.mark.parametrize(("Vb", "sign"), [(0.1, 1.0), (-0.1, -1.0)], ids=["downwards", "upwards"])
def test_a_vertical_current_is_pitched_against(Vb: float, sign: float) -> None:
    water = (1.5, 0.0, 0.0)
    found = vertical_ailos(LAW, 0.0, 0.0, 1.0, levelled(water, 0.0, 0.0), water, 0.0, Vb, STEEPEST)
    assert math.sin(found.gamma_d) * 1.5 == pytest.approx(Vb, rel=1e-9)
    assert sign * found.theta_d > 0.0


def test_the_angle_of_attack_is_part_of_the_pitch() -> None:
    """A hull that sinks through the water by 5 cm/s ahead of 1.5 has to point up by it to go level."""
    water = (1.5, 0.0, 0.05)
    found = vertical_ailos(LAW, 0.0, 0.0, 1.0, levelled(water, 0.0, 0.0), water, 0.0, 0.0, STEEPEST)
    assert levelled(water, 0.0, found.theta_d).down == pytest.approx(0.0, abs=1e-12)


def test_the_pitch_is_bounded_and_zero_speed_divides_by_nothing() -> None:
    water = (0.0, 0.0, 0.0)
    found = vertical_ailos(LAW, 100.0, 0.0, 1.0, levelled(water, 0.0, 0.0), water, 0.0, 0.3, STEEPEST)
    assert (found.theta_d, found.theta_b) == (STEEPEST, 0.0)


@pytest.mark.parametrize(
    ("off", "expected"),
    [(0.0, 0.3), (math.pi / 2.0, 0.0), (math.pi, -0.3)],
    ids=["along", "across", "against"],
)
def test_the_elevation_that_is_seen_along_the_own_course(off: float, expected: float) -> None:
    gamma_a, rho = elevation_seen(1.0 + off, tangent(1.0, 0.3))
    assert gamma_a == pytest.approx(expected, abs=1e-12)
    assert math.cos(0.3) - 1e-12 <= rho <= 1.0 + 1e-12


@given(st.floats(-1.2, 1.2), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_euler_rates_are_the_rates_of_the_angles(theta, phi, q, r) -> None:
    h, p = 1e-6, 0.2
    skew = np.array([[0, -r, q], [r, 0, -p], [-q, p, 0]])
    later = rotation(phi, theta, 0.4) @ (np.eye(3) + h * skew + 0.5 * h * h * skew @ skew)
    psi_rate, theta_rate = euler_rates(phi, theta, q, r)
    assert (math.atan2(later[1, 0], later[0, 0]) - 0.4) / h == pytest.approx(psi_rate, abs=1e-4)
    assert (math.asin(-later[2, 0]) - theta) / h == pytest.approx(theta_rate, abs=1e-4)
