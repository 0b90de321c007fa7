"""The instruments."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.plant.noise import DropoutConfig, NoiseConfig
from auv_sim.plant.sensors import (
    AngleConfig,
    AngleSensor,
    FixConfig,
    PositionFixes,
    Sensors,
    SensorsConfig,
    Truth,
    VelocityConfig,
    VelocityLog,
)

SEED = (5, 2)
TRUTH = Truth(x=10.0, y=-4.0, psi=7.0, r=0.1, ur=1.9, vr=-0.02, u=2.0, v=0.1)


def test_ideal_instruments_tell_the_truth_at_every_step() -> None:
    sensors = Sensors(SensorsConfig(), SEED)
    for dt in (0.0, 0.05, 0.05):
        m = sensors.update(TRUTH, dt)
        assert m.psi == pytest.approx(7.0 - 2.0 * math.pi)
        assert (m.r, tuple(m.water), m.bottom) == (0.1, (1.9, -0.02), (2.0, 0.1))
        assert m.fixes == ((10.0, -4.0, 0.0),)


def test_angles_are_configured_in_degrees_and_told_in_radians() -> None:
    compass = AngleSensor(AngleConfig(noise_deg=NoiseConfig(white=2.0)), SEED)
    told = [compass.update(1.0, 0.05) for _ in range(20_000)]
    assert math.degrees(np.std(told)) == pytest.approx(2.0, rel=0.03)
    assert np.mean(told) == pytest.approx(1.0, abs=0.002)


def test_a_log_has_a_scale_and_holds_its_value_between_measurements() -> None:
    log = VelocityLog(VelocityConfig(scale=0.01, rate=5.0), SEED)
    told = [log.update(1.0 + 0.1 * k, 0.0, 0.05 if k else 0.0)[0][0] for k in range(40)]
    assert len(set(told)) == 10
    scales = [
        VelocityLog(VelocityConfig(scale=0.01), (5, k)).update(1.0, 0.0, 0.0)[0][0] for k in range(4000)
    ]
    assert np.std(scales) == pytest.approx(0.01, rel=0.05)
    assert told[0] != 1.0


def test_a_log_that_is_late_tells_what_was() -> None:
    log = VelocityLog(VelocityConfig(latency=0.1), SEED)
    assert [log.update(float(k), 0.0, 0.05)[0][0] for k in range(5)] == [0.0, 0.0, 0.0, 1.0, 2.0]


def test_a_silent_log_says_so_and_repeats_itself() -> None:
    log = VelocityLog(VelocityConfig(dropouts=DropoutConfig(every=2.0, length=2.0)), SEED)
    told = [log.update(float(k), 0.0, 0.05) for k in range(2000)]
    held = [k for k in range(1, 2000) if told[k][0] == told[k - 1][0]]
    assert held == [k for k in range(1, 2000) if not told[k][1]]
    assert 0.3 < len(held) / 2000 < 0.7
    assert VelocityLog(VelocityConfig(lock=False), SEED).update(1.0, 0.0, 0.05) == ((1.0, 0.0), False)


def test_fixes_come_at_their_rate_and_late() -> None:
    fixes = PositionFixes(FixConfig(rate=1.0, latency=0.5), SEED)
    arrived = [(k, fix) for k in range(101) for fix in fixes.update(float(k), 0.0, 0.05 if k else 0.0)]
    assert [k for k, _ in arrived] == [10, 30, 50, 70, 90]
    assert [fix.x for _, fix in arrived] == [0.0, 20.0, 40.0, 60.0, 80.0]
    assert [fix.age for _, fix in arrived] == pytest.approx([0.5] * 5)


def test_a_latency_between_two_steps_is_told_as_it_came_out() -> None:
    fixes = PositionFixes(FixConfig(rate=1.0, latency=0.52), SEED)
    arrived = [fix for k in range(40) for fix in fixes.update(float(k), 0.0, 0.05 if k else 0.0)]
    assert [fix.age for fix in arrived] == pytest.approx([0.55, 0.55])


def test_a_share_of_the_fixes_is_false_by_tens_of_metres() -> None:
    fixes = PositionFixes(FixConfig(outliers=0.05), SEED)
    off = np.array([math.hypot(*fixes.update(0.0, 0.0, 1.0)[0][:2]) for _ in range(20_000)])
    false = off > 0.0
    assert false.mean() == pytest.approx(0.05, rel=0.1)
    assert 10.0 <= off[false].min() < 11.0
    assert 49.0 < off[false].max() <= 50.0


def test_an_instrument_more_or_less_leaves_the_others_as_they_are() -> None:
    noisy = NoiseConfig(white=0.3)
    one = Sensors(SensorsConfig(yaw_rate=AngleConfig(noise_deg=noisy)), SEED)
    both = Sensors(
        SensorsConfig(yaw_rate=AngleConfig(noise_deg=noisy), position=FixConfig(noise=noisy, outliers=0.5)),
        SEED,
    )
    for _ in range(50):
        assert one.update(TRUTH, 0.05).r == both.update(TRUTH, 0.05).r


def test_a_reset_begins_the_same_run_again() -> None:
    config = SensorsConfig(
        heading=AngleConfig(noise_deg=NoiseConfig(white=1.0, bias=1.0, drift=1.0)),
        water_track=VelocityConfig(noise=NoiseConfig(white=1.0), scale=0.1, latency=0.1),
        bottom_track=VelocityConfig(dropouts=DropoutConfig(every=1.0, length=1.0)),
        position=FixConfig(noise=NoiseConfig(white=1.0), rate=1.0, latency=0.3, outliers=0.5),
    )
    sensors = Sensors(config, SEED)
    first = [sensors.update(TRUTH, 0.05) for _ in range(100)]
    sensors.reset()
    assert [sensors.update(TRUTH, 0.05) for _ in range(100)] == first
