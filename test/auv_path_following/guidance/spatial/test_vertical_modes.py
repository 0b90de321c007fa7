"""What the vertical plane follows: a depth, or an altitude above the bottom."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_path_following.guidance.spatial.vertical_modes import (
    FOLLOW_PATH,
    NO_REQUEST,
    AltitudeHold,
    DepthHold,
    VerticalInputs,
    VerticalRequest,
    vertical_step,
)

STEEPEST, DT = math.radians(30.0), 0.05
MODE = AltitudeHold(
    above=5.0,
    least=3.0,
    surface=0.5,
    deepest=100.0,
    bandwidth=1.0,
    damping=0.7,
    patience=5.0,
    largest_drop=5.0,
)


def at(z: float, altitude: float, tilt: float = 1.0, speed: float = 2.0) -> VerticalInputs:
    return VerticalInputs(z, tilt, altitude, speed, 0.3, -0.1, 0.9, 12.0, STEEPEST)


def settled(mode: AltitudeHold, z: float, bottom: float, seconds: float = 20.0) -> tuple:
    """State and request after some time at one depth over a level bottom."""
    state = NO_REQUEST
    for _ in range(round(seconds / DT)):
        state, request = vertical_step(mode, state, at(z, bottom - z), DT)
    return state, request


def test_the_path_is_requested_as_it_is() -> None:
    assert vertical_step(FOLLOW_PATH, NO_REQUEST, at(12.3, math.nan), DT) == (
        NO_REQUEST,
        VerticalRequest(0.3, -0.1, 0.9, 12.0, -math.inf),
    )


@given(st.floats(0.0, 100.0), st.floats(0.0, 100.0))
def test_a_held_depth_is_independent_of_the_path(z: float, depth: float) -> None:
    _, request = vertical_step(DepthHold(depth), NO_REQUEST, at(z, math.nan), DT)
    assert request == (z - depth, 0.0, 1.0, depth, -math.inf)


@given(st.floats(10.0, 50.0), st.floats(2.0, 50.0))
def test_over_a_level_bottom_the_depth_is_the_bottom_less_the_altitude(z: float, altitude: float) -> None:
    _, request = settled(MODE, z, z + altitude, 1.0)
    assert request.depth == pytest.approx(max(z + altitude - 5.0, 0.5))
    assert request.ze == pytest.approx(z - request.depth)
    assert request.gamma_a == 0.0


def test_a_range_along_a_tilted_body_is_the_longer_one() -> None:
    tilt = math.cos(math.radians(25.0))
    _, request = vertical_step(MODE, NO_REQUEST, at(10.0, 20.0 / tilt, tilt), DT)
    assert request.depth == pytest.approx(25.0)


@pytest.mark.parametrize("slope", [0.1, -0.1], ids=["bottom falls", "bottom rises"])
def test_the_slope_of_the_bottom_is_fed_forward(slope: float) -> None:
    """A bottom that falls needs the bow down: a negative elevation."""
    state, speed = NO_REQUEST, 2.0
    for k in range(600):
        bottom = 40.0 + slope * speed * DT * k
        state, request = vertical_step(MODE, state, at(30.0, bottom - 30.0, 1.0, speed), DT)
    assert request.gamma_a == pytest.approx(-math.atan(slope), rel=0.02)
    assert request.depth == pytest.approx(bottom - 5.0, abs=0.3)  # the tracker lags by 1.4/w of the rate


def test_the_requested_depth_stays_in_the_range_of_the_vehicle() -> None:
    _, shallow = settled(MODE, 1.0, 4.0)
    assert (shallow.depth, shallow.gamma_a) == (0.5, 0.0)
    _, deep = settled(MODE._replace(deepest=50.0), 40.0, 90.0)
    assert (deep.depth, deep.gamma_a) == (50.0, 0.0)


def test_below_the_least_altitude_the_vehicle_climbs_as_steeply_as_it_can() -> None:
    state, request = settled(MODE, 20.0, 26.0)
    assert request.least_climb == -math.inf
    _, request = vertical_step(MODE, state, at(20.0, 2.9), DT)
    assert request.least_climb == STEEPEST
    _, request = vertical_step(MODE, state, at(20.0, -math.inf), DT)  # too close to be measured
    assert request.least_climb == STEEPEST


@pytest.mark.parametrize("lost", [math.inf, math.nan], ids=["no echo", "no altimeter"])
def test_without_an_echo_the_depth_is_held_then_the_vehicle_climbs_to_the_last_echo(lost: float) -> None:
    state, before = settled(MODE, 20.0, 30.0)
    for k in range(round(8.0 / DT)):
        state, request = vertical_step(MODE, state, at(21.0 + 0.01 * k, lost), DT)
        if (k + 1) * DT < 5.0:
            assert (request.depth, request.least_climb) == (pytest.approx(before.depth), -math.inf)
    assert (request.depth, request.least_climb) == (20.0, 0.5 * STEEPEST)
    _, request = vertical_step(MODE, state, at(19.9, lost), DT)
    assert (request.depth, request.least_climb) == (20.0, -math.inf)


def test_without_any_echo_the_own_depth_is_held() -> None:
    _, request = vertical_step(MODE, NO_REQUEST, at(17.0, math.inf), DT)
    assert (request.ze, request.depth) == (0.0, 17.0)


def test_a_false_echo_does_not_lead_down_and_a_cliff_does_in_the_end() -> None:
    """A bottom that is suddenly 20 m deeper is no echo for `patience`; then it is the bottom."""
    state, before = settled(MODE, 20.0, 30.0)
    for k in range(round(5.5 / DT)):
        state, request = vertical_step(MODE, state, at(20.0, 30.0), DT)
        if (k + 1) * DT < 5.0:
            assert request.depth == pytest.approx(before.depth)
    assert request.depth == pytest.approx(45.0, abs=0.1)
    state, before = settled(MODE, 20.0, 30.0)
    for _ in range(40):  # a shoal counts at once
        state, request = vertical_step(MODE, state, at(20.0, 2.0), DT)
    assert request.depth < before.depth
    assert request.least_climb == STEEPEST
