"""The instruments of a vehicle that dives, together."""

from __future__ import annotations

import math

import numpy as np
import pytest
from pydantic import ValidationError

from auv_sim.vehicle.diving.bottom import BottomConfig, bottom_of
from auv_sim.vehicle.diving.diver_sensors import SpatialMeasurements, sense_in_space, spatial_sensors_of
from auv_sim.vehicle.draws import Draws, Now
from auv_sim.vehicle.hulls.rigid_body import BodyState, quaternion_of
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sensors import AngleConfig, SensorsConfig, sense, sensors_of
from auv_sim.vehicle.velocity_log import VelocityConfig

SEED = (5, 2)
TRUTH = BodyState(10.0, -4.0, 12.0, *quaternion_of(0.1, -0.2, 1.5), 1.9, -0.02, 0.03, 0.01, -0.05, 0.1)
GROUND = (2.0, 0.1, -0.04)
NOISY = AngleConfig(noise_deg=NoiseConfig(white=2.0))


def measured(
    config: SensorsConfig, steps: int, bottom: BottomConfig | None = None
) -> list[SpatialMeasurements]:
    """What a vehicle that keeps its state measures."""
    draws = Draws(0.05, steps)
    sensors, state = spatial_sensors_of(config, SEED, draws)
    below = bottom_of(bottom or BottomConfig(), draws)
    memory, seen = draws.memory(), []
    for k in range(steps):
        now = Now(memory, 0.05 * k, k)
        state, m = sense_in_space(sensors, state, TRUTH, GROUND, below, now, 0.05 if k else 0.0)
        seen.append(m)
    return seen


def test_ideal_instruments_report_the_truth_at_every_step() -> None:
    for m in measured(SensorsConfig(), 3, BottomConfig(depth=30.0)):
        assert (m.phi, m.theta, m.psi, m.q, m.r) == pytest.approx((0.1, -0.2, 1.5, -0.05, 0.1))
        assert (m.depth, m.water, m.ground) == (12.0, (1.9, -0.02, 0.03), GROUND)
        assert m.altitude * math.cos(0.1) * math.cos(-0.2) == pytest.approx(18.0)
        assert (m.water_lock, m.bottom_lock, m.is_depth_new) == (True, True, True)


@pytest.mark.parametrize("name", ["roll", "pitch", "heading", "pitch_rate", "yaw_rate"])
def test_each_angle_and_rate_has_its_own_noise(name: str) -> None:
    columns = dict(zip(("roll", "pitch", "heading", "pitch_rate", "yaw_rate"), range(5), strict=True))
    config = SensorsConfig(**{name: NOISY})  # type: ignore[arg-type]
    seen = np.array([m[:5] for m in measured(config, 5000)])
    deviations = np.degrees(seen.std(axis=0))
    assert deviations[columns[name]] == pytest.approx(2.0, rel=0.05)
    assert np.delete(deviations, columns[name]) == pytest.approx(np.zeros(4), abs=1e-9)


def test_no_two_noises_are_equal() -> None:
    config = SensorsConfig(roll=NOISY, pitch=NOISY, heading=NOISY, pitch_rate=NOISY, yaw_rate=NOISY)
    correlation = np.corrcoef(np.array([m[:5] for m in measured(config, 5000)]).T)
    assert abs(correlation - np.eye(5)).max() < 0.06


@pytest.mark.parametrize(("bottom", "lock"), [(51.0, True), (53.0, False), (0.0, True)])
def test_the_log_over_ground_loses_a_bottom_far_below(bottom: float, lock: bool) -> None:
    config = SensorsConfig(bottom_track=VelocityConfig(highest=40.0))
    m = measured(config, 1, BottomConfig(depth=bottom))[0]
    assert (m.bottom_lock, m.water_lock) == (lock, True)


def test_a_log_of_the_water_has_no_largest_height() -> None:
    with pytest.raises(ValidationError, match="keys that do not fit"):
        SensorsConfig(water_track=VelocityConfig(highest=40.0))


def test_compass_and_yaw_gyro_are_those_of_a_vehicle_in_the_plane() -> None:
    config = SensorsConfig(heading=NOISY, yaw_rate=NOISY)
    draws = Draws(0.05, 20)
    sensors, state = sensors_of(config, SEED, draws)
    memory, level = draws.memory(), PlantState(10.0, -4.0, 1.5, 1.9, -0.02, 0.1)
    for k, m in enumerate(measured(config, 20)):
        state, flat = sense(sensors, state, level, 2.0, 0.1, Now(memory, 0.05 * k, k), 0.05 if k else 0.0)
        assert (m.psi, m.r) == pytest.approx((flat.psi, flat.r), abs=1e-12)
