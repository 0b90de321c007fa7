"""The controllers' hull model and SMC's equivalent control against the plant's own yaw dynamics."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle
from auv_path_following.control import smc as smc_law
from auv_path_following.control.controller import HeadingInputs
from auv_path_following.control.hull_model import HullModel, accelerations, rudder_gain, sway_after
from auv_path_following.control.smc import SmcConfig
from auv_sim.vehicle.remus import planar_hull_of, planar_slopes
from laws import flown

HULLS = [vehicle.load(name) for name in ("remus100", "remus100_table2", "remus100_mismatch")]
DT = 0.05

hulls = st.sampled_from(HULLS)
speeds, sways, rates = st.floats(0.5, 2.5), st.floats(-0.3, 0.3), st.floats(-0.5, 0.5)


def plant_yaw(hull, ur, vr, r, delta):
    """(dvr/dt, dr/dt) of the simulator."""
    return planar_slopes(planar_hull_of(hull), 0.0, ur, vr, r, delta, 6.48)[3:]


@given(hulls, speeds, sways, rates, st.floats(-0.6, 0.6))
def test_the_controllers_hull_is_the_plants(hull, ur, vr, r, delta):
    model = HullModel(hull).sway_yaw
    gains = rudder_gain(model, ur)
    own = [a + b * delta for a, b in zip(accelerations(model, ur, vr, r), gains, strict=True)]
    assert own == pytest.approx(plant_yaw(hull, ur, vr, r, delta), rel=1e-9, abs=1e-9)


@given(hulls, sways, rates, st.floats(-0.3, 0.3), st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_the_equivalent_rudder_keeps_sigma(hull, vr, r, psi_e, r_d, r_d_dot):
    config = dataclasses.replace(SmcConfig(), largest_rate=5.0)
    prepared = smc_law.prepare(config, hull)
    delta = smc_law.equivalent(prepared, HeadingInputs(psi_e, r, 0.0, r_d, r_d_dot, 6.48), 2.0, vr)
    # sigma' = r' - r_d' + slope (r - r_d) = 0
    sigma_dot = plant_yaw(hull, 2.0, vr, r, delta)[1] - r_d_dot + config.slope * (r - r_d)
    assert sigma_dot == pytest.approx(0.0, abs=1e-9)


@settings(max_examples=40)
@given(st.lists(st.tuples(st.floats(-math.pi, math.pi), st.floats(-1.0, 1.0)), min_size=2, max_size=60))
def test_angle_and_rate_never_exceed_the_rudders(seen):
    smc, last, rudder = flown(smc_law.LAW, vehicle=HULLS[0]), 0.0, HULLS[0].rudder
    for psi_e, r in seen:
        angle = smc.update(HeadingInputs(psi_e, r, 0.0, 0.0, 0.0, 6.48), DT).rudder
        assert abs(angle) <= rudder.max_angle
        assert abs(angle - last) <= rudder.max_rate * DT * (1 + 1e-9)
        last = angle


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_too_far_to_starboard_turns_to_port(sign):
    smc = flown(smc_law.LAW, vehicle=HULLS[0])
    for _ in range(20):
        rudder = smc.update(HeadingInputs(sign * 0.2, 0.0, 0.0, 0.0, 0.0, 6.48), DT).rudder
    assert sign * rudder > 0.0


def test_without_thrust_there_is_nothing_to_steer_with():
    assert (
        flown(smc_law.LAW, vehicle=HULLS[0]).update(HeadingInputs(0.5, 0.1, 0.0, 0.0, 0.0, 0.0), DT).rudder
        == 0.0
    )


def test_the_estimated_sway_is_that_of_a_steady_turn():
    hull = HULLS[0]
    model, vr = HullModel(hull).sway_yaw, 0.0
    for _ in range(400):
        vr = sway_after(model, 2.0, vr, 0.1, -0.1, DT)
    assert vr < 0.0  # a turn to starboard slides to port
    assert plant_yaw(hull, 2.0, vr, 0.1, -0.1)[0] == pytest.approx(0.0, abs=1e-6)
