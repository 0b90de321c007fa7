"""The driven ascent: when it begins, how it is flown, and every way in which it ends."""

from __future__ import annotations

import dataclasses
import math
from itertools import pairwise
from typing import Any

import pytest

from auv_path_following import vehicle
from auv_path_following.guidance.failsafe import ascent, guard
from auv_path_following.guidance.failsafe.ascent import (
    ASCENDS,
    NO_PROGRESS,
    SURFACED,
    TOO_LONG,
    AscentConfig,
    AscentInputs,
    ascend,
    begun,
    has_to_ascend,
    phase_words,
    prepare,
)
from auv_path_following.guidance.failsafe.dive_limits import NOT_DIVED
from auv_path_following.guidance.failsafe.guard import GuardState
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig
from auv_path_following.missions.mission_state import (
    ABORTED,
    DEPTH_DOUBTED,
    HELD_TOO_LONG,
    MAX_DEPTH,
    PITCHED,
    ROLLED,
    SANK,
    MissionStatus,
    Reason,
    is_surfacing,
)

DT = 0.1
FLOATS = vehicle.load("remus100_6dof")
SINKS = dataclasses.replace(
    vehicle.load("mss_remus100"), depth=dataclasses.replace(FLOATS.depth, allow_sinking=True)
)
DEEP = Reason(MAX_DEPTH, 21.0, 0.0, 20.0)


@pytest.mark.parametrize(
    ("when", "hull", "cause", "ascends"),
    [
        ("sinks", FLOATS, MAX_DEPTH, False), ("sinks", SINKS, MAX_DEPTH, True), ("sinks", FLOATS, SANK, True),
        ("always", FLOATS, MAX_DEPTH, True), ("never", SINKS, SANK, False), ("always", SINKS, ROLLED, False),
        ("always", SINKS, PITCHED, False),
    ],
)  # fmt: skip
def test_a_limit_is_followed_by_an_ascent(when: Any, hull: Any, cause: int, ascends: bool) -> None:
    config = prepare(AscentConfig(when=when), hull, 6.48)
    assert has_to_ascend(config, Reason(cause, 0.0, 0.0, 0.0), False, 20.0) is ascends
    assert not has_to_ascend(config, Reason(cause, 0.0, 0.0, 0.0), False, 0.4)  # it is at the surface
    assert not has_to_ascend(config, Reason(cause, 0.0, 0.0, 0.0), True, 20.0)  # `abort` means thrust 0


def test_abort_ascends_only_if_so_configured() -> None:
    config = prepare(AscentConfig(when="never", on_abort=True), FLOATS, 6.48)
    assert has_to_ascend(config, DEEP, True, 20.0)
    assert not has_to_ascend(config, DEEP, False, 20.0)


def flown(rate: float, reason: Reason = DEEP, measured: float | None = None, **config: Any) -> Any:
    """Ascend from 20 m at a rate (m/s, up positive); return final state, time, and pitches."""
    c = prepare(AscentConfig(**config), FLOATS, 6.48)
    z, pitches = 20.0, []
    state = begun(reason, measured or z, 1.0)
    theta = math.asin(rate / 2.0)
    for k in range(6000):
        at = AscentInputs(measured or z, 0.0, theta, 1.0, 2.0, 0.0, 0.0)
        state, theta_d = ascend(c, state, at, DT)
        pitches.append(theta_d)
        if state.phase != ASCENDS:
            return state, k * DT, pitches
        z -= rate * DT
    raise AssertionError("an ascent without end")


def test_an_ascent_is_bow_up_and_ends_at_the_surface() -> None:
    state, time, pitches = flown(0.5)
    assert state.phase == SURFACED
    assert state.z < 0.81
    assert time == pytest.approx(19.2 / 0.5, abs=0.3)
    assert pitches[0] == pytest.approx(math.radians(20.0))
    assert 0.0 < pitches[-1] < 0.15  # it levels out
    assert max(abs(b - a) for a, b in pairwise(pitches)) < 0.02


def test_at_the_surface_it_may_drive_on() -> None:
    state, time, _ = flown(0.5, linger=7.0)
    assert state.phase == SURFACED
    assert time == pytest.approx(19.2 / 0.5 + 7.0, abs=0.4)


@pytest.mark.parametrize(
    ("rate", "config", "phase", "time"),
    [
        (0.0, {}, NO_PROGRESS, 20.0),  # planes that are stuck
        (-1.0, {}, NO_PROGRESS, 5.0),  # bow down: at once, when it is more than the momentum of a dive
        (0.02, {}, NO_PROGRESS, 20.0),
        (0.1, {"longest": 20.0}, TOO_LONG, 20.0),
    ],
)
def test_an_ascent_that_does_not_rise_is_given_up(rate: float, config: Any, phase: int, time: float) -> None:
    state, ended, _ = flown(rate, **config)
    assert state.phase == phase
    assert ended == pytest.approx(time, abs=0.3)
    assert phase_words(phase).startswith("given up")


@pytest.mark.parametrize("measured", [20.0, -20.0])
def test_a_depth_that_is_doubted_is_counted_by_pitch_and_speed(measured: float) -> None:
    """The measured one is frozen, or of the wrong sign: the ascent is long enough, and ends."""
    state, time, _ = flown(0.5, Reason(DEPTH_DOUBTED, 2.0, 0.0, 2.0), measured)
    assert state.phase == SURFACED
    assert 20.0 / 0.5 < time < 26.0 / 0.5


def test_without_a_measured_speed_the_pitch_is_as_configured() -> None:
    c = prepare(AscentConfig(pitch_deg=15.0), FLOATS, 6.48)
    at = AscentInputs(20.0, 0.0, 0.0, 1.0, math.nan, math.nan, math.nan)
    state, theta_d = ascend(c, begun(DEEP, 20.0, 1.0), at, DT)
    assert theta_d == pytest.approx(math.radians(15.0))
    slow = at._replace(ur=0.1, vr=0.0, wr=0.0)  # planes reverse: no pitch is asked for
    assert ascend(c, state, slow, DT)[1] == 0.0
    assert ascent.AT_DEPTH.phase == ascent.NO_ASCENT


@pytest.mark.parametrize(
    ("when", "deepest", "surfaces"),
    [("sinks", 20.0, True), ("sinks", 21.0, False), ("never", 20.0, False), ("always", 21.0, True)],
)
def test_a_hold_that_lasts_too_long_ends_with_an_ascent_of_a_hull_that_has_not_risen(
    when: Any, deepest: float, surfaces: bool
) -> None:
    config = guard.prepare(DiveLimitsConfig(), AscentConfig(when=when), FLOATS, 6.48)
    state = GuardState(NOT_DIVED._replace(held_at=19.0, deepest=deepest), ascent.AT_DEPTH)
    ended = MissionStatus(ABORTED, Reason(HELD_TOO_LONG, 1.0, 0.0, 30.0))
    rising, mission = guard.held_too_long(config, state, ended, (20.0, 0.4))
    assert (is_surfacing(mission), guard.surfaces(rising)) == (surfaces, surfaces)
    assert guard.held_too_long(config, state, ended, None) == (state, ended)  # without odometry
    assert guard.held_too_long(guard.NoDive(), state, ended, (20.0, 0.4)) == (state, ended)
