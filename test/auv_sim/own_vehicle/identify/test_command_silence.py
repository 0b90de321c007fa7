"""Silent commands: what counts as a silence, and that nothing of it reaches the identification."""

from __future__ import annotations

import math

import numpy as np
import pytest

from auv_sim.own_vehicle.identify.command_silence import outside, silences

T = np.arange(0.0, 60.0, 0.05)
STEPS = 0.1 * np.sign(np.sin(0.5 * T))


def without(begin: float, end: float) -> tuple[np.ndarray, np.ndarray]:  # type: ignore[type-arg]
    kept = (begin >= T) | (end <= T)
    return T[kept], STEPS[kept]


def test_commands_at_a_rate_that_pause_for_a_second_are_silent() -> None:
    (span,) = silences([without(20.0, 26.0)], 60.0)
    assert span == pytest.approx((20.0, 26.0))
    assert silences([without(20.0, 20.9)], 60.0) == []


def test_nothing_is_known_after_the_last_command() -> None:
    assert silences([(T, STEPS)], 60.9) == []
    assert silences([(T, STEPS)], 61.0) == [(T[-1], math.inf)]


def test_any_one_kind_counts() -> None:
    spans = silences([without(20.0, 26.0), without(40.0, 43.0)], 60.0)
    assert silences([without(20.0, 26.0), without(22.0, 27.0)], 60.0) == [pytest.approx((20.0, 27.0))]
    kept = outside(spans, np.array([19.0, 20.0, 21.0, 26.0, 41.0, 43.0, 50.0]))
    assert kept.tolist() == [True, True, False, True, False, True, True]


def test_commands_that_are_sent_when_they_change_are_held() -> None:
    changed = np.append(True, np.diff(STEPS) != 0.0)
    assert np.diff(T[changed]).max() > 5.0
    assert silences([(T[changed], STEPS[changed])], 90.0) == []


def test_a_few_commands_show_no_rate() -> None:
    t, value = np.array([0.0, 0.1, 0.2]), np.array([0.0, 0.0, 80.0])
    assert silences([(t, value)], 60.0) == []


def test_slow_commands_are_not_silent_between_each_other() -> None:
    t = np.arange(0.0, 120.0, 1.5)
    value = np.where(t < 60.0, 5.0, 9.0)
    assert silences([(t, value)], 120.0) == []
    kept = (t < 30.0) | (t > 40.0)
    assert silences([(t[kept], value[kept])], 120.0) == [pytest.approx((28.5, 40.5))]
