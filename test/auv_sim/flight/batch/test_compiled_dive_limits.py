"""Limits of a dive, and its ascent, in compiled code have the same bits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from auv_path_following import vehicle
from auv_path_following.guidance.failsafe import ascent
from auv_path_following.guidance.failsafe.ascent import AscentConfig, AscentInputs, ascend
from auv_path_following.guidance.failsafe.dive_limits import NOT_DIVED, DiveInputs, dive_limits, prepare
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_path_following.missions.mission_state import MAX_DEPTH, Reason
from auv_sim.flight.batch.compiled import compiled, take_over_pure

take_over_pure()
REMUS = vehicle.load("remus100_6dof")
DT = 0.05


def dived(limits: Any, state: Any, config: Any, rise: Any, steps: int) -> tuple[Any, Any, Any, float]:
    """A swaying dive that follows, holds and rests in turn; and an ascent of as many steps."""
    reason, pitches = Reason(0, 0.0, 0.0, 0.0), 0.0
    for k in range(steps):
        t = k * DT
        phi, theta, z = 0.1 * math.cos(t), 0.2 * math.sin(0.7 * t), 10.0 + math.sin(0.3 * t)
        water = (1.5 + 0.3 * math.sin(t), 0.05, 0.02)
        seen = DiveInputs(z, phi, theta, water, 10.0, k % 7 != 0, k % 7 == 0, k % 50 == 0)
        state, reason = dive_limits(limits, state, seen, DT)
        rise, theta_d = ascend(config, rise, AscentInputs(20.0 - 0.02 * k, phi, theta, 1.0, *water), DT)
        pitches += theta_d
    return state, reason, rise, pitches


def test_the_limits_of_a_dive_and_its_ascent_compile_to_the_same_bits() -> None:
    limits, config = prepare(DiveLimitsConfig(), REMUS), ascent.prepare(AscentConfig(), REMUS, 6.48)
    begun = ascent.begun(Reason(MAX_DEPTH, 21.0, 0.0, 20.0), 20.0, 1.0)
    flown = [step(limits, NOT_DIVED, config, begun, 400) for step in (dived, compiled(dived))]
    (state, reason, rise, pitches), (state_c, reason_c, rise_c, pitches_c) = flown
    np.testing.assert_array_equal(state, state_c)
    assert (tuple(reason), tuple(rise), pitches) == (tuple(reason_c), tuple(rise_c), pitches_c)
    assert pitches > 0.0
