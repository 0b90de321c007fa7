"""Limits in compiled code end the same missions for the same reasons."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.values.pure import numbers_of
from auv_path_following.missions.limits import (
    BEGINNING,
    LimitsConfig,
    LimitsInputs,
    MissionLimits,
    NoLimits,
    limits_step,
    prepare,
)
from auv_path_following.missions.mission_state import NO_REASON, Reason
from auv_sim.flight.batch.compiled import compiled, take_over_pure

take_over_pure()


def ended(config: Any, track: Any, dt: float) -> tuple[int, Reason]:
    """The row of a track (x, y, xe, ye, to_go, holds, rests) at which its mission ends, and why."""
    state, reason = BEGINNING, NO_REASON
    for k in range(len(track)):
        row = track[k]
        off = math.hypot(row[2], row[3])
        inputs = LimitsInputs(row[0], row[1], 0.0, off, 0.0, math.inf, row[4], row[5] > 0.0, row[6] > 0.0)
        state, reason = limits_step(config, state, inputs, dt)
        if reason.cause != NO_REASON.cause:
            return k, reason
    return len(track), reason


compiled_ended = compiled(ended)


def mission(generator: np.random.Generator) -> tuple[Any, np.ndarray, float]:
    """Random limits, and a random track that breaks some of them."""
    on = generator.random(4) < 0.5
    config = LimitsConfig(
        path_distance=float(on[0] * 20.0),
        duration=float(on[1] * generator.uniform(50.0, 150.0)),
        ground_speed=float(on[2] * 0.3),
        ground_speed_window=10.0,
        path_speed=float(on[3] * 0.3),
        path_speed_window=20.0,
    )
    rows, dt = 500, float(generator.choice([0.1, 0.25, 1.0]))
    speed = generator.uniform(0.0, 2.5) * (np.arange(rows) < generator.integers(100, 900)) * dt
    heading = np.cumsum(generator.normal(0.0, 0.1, rows))
    x, y = np.cumsum(speed * np.cos(heading)), np.cumsum(speed * np.sin(heading))
    off = np.cumsum(generator.normal(0.0, 0.8, (rows, 2)), axis=0)
    to_go = 500.0 - np.cumsum(speed * generator.uniform(0.0, 1.0))
    flags = generator.random((rows, 2)) < 0.02
    track = np.column_stack([x, y, off, to_go, flags]).astype(np.float64)
    fence = np.array([[-100.0, -100.0], [150.0, -100.0], [150.0, 150.0], [-100.0, 150.0]])
    return MissionLimits(numbers_of(config), fence), track, dt


def test_random_missions_end_as_they_do_in_plain_python() -> None:
    causes = set()
    for seed in range(400):
        config, track, dt = mission(np.random.default_rng(seed))
        plain = prepare(LimitsConfig(path_distance=1.0), [(float(x), float(y)) for x, y in config.geofence])
        assert isinstance(plain, MissionLimits)
        expected = ended(MissionLimits(config.values, plain.geofence), track, dt)
        end, reason = compiled_ended(config, track, dt)
        assert (end, reason.cause) == (expected[0], expected[1].cause)
        assert reason[1:] == pytest.approx(expected[1][1:], rel=1e-12)  # hypot differs in its last bit
        causes.add(expected[1].cause)
    assert len(causes) == 6  # each limit, and none


def test_without_limits_none_is_broken() -> None:
    _, track, dt = mission(np.random.default_rng(0))
    assert compiled_ended(NoLimits(), track, dt) == (len(track), NO_REASON)
