"""What ends a dive: each watchdog fires for its fault, in its time, and for nothing else."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_path_following import vehicle
from auv_path_following.guidance.failsafe.dive_limits import (
    NOT_DIVED,
    DiveInputs,
    DiveLimitsState,
    dive_limits,
    prepare,
)
from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig, sinking_of
from auv_path_following.missions.mission_state import (
    BROACHED,
    DEPTH_DOUBTED,
    DEPTH_STALLED,
    NO_REASON,
    PITCHED,
    ROLLED,
    SANK,
    TOO_SLOW,
    words,
)

DT = 0.1
REMUS = vehicle.load("remus100_6dof")
LEVEL = DiveInputs(10.0, 0.0, 0.0, (1.9, 0.0, 0.0), 10.0, True, False, False)
OFF = {
    "roll_deg": 0.0, "pitch_deg": 0.0, "slow_after": 0.0, "broach_after": 0.0, "depth_patience": 0.0,
    "depth_doubt": 0.0, "hold_sink": 0.0,
}  # fmt: skip


def ended(inputs: Any, seconds: float = 60.0, **config: float) -> tuple[float, Any]:
    """Time and reason of the first limit that `inputs(t)` breaks; infinite if none."""
    limits, state = prepare(DiveLimitsConfig(**config), REMUS), NOT_DIVED
    for k in range(round(seconds / DT)):
        state, reason = dive_limits(limits, state, inputs(k * DT), DT)
        if reason.cause != NO_REASON.cause:
            return k * DT, reason
    return math.inf, NO_REASON


def test_a_level_flight_is_never_ended() -> None:
    assert ended(lambda t: LEVEL) == (math.inf, NO_REASON)


def rolled(t: float) -> DiveInputs:
    return LEVEL._replace(phi=math.radians(-65.0 if t > 10.0 else -55.0))


def pitched(t: float) -> DiveInputs:
    return LEVEL._replace(theta=math.radians(-65.0), z=10.0 + 1.9 * math.sin(math.radians(65.0)) * t)


def slow(t: float) -> DiveInputs:
    return LEVEL._replace(water=(1.9 if 5.0 < t < 10.0 else 0.8, 0.0, 0.0))


def broached(t: float) -> DiveInputs:
    return LEVEL._replace(z=0.9 if t < 10.0 else 0.1, depth=1.5)


def stalled(t: float) -> DiveInputs:
    """Down from the surface to 4 m, and no farther."""
    z = min(0.4 * t, 4.0)
    return LEVEL._replace(z=z, theta=-math.asin(0.4 / 1.9) if z < 4.0 else 0.0)


def frozen(t: float) -> DiveInputs:
    return LEVEL._replace(theta=math.radians(-20.0))


def turned(t: float) -> DiveInputs:
    sinking = 1.9 * math.sin(math.radians(20.0))
    return LEVEL._replace(theta=math.radians(-20.0), z=-10.0 - sinking * t, depth=-10.0 - sinking * t)


def sinks(t: float) -> DiveInputs:
    return LEVEL._replace(z=10.0 + 0.1 * t, follows=False, holds=t > 5.0)


@pytest.mark.parametrize(
    ("inputs", "cause", "time", "text"),
    [
        (rolled, ROLLED, 11.1, "limit diving.roll_deg: 65 deg for 1.1 s, at most 60 deg"),
        (pitched, PITCHED, 1.0, "limit diving.pitch_deg: 65 deg for 1.1 s, at most 60 deg"),
        (slow, TOO_SLOW, 20.0, "0.80 m/s through the water for 10.1 s, at least 0.9 m/s"),
        (broached, BROACHED, 15.0, "above 0.5 m of depth for 5.1 s, where 1.5 m are requested"),
        (stalled, DEPTH_STALLED, 39.7, "6.0 m from the requested depth, and no closer for 30.0 s"),
        (frozen, DEPTH_DOUBTED, 2.0 / (1.9 * math.sin(math.radians(20.0)) - 0.3), "differs by 2.0 m"),
        (turned, DEPTH_DOUBTED, 2.0 / (3.8 * math.sin(math.radians(20.0)) - 0.3), "pitch and speed"),
        (sinks, SANK, 45.1, "limit diving.hold_sink: sank 4.0 m with thrust 0, at most 4 m"),
    ],
)
def test_a_fault_is_found_in_its_time(inputs: Any, cause: int, time: float, text: str) -> None:
    if inputs is turned:  # only the sign differs
        sound = ended(lambda t: inputs(t)._replace(z=-inputs(t).z, depth=-inputs(t).depth))
        assert sound == (math.inf, NO_REASON)
    found, reason = ended(inputs)
    assert reason.cause == cause
    assert found == pytest.approx(time, abs=0.35)
    assert text in words(reason)
    assert ended(inputs, **OFF) == (math.inf, NO_REASON)


def test_what_a_sound_vehicle_does_is_not_a_fault() -> None:
    brief = {"phi": math.radians(-80.0)}
    assert ended(lambda t: LEVEL._replace(**brief) if t % 2.0 < 0.9 else LEVEL)[0] == math.inf
    start = LEVEL._replace(water=(0.3, 0.0, 0.0))  # from rest: it never was faster
    assert ended(lambda t: start)[0] == math.inf
    assert ended(lambda t: LEVEL._replace(z=0.1, depth=0.5))[0] == math.inf  # a mission at the surface
    assert ended(lambda t: LEVEL._replace(z=0.1, depth=1.5))[0] == math.inf  # it has not dived yet
    rises = LEVEL._replace(follows=False, holds=True)
    assert ended(lambda t: rises._replace(z=max(10.0 - 0.2 * t, 0.0)))[0] == math.inf
    closer = LEVEL._replace(theta=-0.01)
    assert ended(lambda t: closer._replace(z=4.0 + 0.019 * t, depth=12.0))[0] == math.inf


def test_a_rest_begins_the_watch_anew() -> None:
    limits = prepare(DiveLimitsConfig(), REMUS)
    state = DiveLimitsState(0.0, 9.0, True, 0.0, True, 29.0, 5.0, 40.0, 1.9, 0.0, math.nan, math.nan)
    rested = LEVEL._replace(z=16.0, water=(0.2, 0.0, 0.0), rests=True)
    state, reason = dive_limits(limits, state, rested, DT)
    assert reason == NO_REASON
    assert (state.slow, state.has_been_fast, state.stalled, state.z) == (0.0, False, 0.0, 16.0)


@settings(max_examples=60)
@given(
    st.lists(
        st.tuples(*(st.floats(-limit, limit) for limit in (0.5, 0.5, 0.2, 0.2, 0.29))),
        min_size=5,
        max_size=60,
    )
)
def test_a_depth_that_follows_pitch_and_speed_is_never_doubted(
    steps: list[tuple[float, float, float, float, float]],
) -> None:
    """Whatever the attitude and the velocity, with an upwelling below `depth_rate_error`."""
    limits, state, z = prepare(DiveLimitsConfig(**OFF | {"depth_doubt": 0.5}), REMUS), NOT_DIVED, 20.0
    for phi, theta, v, w, upwelling in steps:
        water = (1.5, v, w)
        z += (sinking_of(phi, theta, *water) + upwelling) * DT
        state, reason = dive_limits(
            limits, state, DiveInputs(z, phi, theta, water, z, True, False, False), DT
        )
        assert reason == NO_REASON
        assert max(state.deeper, state.shallower) < 0.5


def test_sinking_is_positive_bow_down_and_with_heave() -> None:
    assert sinking_of(0.0, -0.2, 1.0, 0.0, 0.0) == pytest.approx(math.sin(0.2))
    assert sinking_of(0.0, 0.2, 1.0, 0.0, 0.0) == pytest.approx(-math.sin(0.2))
    assert sinking_of(0.0, 0.0, 1.0, 0.0, 0.3) == pytest.approx(0.3)
    assert sinking_of(0.5 * math.pi, 0.0, 1.0, 0.3, 0.0) == pytest.approx(0.3)  # rolled to starboard
