"""REMUS in six degrees of freedom: the planar limit, energy, eigenvalues, trim and signs."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.pure import numbers_of
from auv_msgs_py.values.types import Current
from auv_path_following import vehicle
from auv_path_following.vertical_hull import level_trim, reversal_speed
from auv_sim.vehicle.hulls.remus_6dof import (
    Remus6dof,
    remus_6dof_of,
    remus_6dof_step,
    remus_accelerations,
    remus_loads,
    terms_of,
)
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of, body_at, quaternion_of
from auv_sim.vehicle.remus import PlantState, planar_hull_of, planar_step
from hulls import PRINTED, RADIUS, with_vertical

STILL, NEUTRAL = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
PLANAR = vehicle.load("remus100")


def hull(**changes: float) -> Remus6dof:
    return remus_6dof_of(with_vertical(**changes))


def flat() -> Remus6dof:
    """Without what couples the planes: no arm of the weight, no buoyancy to spare, no propeller torque."""
    made = with_vertical(zg=1e-300, B=299.0, Kprop=0.0)
    no_arm = numbers_of(made.vertical)._replace(zg=0.0)
    return remus_6dof_of(made)._replace(terms=terms_of(numbers_of(made), no_arm))


def test_planar_limit() -> None:
    """60 s of a weaving rudder in a current: the planar plant's track within 1e-8 m."""
    config, planar, dt = flat(), planar_hull_of(PLANAR), 0.02
    body, plane = body_at(0.0, 0.0, 10.0, 0.0, 0.0, 0.3, 1.5), PlantState(0.0, 0.0, 0.3, 1.5, 0.0, 0.0)
    for k in range(3000):
        rudder = tuple(math.radians(10.0) * math.sin(0.3 * dt * (k + share)) for share in (0.0, 0.5, 1.0))
        body, _ = remus_6dof_step(config, body, (rudder, NEUTRAL, 3.86, (0.1, 0.2, 0.0)), dt)
        plane, _ = planar_step(planar, plane, (rudder, 3.86, Current(0.1, 0.2)), dt)
        assert math.hypot(body.x - plane.x, body.y - plane.y) < 1e-8
    assert (body.z, body.wr, body.q) == pytest.approx((10.0, 0.0, 0.0), abs=1e-12)


def test_energy_is_kept_without_lift_and_drag() -> None:
    """Added mass, inertia and gyroscopic terms alone neither give nor take: 30 s at 0.01 s."""
    lost = ("Zww", "Zqq", "Zuw", "Zuud", "Kpp", "Mww", "Mqq", "Muw", "Muud")
    made = with_vertical(B=299.0, Kprop=0.0, Mrp=-0.0704 + 4.88, Npq=0.0704 - 4.88, Zuq=-35.5, Muq=-1.93)
    planar = numbers_of(made)._replace(
        Xuu=0.0, Yvv=0.0, Yrr=0.0, Yuv=0.0, Nvv=0.0, Nrr=0.0, Nuv=0.0, Yuud=0.0, Nuud=0.0,
    )  # fmt: skip
    vertical = numbers_of(made.vertical)._replace(**dict.fromkeys(lost, 0.0))
    h, c = planar, vertical
    # The body's own terms of added mass: C_A of a diagonal M_A with heave-pitch and sway-yaw couplings.
    planar = h._replace(Xvr=-h.Yvd, Xrr=-h.Yrd, Yur=h.Xud, Nur=h.Yrd, Nuv=-(h.Xud - h.Yvd))
    vertical = c._replace(
        Xwq=c.Zwd, Xqq=c.Zqd, Ywp=-c.Zwd, Ypq=-c.Zqd, Zuq=-h.Xud, Zvp=h.Yvd, Zrp=h.Yrd, Muw=-(c.Zwd - h.Xud),
        Muq=-c.Zqd, Mvp=-h.Yrd, Mrp=c.Kpd - h.Nrd, Nwp=c.Zqd, Npq=-(c.Kpd - c.Mqd),
    )  # fmt: skip
    config = remus_6dof_of(made)._replace(terms=terms_of(planar, vertical))
    body = BodyState(0.0, 0.0, 50.0, *quaternion_of(0.2, 0.1, 0.0), 1.0, 0.1, -0.2, 0.3, 0.1, -0.2)
    before = energy(config, body)
    for _ in range(3000):
        body, _ = remus_6dof_step(config, body, (NEUTRAL, NEUTRAL, 0.0, STILL), 0.01)
    assert energy(config, body) == pytest.approx(before, rel=3e-6)


def energy(config: Remus6dof, body: BodyState) -> float:
    """Kinetic energy with added mass, and the potential of the weight's arm."""
    first = np.linalg.inv(np.reshape(config.surge_heave_pitch, (3, 3)))
    second = np.linalg.inv(np.reshape(config.sway_roll_yaw, (3, 3)))
    a, b = np.array([body.ur, body.wr, body.q]), np.array([body.vr, body.p, body.r])
    phi, theta, _ = angles_of(body)
    height = (config.terms.W_zg / config.terms.W) * math.cos(theta) * math.cos(phi)
    return float(0.5 * a @ first @ a + 0.5 * b @ second @ b) - config.terms.W * height


@pytest.mark.parametrize(
    ("speed", "vertical", "lateral"),
    [
        (1.5, (-2.12, 0.42 - 0.21j, 0.42 + 0.21j), (-2.27, -0.008 - 4.93j, -0.008 + 4.93j, 0.99)),
        (2.0, (-2.916, 0.211, 1.00), (-3.02, -0.011 - 4.93j, -0.011 + 4.93j, 1.32)),
    ],
)
def test_eigenvalues_of_the_printed_hull(speed: float, vertical: tuple, lateral: tuple) -> None:
    config = hull(B=299.0, Kprop=0.0)

    def pitching(w: float, q: float, theta: float) -> tuple[float, ...]:
        body = BodyState(0.0, 0.0, 10.0, *quaternion_of(0.0, theta, 0.0), speed, 0.0, w, 0.0, q, 0.0)
        rates = remus_accelerations(config, body, 0.0, 0.0, 1.62 * speed * speed)
        return rates[2], rates[4], q

    def rolling(v: float, p: float, r: float, phi: float) -> tuple[float, ...]:
        body = BodyState(0.0, 0.0, 10.0, *quaternion_of(phi, 0.0, 0.0), speed, v, 0.0, p, 0.0, r)
        rates = remus_accelerations(config, body, 0.0, 0.0, 1.62 * speed * speed)
        return rates[1], rates[3], rates[5], p

    for function, expected in ((pitching, vertical), (rolling, lateral)):
        n = len(expected)
        steps = 1e-6 * np.eye(n)
        jacobian = np.array([np.subtract(function(*e), function(*-e)) / 2e-6 for e in steps]).T
        assert np.allclose(np.sort_complex(np.linalg.eigvals(jacobian)), expected, atol=0.006)


def test_planes_work_backwards_below_the_reversal_speed() -> None:
    """(3D-5): u_rev = sqrt(a / k) = 0.372 m/s; below it planes that put the bow down make the hull rise."""
    reversal = reversal_speed(PRINTED)
    assert reversal == pytest.approx(0.372, abs=5e-4)
    config = hull(B=299.0, Kprop=0.0)
    for share, sign in ((0.8, -1.0), (1.3, 1.0)):  # deeper or shallower after 300 s with the bow put down
        speed, planes = share * reversal, (math.radians(1.0),) * 3
        body = body_at(0.0, 0.0, 50.0, 0.0, 0.0, 0.0, speed)
        for _ in range(3000):
            body, _ = remus_6dof_step(config, body, (NEUTRAL, planes, 1.62 * speed * speed, STILL), 0.1)
        assert sign * (body.z - 50.0) > 0.05


@pytest.mark.parametrize("ballast", [3.34, 7.0, -3.0])
def test_level_trim_holds_the_depth(ballast: float) -> None:
    """Heave force and pitch moment vanish on a level way at the pitch and planes of the trim."""
    theta, planes = level_trim(dataclasses.replace(PRINTED, B=299.0 + ballast), 1.25)
    config = hull(B=299.0 + ballast, Kprop=0.0)
    u, w = 1.25 * math.cos(theta), 1.25 * math.sin(theta)
    body = BodyState(0.0, 0.0, 50.0, *quaternion_of(0.0, theta, 0.0), u, 0.0, w, 0.0, 0.0, 0.0)
    _, _, Z, _, M, _ = remus_loads(config, body, 0.0, planes, 2.5)
    assert pytest.approx((0.0, 0.0), abs=1e-9) == (Z, M)
    if ballast == 3.34:
        assert math.degrees(theta) == pytest.approx(-1.89, abs=0.05)
        assert math.degrees(planes) == pytest.approx(-6.3, abs=0.05)


def test_the_propeller_rolls_the_hull_to_port_until_the_weight_holds_it() -> None:
    """8.9 degrees at 6.48 N: there the moments are in balance, upright the hull begins to roll to port."""
    config = hull(B=299.0)
    roll = -math.asin(0.141 * 6.48 / (0.0196 * 299.0))
    assert math.degrees(roll) == pytest.approx(-8.9, abs=0.1)
    rolled = remus_accelerations(config, body_at(0.0, 0.0, 30.0, roll, 0.0, 0.0, 2.0), 0.0, 0.0, 6.48)
    upright = remus_accelerations(config, body_at(0.0, 0.0, 30.0, 0.0, 0.0, 0.0, 2.0), 0.0, 0.0, 6.48)
    assert rolled[3] == pytest.approx(0.0, abs=1e-12)
    assert upright[3] < -1.0


def test_a_light_hull_without_thrust_floats_up_and_stays_at_the_surface() -> None:
    """Level at first: 0.16 m/s at 3.34 N; at the surface it lies still with its spare buoyancy in the air."""
    config = hull()
    c = config.terms
    body = BodyState(0.0, 0.0, 5.0, *quaternion_of(0.0, 0.0, 0.0), *(0.0,) * 6)
    fastest = 0.0
    for _ in range(6000):
        body, _ = remus_6dof_step(config, body, (NEUTRAL, NEUTRAL, 0.0, STILL), 0.05)
        fastest = min(fastest, body.wr)
    assert -fastest == pytest.approx(math.sqrt((c.B - c.W) / -c.Zww), rel=0.05)
    assert 0.0 < body.z < RADIUS
    assert abs(body.wr) < 5e-3


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_fins_have_the_signs_of_this_suite(sign: float) -> None:
    config = hull(B=299.0, Kprop=0.0)
    body = body_at(0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 1.5)
    fin = (sign * 0.1,) * 3
    turned = dived = body
    for _ in range(100):
        turned, _ = remus_6dof_step(config, turned, (fin, NEUTRAL, 3.86, STILL), 0.02)
        dived, _ = remus_6dof_step(config, dived, (NEUTRAL, fin, 3.86, STILL), 0.02)
    assert sign * angles_of(turned)[2] < -0.01
    assert sign * angles_of(dived)[1] < -0.01
    assert sign * (dived.z - 20.0) > 0.0


def test_a_planar_hull_cannot_be_flown() -> None:
    with pytest.raises(ConfigurationError, match=r"hull\.vertical: found nothing"):
        remus_6dof_of(PLANAR.coefficients)


def test_a_hull_whose_roll_nothing_damps_is_refused() -> None:
    with pytest.raises(ValueError, match="keys that do not fit"):
        dataclasses.replace(PRINTED, Kpp=0.0)
