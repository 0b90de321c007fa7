"""The peer's guidance and autopilots: signs, what they learn, their rest."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.values.types import SpatialNavigation
from auv_path_following.comparators.mss_pilot import (
    MssPilot,
    MssPilotState,
    ObservedAngle,
    learnt,
    leg_errors,
    mss_begun,
    mss_pilot,
    observed,
    pid_planes,
    sliding_rudder,
)

CONFIG = MssPilot(pitch_inertia=7.9)
#: One leg north at 10 m, then one to the east that goes down.
WAYPOINTS = ((0.0, 0.0, 10.0), (100.0, 0.0, 10.0), (100.0, 100.0, 30.0))


def answer(x: float = 50.0, y: float = 0.0, z: float = 10.0, state: MssPilotState | None = None):
    navigation = SpatialNavigation(x, y, z, 0.0, 0.0, 0.0, 0.0, 0.0)
    return mss_pilot(CONFIG, WAYPOINTS, state or mss_begun(navigation), navigation, 29.2, 0.05)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_vehicle_beside_the_leg_turns_to_it_and_one_below_climbs(side: float) -> None:
    _, beside = answer(y=side * 5.0)
    assert (beside.ye, beside.ze) == pytest.approx((side * 5.0, 0.0))
    assert side * beside.psi_ref < 0.0
    assert side * beside.command.rudder > 0.0  # starboard of it: to port
    _, below = answer(z=10.0 + side * 2.0)
    assert below.ze == pytest.approx(side * 2.0)
    assert side * below.theta_ref > 0.0
    assert side * below.command.sternplanes < 0.0  # below it: bow up


def test_on_the_leg_everything_rests() -> None:
    state, rest = answer()
    assert rest.command[:2] == pytest.approx((0.0, 0.0), abs=1e-12)
    assert (state.crab, state.attack) == (0.0, 0.0)


def test_a_standing_error_teaches_crab_angles_that_steer_against_it() -> None:
    state, _ = answer(y=3.0, z=12.0)
    for _ in range(400):
        state, output = answer(y=3.0, z=12.0, state=state)
    assert 0.0 < state.crab < CONFIG.largest_crab
    assert output.psi_ref == pytest.approx(-state.crab - math.atan(3.0 / 20.0), abs=1e-3)
    assert output.theta_ref == pytest.approx(state.attack + math.atan(2.0 / 20.0), abs=1e-3)


@given(st.floats(-50.0, 50.0))
def test_learning_is_bounded_by_its_gain(error: float) -> None:
    assert abs(learnt(CONFIG, error)) <= 0.001 * min(abs(error), 20.0) + 1e-12
    assert learnt(CONFIG, error) * error >= 0.0


def test_the_next_leg_begins_5_m_before_its_waypoint() -> None:
    assert answer(x=94.0)[0].leg == 0
    state, output = answer(x=96.0)
    assert state.leg == 1
    assert output.ye == pytest.approx(4.0)  # north of a leg to the east: to port of it, and negative
    assert answer(x=100.0, y=101.0, z=31.0, state=MssPilotState(leg=1))[1].finished


def test_errors_of_a_leg_that_goes_down() -> None:
    """On it both errors are 0; a metre straight below it is cos(elevation) below."""
    xe, ye, ze, length, azimuth, elevation = leg_errors(WAYPOINTS[1], WAYPOINTS[2], 100.0, 50.0, 20.0)
    assert (ye, ze) == pytest.approx((0.0, 0.0), abs=1e-12)
    assert (xe, length) == pytest.approx((0.5 * math.hypot(100.0, 20.0), math.hypot(100.0, 20.0)))
    assert (azimuth, elevation) == pytest.approx((math.pi / 2.0, -math.atan(0.2)))
    below = leg_errors(WAYPOINTS[1], WAYPOINTS[2], 100.0, 50.0, 21.0)[2]
    assert below == pytest.approx(math.cos(elevation))


def test_the_observer_reaches_its_reference_and_rests_there() -> None:
    state = ObservedAngle(3.0)
    for _ in range(2000):
        state = observed(0.5, state, -3.0, 0.05)  # by the shorter way, over pi
    assert math.remainder(state.angle + 3.0, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)
    assert state.angle > 3.0
    assert state.rate == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_fins_oppose_error_rate_and_integral(sign: float) -> None:
    """A heading too far to starboard, or a turn to starboard, asks for port: a positive rudder."""
    assert sign * sliding_rudder(CONFIG, sign * 0.1, 0.0, 0.0, 0.0) > 0.0
    assert sign * sliding_rudder(CONFIG, 0.0, sign * 0.1, 0.0, 0.0) > 0.0
    assert sign * sliding_rudder(CONFIG, 0.0, 0.0, 0.0, sign * 0.1) > 0.0
    assert sign * pid_planes(CONFIG, sign * 0.1, 0.0, 0.0) > 0.0
    assert sign * pid_planes(CONFIG, 0.0, sign * 0.1, 0.0) > 0.0
    assert sign * pid_planes(CONFIG, 0.0, 0.0, sign * 0.1) > 0.0
    assert sliding_rudder(CONFIG, 0.0, 0.05, 0.05, 0.0) == pytest.approx(-0.05 / 0.25)  # r_d fed forward
