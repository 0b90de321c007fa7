"""The instruments together, compass and gyro."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.vehicle.draws import Draws, Now, slot
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.position_fixes import FixConfig
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.sensors import AngleConfig, Measurements, SensorsConfig, sense, sensors_of

SEED = (5, 2)
TRUTH = PlantState(x=10.0, y=-4.0, psi=7.0, ur=1.9, vr=-0.02, r=0.1)


def measured(config: SensorsConfig, steps: int) -> tuple[list[Measurements], list[tuple[float, float]]]:
    """What a vehicle that keeps its state measures; the fixes that arrive."""
    draws = Draws(0.05, steps)
    sensors, state = sensors_of(config, SEED, draws)
    memory, seen, fixes = draws.memory(), [], []
    for k in range(steps):
        now = Now(memory, 0.05 * k, k)
        state, m = sense(sensors, state, TRUTH, 2.0, 0.1, now, 0.05 if k else 0.0)
        seen.append(m)
        for number in range(m.first, m.after):
            _, x, y = memory.kept[slot(sensors.position.ring, number) :][:3]
            fixes.append((x, y))
    return seen, fixes


def test_ideal_instruments_report_the_truth_at_every_step() -> None:
    seen, fixes = measured(SensorsConfig(), 3)
    for m in seen:
        assert m.psi == pytest.approx(7.0 - 2.0 * math.pi)
        assert (m.r, tuple(m.water), m.u, m.v) == (0.1, (1.9, -0.02), 2.0, 0.1)
        assert m.water_lock and m.bottom_lock
    assert fixes == [(10.0, -4.0)] * 3


def test_angles_are_configured_in_degrees_and_reported_in_radians() -> None:
    seen, _ = measured(SensorsConfig(heading=AngleConfig(noise_deg=NoiseConfig(white=2.0))), 20_000)
    psi = [m.psi for m in seen]
    assert math.degrees(np.std(psi)) == pytest.approx(2.0, rel=0.03)
    assert np.mean(psi) == pytest.approx(7.0 - 2.0 * math.pi, abs=0.002)


def test_a_late_compass_reports_what_was() -> None:
    noisy = AngleConfig(noise_deg=NoiseConfig(white=2.0))
    late = AngleConfig(noise_deg=noisy.noise_deg, latency=0.1)
    first, _ = measured(SensorsConfig(heading=noisy), 50)
    second, _ = measured(SensorsConfig(heading=late), 50)
    assert [m.psi for m in second] == [first[max(k - 2, 0)].psi for k in range(50)]


def test_an_instrument_more_or_less_leaves_the_others_as_they_are() -> None:
    noisy = NoiseConfig(white=0.3)
    one = SensorsConfig(yaw_rate=AngleConfig(noise_deg=noisy))
    both = SensorsConfig(yaw_rate=AngleConfig(noise_deg=noisy), position=FixConfig(noise=noisy, outliers=0.5))
    assert [m.r for m in measured(one, 50)[0]] == [m.r for m in measured(both, 50)[0]]
