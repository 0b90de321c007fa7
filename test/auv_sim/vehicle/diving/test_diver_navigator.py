"""Dead reckoning in three dimensions: depth by pressure, satellite fixes at the surface."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_msgs_py.values.types import NO_SPATIAL_CURRENT, SpatialCommand
from auv_sim.vehicle.currents import CurrentConfig
from auv_sim.vehicle.diving.depth_sensor import DepthConfig
from auv_sim.vehicle.diving.simulated_diver import SimulatedDiver
from auv_sim.vehicle.diving.surface_fixes import SurfaceFixConfig
from auv_sim.vehicle.hulls.rigid_body import body_at
from auv_sim.vehicle.navigator import NavigatorConfig
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.position_fixes import FixConfig
from auv_sim.vehicle.sea import Sea
from auv_sim.vehicle.sensors import SensorsConfig
from auv_sim.vehicle.velocity_log import VelocityConfig
from hulls import DIVER

NO_FIXES = FixConfig(fitted=False)
SURE = NavigatorConfig(start=1e-6)


def diver(
    sensors: SensorsConfig, navigator: NavigatorConfig, z: float = 10.0, pitch: float = 0.0, **sea: object
):
    begin = body_at(0.0, 0.0, z, 0.0, pitch, 0.5, 1.5)
    return SimulatedDiver(DIVER, begin, Sea(name="x", sensors=sensors, navigator=navigator, **sea), 3)  # type: ignore[arg-type]


def off(simulated: SimulatedDiver) -> float:
    truth = simulated.truth[0]
    return math.hypot(simulated.navigation.x - truth.x, simulated.navigation.y - truth.y)


def straight_on(simulated: SimulatedDiver, z: float, steps: int) -> None:
    """Go ahead on an even keel at one depth."""
    for _ in range(steps):
        at = simulated.motion
        simulated.place(body_at(at.x, at.y, z, 0.0, 0.0, 0.5, 1.9))
        simulated.advance(SpatialCommand(0.0, 0.0, 6.0), 0.05)


def test_ideal_instruments_lead_to_the_truth_without_a_fix() -> None:
    """Rolled, pitched and turning in an upwelling: velocities are levelled before they are summed."""
    sensors = SensorsConfig(position=NO_FIXES)
    simulated = diver(sensors, SURE, current=CurrentConfig(schedule=((0.0, 0.2, 0.1, -0.05),)))
    for k in range(400):
        simulated.advance(SpatialCommand(0.1, -0.1 * math.cos(0.05 * k), 6.0), 0.05)
        truth = simulated.truth[0]
        assert simulated.navigation[2:] == pytest.approx(truth[2:], abs=1e-12)
    assert math.hypot(truth.x, truth.y) > 10.0
    assert off(simulated) < 0.01


def test_between_two_pressures_depth_follows_the_velocity_down() -> None:
    """A dive at 15 deg with a pressure in two seconds: held, it would be off by almost a metre."""
    sensors = SensorsConfig(depth=DepthConfig(rate=0.5), position=NO_FIXES)
    simulated = diver(sensors, SURE, pitch=-0.25)
    errors = []
    for _ in range(200):
        simulated.advance(SpatialCommand(0.0, 0.05, 6.0), 0.05)
        errors.append(simulated.navigation.z - simulated.truth[0].z)
    assert simulated.truth[0].z > 13.0
    assert max(map(abs, errors)) < 0.05


def test_a_time_constant_smooths_the_depth() -> None:
    noise = NoiseConfig(white=0.1)
    deviations = []
    for time in (0.0, 1.0):
        sensors = SensorsConfig(depth=DepthConfig(noise=noise), position=NO_FIXES)
        simulated = diver(sensors, NavigatorConfig(start=1e-6, depth_time=time))
        errors = []
        for _ in range(600):
            simulated.advance(SpatialCommand(0.0, 0.0, 6.0), 0.05)
            errors.append(simulated.navigation.z - simulated.truth[0].z)
        deviations.append(np.std(errors[100:]))
    # White noise through a lag T in steps of dt has sqrt(dt / (2 T)) of its deviation.
    assert deviations == pytest.approx([0.1, 0.1 * math.sqrt(0.05 / 2.0)], rel=0.2)


def test_dead_reckoning_grows_under_water_and_ends_at_the_surface() -> None:
    """A log with a scale error of some per cent, no acoustic fixes; then the vehicle surfaces."""
    sensors = SensorsConfig(
        bottom_track=VelocityConfig(scale=0.05),
        position=NO_FIXES,
        surface_fix=SurfaceFixConfig(acquisition=2.0, rate=1.0),
    )
    simulated = diver(sensors, NavigatorConfig(start=0.1, surface_fix=0.5, blend=1.0))
    grown = []
    for _ in range(3):
        straight_on(simulated, 10.0, 200)
        grown.append(off(simulated))
    assert 0.3 < grown[0] < grown[1] < grown[2]
    straight_on(simulated, 0.0, 30)
    assert off(simulated) > 0.9 * grown[2]  # no satellites yet
    straight_on(simulated, 0.0, 170)
    assert off(simulated) < 0.5 * grown[2]


def test_a_wrong_vertical_velocity_does_not_accumulate_in_the_depth() -> None:
    simulated = diver(SensorsConfig(bottom_track=VelocityConfig(lock=False)), NavigatorConfig(depth_time=1.0),
                      current=CurrentConfig(schedule=((0.0, 0.0, 0.0, 0.1),)))  # fmt: skip
    for _ in range(400):
        simulated.advance(SpatialCommand(0.0, -0.05, 6.0), 0.05)
    # Its log of the water misses 0.1 m/s for a time constant of 1 s.
    assert simulated.navigation.z - simulated.truth[0].z == pytest.approx(-0.1, abs=0.02)
    assert simulated.constant_current == NO_SPATIAL_CURRENT
