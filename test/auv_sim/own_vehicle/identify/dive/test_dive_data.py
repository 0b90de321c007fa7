"""What the filter of heave and pitch is given: the motion of the hull in six degrees of freedom."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import pytest

from auv_path_following import vehicle as vehicle_file
from auv_sim.own_vehicle.identify.combinations import COUNT
from auv_sim.own_vehicle.identify.dive.dive_combinations import dive_combinations_of
from auv_sim.own_vehicle.identify.dive.dive_data import DiveData, coupling_of, dive_passage_of
from auv_sim.own_vehicle.identify.dive.dive_filter import dive_rates
from auv_sim.own_vehicle.identify.dive.surge_fit import surge_of
from auv_sim.own_vehicle.identify.innovations import channels_of, filtered
from auv_sim.own_vehicle.identify.unknowns import ALL, RATE, DataSheet
from auv_sim.vehicle.hulls.remus_6dof import remus_6dof_of, remus_accelerations
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at

REMUS = vehicle_file.load("remus100_6dof_corrected")
HULL = REMUS.coefficients
assert HULL.vertical is not None
VERTICAL = HULL.vertical


def test_a_hull_that_turns_while_it_is_pitched_has_a_roll_rate_without_a_change_of_roll() -> None:
    pitch, rate, sway = 0.2, 0.3, -0.2
    t, water_t = np.arange(0.0, 20.0, 0.05), np.arange(0.0, 20.0, 0.2)
    here, log = np.ones(t.size), np.ones(water_t.size)
    turning = rate * math.cos(pitch)  # r of a turn of `rate` about the vertical, without roll
    data = DiveData(
        "turn", t, 0.0 * here, pitch * here, 0.0 * here, turning * here, water_t, 1.5 * log, sway * log,
        0.1 * log, t, 0.0 * here, t, here, coupling_of(HULL, VERTICAL),
    )  # fmt: skip
    given = dive_passage_of(data, 0.0).grid.thrust
    p = -rate * math.sin(pitch)
    by_roll = data.coupling.by_roll @ np.array([sway * p, turning * p])
    middle = given[len(given) // 2]
    assert middle[4:6] == pytest.approx(by_roll)
    assert middle[7] == pytest.approx(p * p)


@pytest.mark.parametrize("rates", [(0.3, 0.25, -0.4), (0.0, -0.3, 0.0)])
def test_heave_and_pitch_accelerate_as_the_hull_in_six_degrees_of_freedom(rates: tuple[float, ...]) -> None:
    (u, v, w), (p, q, r), (phi, theta), planes = (1.6, -0.2, 0.12), rates, (0.1, -0.2), 0.1
    body = BodyState(*body_at(0.0, 0.0, 20.0, phi, theta, 0.3, u))._replace(vr=v, wr=w, p=p, q=q, r=r)
    du, _, dw, _, dq, _ = remus_accelerations(remus_6dof_of(HULL), body, 0.05, planes, 4.0)
    coupling = coupling_of(HULL, VERTICAL)
    by_roll = coupling.by_roll @ np.array([v * p, r * p])
    given = (
        u, math.cos(phi), r * math.sin(phi), (du - v * r) / 9.81, *by_roll, coupling.lever / 9.81, p * p,
    )  # fmt: skip
    c = dive_combinations_of(HULL.m, VERTICAL)
    _, found_w, found_q = dive_rates(c, u, given, theta, w, q, planes)
    assert found_w == pytest.approx(dw, abs=1e-4)
    assert found_q == pytest.approx(dq, abs=1e-3)


def test_an_offset_of_the_measured_pitch_that_does_not_move_the_hull_is_its_drift() -> None:
    offset, t, water_t = math.radians(0.15), np.arange(0.0, 30.0, 0.05), np.arange(0.0, 30.0, 0.2)
    here, log = np.ones(t.size), np.ones(water_t.size)
    data = DiveData(
        "level", t, 0.0 * here, offset * here, 0.0 * here, 0.0 * here, water_t, 0.2 * log, 0.0 * log,
        0.0 * log, t, 0.0 * here, t, here, coupling_of(HULL, VERTICAL),
    )  # fmt: skip
    channels = channels_of([data], DataSheet(latency=0.0), 0.0)
    neutral = dataclasses.replace(VERTICAL, B=VERTICAL.W, xg=0.0)
    physical = np.zeros(ALL)
    physical[:COUNT], physical[RATE] = dive_combinations_of(HULL.m, neutral), 0.3
    states = filtered(channels.passages[0], channels, physical)
    assert abs(states[-1, 0]) < 0.3 * offset


def test_what_is_given_for_a_step_is_the_motion_in_its_middle() -> None:
    t, water_t = np.arange(0.0, 20.0, 0.05), np.arange(0.0, 20.0, 0.2)
    here, log = np.ones(t.size), np.ones(water_t.size)
    data = DiveData(
        "turn", t, 0.0 * here, 0.0 * here, 0.1 * here, 0.02 * t, water_t, 1.5 * log, 0.0 * log, 0.0 * log, t,
        0.0 * here, t, here, coupling_of(HULL, VERTICAL),
    )  # fmt: skip
    passage = dive_passage_of(data, 0.0)
    middle = 0.5 * (passage.times[:-1] + passage.times[1:])
    inside = slice(10, -10)
    assert passage.grid.thrust[inside, 2] == pytest.approx(0.02 * middle[inside] * math.sin(0.1), rel=1e-6)


def test_the_surge_of_a_dive_follows_thrust_steps_and_zigzags_through_the_noise_of_the_log() -> None:
    generator, step = np.random.default_rng(1), 0.05
    t = np.arange(0.0, 120.0, step)
    thrust, weight = 1.0 - 0.4 * (np.floor(t / 20.0) % 2), np.sin(2.0 * math.pi * t / 6.0)
    u = np.zeros(t.size)
    for k in range(1, t.size):
        slow = 1.0 + 0.02 * math.sin(t[k] / 15.0)  # the thruster's drift
        u[k] = u[k - 1] + step * (0.2 * slow * thrust[k] - 0.05 * u[k - 1] ** 2 - 0.04 * weight[k])
    log = u[::4] + 0.015 * generator.normal(size=u[::4].size)
    surge = surge_of(t, np.array([thrust, u * u, weight]), t[::4], log)
    true_rate = np.gradient(u, t)
    assert np.std(surge.u - u) < 0.005
    assert np.std(surge.rate - true_rate) < 0.15 * np.std(true_rate)
