"""What is reported of the stern planes."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import SpatialCommand
from auv_path_following import vehicle
from auv_path_following.control.fin_watch import (
    NEUTRAL,
    FinWatchConfig,
    complaint,
    prepare,
    watch_fin,
)
from auv_path_following.nodes.spatial_steering import steering_of
from auv_path_following.parameters import AutopilotParameters

PLANES = vehicle.load("remus100_6dof").sternplanes
assert PLANES is not None
MAX, RATE, DT = PLANES.max_angle, PLANES.max_rate, 0.05
Signal = Callable[[float], float]


def reported(command: Signal, measured: Signal, seconds: float = 20.0, **config: float) -> dict[str, float]:
    """Complaint -> first time, s."""
    watch, state, found = prepare(FinWatchConfig(**config), PLANES), NEUTRAL, dict[str, float]()
    for k in range(round(seconds / DT)):
        state, *wrong = watch_fin(watch, state, command(k * DT), measured(k * DT), DT)
        if text := complaint(*wrong):
            found.setdefault(text, k * DT)
    return found


def test_planes_at_their_stop_are_reported_in_either_direction() -> None:
    for sign in (1.0, -1.0):
        found = reported(lambda t, s=sign: s * MAX if t >= 3.0 else 0.0, lambda t: math.nan)
        assert found == {"the stern planes are at their stop": pytest.approx(8.0, abs=2 * DT)}
    assert reported(lambda t: MAX if t % 4.0 < 3.0 else 0.0, lambda t: math.nan) == {}
    assert reported(lambda t: MAX, lambda t: math.nan, stop_after=0.0) == {}
    assert reported(lambda t: 0.9 * MAX, lambda t: math.nan) == {}


def test_a_servo_that_is_stuck_is_reported_and_one_that_is_slow_is_not() -> None:
    def command(t: float) -> float:
        return 0.5 * MAX if t >= 3.0 else 0.0

    found = reported(command, lambda t: 0.0)
    # 3 deg at 15 deg/s, then 1 s.
    assert found == {"the stern planes do not follow their command": pytest.approx(4.2, abs=2 * DT)}
    assert reported(command, lambda t: min(max(t - 3.0, 0.0) * RATE, 0.5 * MAX)) == {}
    assert reported(command, lambda t: 0.0, differs_by_deg=0.0) == {}
    assert reported(command, lambda t: math.nan) == {}


@settings(max_examples=40)
@given(st.lists(st.floats(-MAX, MAX), min_size=1, max_size=60), st.floats(-0.04, 0.04))
def test_a_sound_servo_with_an_offset_is_never_reported(commands: list[float], offset: float) -> None:
    watch, state, angle = prepare(FinWatchConfig(), PLANES), NEUTRAL, 0.0
    for command in commands:
        for _ in range(5):
            angle += max(-RATE * DT, min(command - angle, RATE * DT))
            state, _, differs = watch_fin(watch, state, command, angle + offset, DT)
            assert not differs


def test_the_autopilot_of_a_vehicle_that_dives_watches_its_planes() -> None:
    """Measured and commanded angles have one sign: bow down positive. A planar vehicle has none to watch."""
    down = SpatialCommand(0.0, 0.2, 6.0)
    for measured, text in ((0.2, ""), (-0.2, "the stern planes do not follow their command"), (math.nan, "")):
        steering = steering_of(vehicle.load("remus100_6dof"), AutopilotParameters())
        steering.planes = measured
        assert [steering.watch(down, DT) for _ in range(60)][-1] == text
    assert steering_of(vehicle.load("remus100"), AutopilotParameters()).watch(down, DT) == ""
