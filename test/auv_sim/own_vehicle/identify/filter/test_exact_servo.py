"""The exact servo against the simulator's in fine steps, and its smoothness in the dead time."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from auv_path_following.vehicle import Rudder
from auv_sim.own_vehicle.identify.filter.exact_servo import fin_angles
from auv_sim.vehicle.fins.actuator import FlawedServoState, RudderFlaws, flawed_servo_of, turn_flawed

PERIOD, FINE = 0.05, 0.0005


def exact(
    commands: NDArray[np.float64], rate: float, dead_time: float, band: float, play: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    times = PERIOD * np.arange(commands.size + 1)
    means, changes = np.zeros(commands.size), np.zeros(commands.size)
    fin_angles(times, times[:-1], commands, rate, dead_time, band, play, means, changes)
    return means, changes


def stepped(
    commands: NDArray[np.float64], rate: float, dead_time: float, band: float, play: float
) -> NDArray[np.float64]:
    rudder = Rudder(max_angle_deg=60.0, max_rate_deg_s=math.degrees(rate))
    flaws = RudderFlaws(
        dead_band_deg=math.degrees(band), backlash_deg=2.0 * math.degrees(play), dead_time=dead_time
    )
    servo, state = flawed_servo_of(rudder, flaws, FINE), FlawedServoState()
    means = []
    for command in commands:
        middles = []
        for k in range(round(PERIOD / FINE)):
            state, fins = turn_flawed(servo, state, (float(command), k == 0), FINE)
            middles.append(fins[1])
        means.append(np.mean(middles))
    return np.array(means)


@given(
    seed=st.integers(0, 1000),
    rate=st.floats(0.1, 3.0),
    steps=st.integers(0, 400),
    band=st.sampled_from([0.0, 0.0035, 0.01]),
    play=st.sampled_from([0.0, 0.002, 0.01]),
)
@example(seed=73, rate=0.25, steps=0, band=0.0035, play=0.0)  # back at rest just as a command comes
@settings(max_examples=15)
def test_means_are_those_of_the_simulated_servo_in_fine_steps(
    seed: int, rate: float, steps: int, band: float, play: float
) -> None:
    generator = np.random.default_rng(seed)
    commands = np.cumsum(generator.normal(0.0, 0.02, 40)) * generator.integers(0, 2, 40)
    commands[0] = 0.0
    dead_time = steps * FINE
    means, _ = exact(commands, rate, dead_time, band, play)
    assert means == pytest.approx(stepped(commands, rate, dead_time, band, play), abs=2.0 * rate * FINE)


def test_the_line_of_best_fit_follows_a_steady_sweep() -> None:
    commands = np.full(20, 1.0)
    commands[0] = 0.0
    means, changes = exact(commands, 0.2, 0.0, 0.0, 0.01)
    assert changes[10] == pytest.approx(0.2 * PERIOD)
    assert means[10] == pytest.approx(0.2 * 9.5 * PERIOD - 0.01)  # behind by half the play, moving up
    down, _ = exact(-commands, 0.2, 0.0, 0.0, 0.01)
    assert down == pytest.approx(-means)


def test_means_change_smoothly_with_the_dead_time() -> None:
    generator = np.random.default_rng(1)
    commands = np.append(0.0, np.repeat(generator.uniform(-0.3, 0.3, 6), 10))
    delays = np.linspace(0.06, 0.09, 31)
    table = np.array([exact(commands, 0.3, delay, 0.0, 0.0)[0] for delay in delays])
    slope = np.diff(table, axis=0) / np.diff(delays)[:, None]
    assert np.abs(slope).max() <= 0.3 + 1e-9  # never more than the rate: no jump
