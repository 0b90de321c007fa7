"""The sampled linear loop: against loops that can be solved by hand, and against what flights show."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.contract import topics
from auv_msgs_py.settings import params_file
from auv_path_following import config_files, vehicle
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.control.rule.gain_rule import gains_for
from auv_sim.own_vehicle.tune.gain_space import GainSet
from auv_sim.own_vehicle.tune.sampled_loop import (
    LinearPlane,
    SampledLoop,
    is_stable,
    loop_of,
    margins,
    spectral_radius,
    yaw_plane,
)
from auv_sim.sim_parameters import SUITE
from auv_sim.studies.gains.gain_flights import unrest
from hulls import REMUS, STABLE, drawn

#: Yaw rate alone, r' = -u; the heading's gain is next to nothing.
TURNS = LinearPlane(np.array([[-1.0, 0, 0], [0, 0, 0], [0, 1.0, 0]]), np.array([[0.0], [-1.0], [0.0]]))


def on_rate(gain: float) -> SampledLoop:
    none = np.zeros((0, 0))
    return SampledLoop(none, np.zeros((0, 2)), np.zeros((1, 0)), np.array([[1e-6, gain]]))


@pytest.mark.parametrize(("delay", "largest"), [(0.0, 2.0), (0.5, 2.0), (1.0, 1.0)])
def test_a_sampled_integrator(delay: float, largest: float) -> None:
    """r' = -K r, sampled once a second, with no delay, half a period and a whole one."""
    assert is_stable(TURNS, on_rate(0.98 * largest), 1.0, delay)
    assert not is_stable(TURNS, on_rate(1.02 * largest), 1.0, delay)


@settings(max_examples=6)
@given(st.floats(1.5, 5.0), st.floats(0.05, 0.15))
def test_margins_of_an_integrator_with_delay(gain: float, delay: float) -> None:
    """Sampled fast it is the continuous loop K exp(-s tau)/s: stable for K tau < pi/2."""
    found = margins(TURNS, on_rate(gain), 0.01, delay)
    late = delay + 0.005  # the hold delays by half a period
    assert found.is_stable
    assert found.up == pytest.approx(min(0.5 * math.pi / (gain * late), 16.0), rel=0.02)
    assert found.delay == pytest.approx(min(0.5 * math.pi / gain - late, 1.0), rel=0.02)


@given(st.floats(0.0, 0.6), st.floats(0.02, 0.1))
@settings(max_examples=30)
def test_more_delay_never_helps_an_integrator(delay: float, step: float) -> None:
    radii = [spectral_radius(TURNS, on_rate(3.0), step, late) for late in (delay, delay + 0.03)]
    assert radii[0] <= radii[1] + 1e-9


@pytest.mark.parametrize("hull", [REMUS, STABLE])
def test_the_hull_is_that_of_the_rule(hull) -> None:
    """From the rudder to the yaw rate, at several frequencies; a positive rudder turns to port."""
    plane, response = yaw_plane(hull), response_of(hull)
    for w in (0.3, 2.0, 9.0):
        gain = np.linalg.solve(1j * w * np.eye(3) - plane.A, plane.B)[1, 0]
        assert gain == pytest.approx(-response.gain(w), rel=1e-9)


def test_a_hull_that_was_only_measured_has_the_measured_response() -> None:
    peer = vehicle.load("mss_remus100")
    plane, response = yaw_plane(peer), response_of(peer)
    gain = np.linalg.solve(2j * np.eye(3) - plane.A, plane.B)[1, 0]
    assert gain == pytest.approx(-response.gain(2.0), rel=1e-9)


def test_the_rule_has_margins_where_the_default_is_unstable() -> None:
    default = params_file.load(config_files.find("params", "robust"), SUITE)[topics.AUTOPILOT].autopilot
    ruled = gains_for(REMUS, 0.15, 0.1).heading.autopilot
    plane = yaw_plane(REMUS)
    assert not margins(plane, loop_of(default, REMUS, 0.1), 0.1, 0.15).is_stable
    found = margins(plane, loop_of(ruled, REMUS, 0.1), 0.1, 0.15)
    assert found.up > 1.3
    assert found.down > 1.3
    assert found.delay > 0.05


@pytest.mark.parametrize(("hull", "cycles"), [(REMUS, True), (drawn(2), False)])
def test_it_says_what_flights_show(hull, cycles: bool) -> None:
    """The default gains with 150 ms at 10 odometries a second: the table of docs/tuning.md."""
    default = params_file.load(config_files.find("params", "robust"), SUITE)
    steering = default[topics.AUTOPILOT]
    flown = GainSet(default[topics.GUIDANCE].guidance, steering.autopilot, steering.pitch)
    loop = loop_of(flown.autopilot, hull, 0.1)
    assert is_stable(yaw_plane(hull), loop, 0.1, 0.15) is not cycles
    assert (unrest(hull, 0.15, 0.1, flown) > 0.3) is cycles
