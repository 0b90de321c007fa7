"""The rudder of hulls that the file does not describe, judged by turning radius, length and speed alone."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from auv_path_following import vehicle
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.vehicle import Vehicle
from auv_sim.checks.vehicle_check.items.fits import STEP, Fit
from auv_sim.checks.vehicle_check.items.turning import fit_turning
from auv_sim.checks.vehicle_check.wiggle import END, Wiggle
from auv_sim.vehicle.fins.actuator import with_rate
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.simulated import SimulatedVehicle

REMUS = vehicle.load("remus100")
assert REMUS.hull is not None
#: Holds its course, drifts slowly, and has a fast servo: in all of that unlike the shipped hulls.
STABLE = dataclasses.replace(
    REMUS,
    rudder=vehicle.Rudder(max_angle_deg=20.0, max_rate_deg_s=300.0),
    hull=dataclasses.replace(
        REMUS.hull, m=31.9, Yvd=-31.9, Xvr=31.9, Yvv=-155.0, Yuv=-1.0, Yur=-0.93, Nrr=-20.0, Nur=-4.165,
        Nuv=0.0, Nvv=0.0, Nuud=-3.33, Yuud=4.8, Yrd=0.0, Nvd=0.0,
    ),
)  # fmt: skip
HULLS = {
    "remus100": REMUS,
    "weak rudder": vehicle.load("remus100_mismatch"),
    "table 2": vehicle.load("remus100_table2"),
    "stable": STABLE,
}


def flown(hull: Vehicle, scale: float = 1.0, rate: float = 1.0, delay: float = 0.0) -> Fit:
    """The small test, flown by a hull whose driver changes the rudder; the fit by its radius and speed."""
    plant = SimulatedVehicle(with_rate(hull, rate), PlantState(0.0, 0.0, 0.3, 0.0, 0.0, 0.0))
    t = np.arange(0.0, END, STEP)
    commands = [Wiggle.of(hull).at(float(now)) for now in t]
    late = round(delay / STEP)
    speed, yaw_rate = np.empty_like(t), np.empty_like(t)
    for k in range(t.size):
        speed[k], yaw_rate[k] = plant.motion.ur, -plant.motion.r
        obeyed = commands[max(k - late, 0)]
        plant.advance(obeyed._replace(rudder=scale * obeyed.rudder), STEP)
    rudder = np.array([command.rudder for command in commands])
    known = dataclasses.replace(
        hull,
        hull=None,
        cruise=vehicle.Cruise(thrust=hull.thrust_max, speed=hull.top_speed),
        turning=vehicle.Turning(radius=tightest_turn(hull).radius),
    )
    return fit_turning(t, rudder, speed, t, yaw_rate, known)


@pytest.mark.parametrize("sign", [1.0, -1.0])
@pytest.mark.parametrize("name", HULLS)
def test_sign_scale_and_rate_of_any_hull_are_found(name: str, sign: float) -> None:
    fit = flown(HULLS[name], scale=sign)
    assert 0.7 < sign * fit.gain < 1.4
    assert (fit.scale, fit.rate) == (1.0, 1.0)
    assert fit.delay <= 0.15
    assert fit.unexplained < 0.05


@pytest.mark.parametrize("name", HULLS)
def test_degrees_for_radians_and_the_reverse_are_found_on_any_hull(name: str) -> None:
    for factor in (np.pi / 180.0, 180.0 / np.pi):
        assert flown(HULLS[name], scale=factor).scale == pytest.approx(factor)


@pytest.mark.parametrize("name", HULLS)
def test_a_long_dead_time_is_found_on_any_hull(name: str) -> None:
    assert 0.4 < flown(HULLS[name], delay=0.7).delay < 0.8


@pytest.mark.parametrize("name", ["remus100", "weak rudder"])
def test_a_slow_rudder_is_found(name: str) -> None:
    assert flown(HULLS[name], rate=0.25).rate == pytest.approx(0.25, abs=0.1)
