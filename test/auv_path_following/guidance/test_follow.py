"""A step of guidance as a function of its arguments."""

from __future__ import annotations

import math

import pytest

from auv_msgs_py.values.types import NO_CURRENT, Current, Navigation, WaterVelocity
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.kinds.line import Line
from auv_path_following.guidance.acceptance import Cornering
from auv_path_following.guidance.approach import Agility, empty_approach
from auv_path_following.guidance.follow import (
    LONGEST_STEP,
    GuidanceOutput,
    first_state,
    follow,
)
from auv_path_following.guidance.measured import Measured
from auv_path_following.guidance.path_follower import PathFollowerConfig, prepare

SPEED, DT = 1.9, 0.1
AHEAD = WaterVelocity(SPEED, 0.0)
PATH = CompositePath([Line(0.0, 0.0, 60.0, 0.0), Line(60.0, 0.0, 60.0, math.pi / 2)]).rows
AGILITY = Agility(speed=SPEED, turn_rate=0.35, cornering=Cornering(rate=0.35, lead=0.5))


def measured(navigation: Navigation, water: WaterVelocity) -> Measured:
    return Measured(navigation, water, True, False, 0.0, 0.0)


def test_from_one_state_the_same_step_gives_the_same_result_again() -> None:
    """Along an approach, a corner and the end of the path, on the desired heading."""
    config = prepare(PathFollowerConfig(), AGILITY)
    state, outputs = first_state(config, empty_approach()), []
    x, y, psi = -30.0, 20.0, 0.0
    for k in range(2000):
        inputs = measured(Navigation(x, y, psi, 0.0), AHEAD), NO_CURRENT
        before = state
        state, output = follow(config, PATH, before, *inputs, DT if k else 0.0)
        assert (state, output) == follow(config, PATH, before, *inputs, DT if k else 0.0)
        outputs.append(output)
        if output.finished:
            break
        psi = output.psi_d
        x, y = x + SPEED * math.cos(psi) * DT, y + SPEED * math.sin(psi) * DT
    assert outputs[0].approach > 0.0 == outputs[-1].approach
    assert outputs[-1].finished
    assert [output.i for output in outputs if output.switched] == [1, 1]


def first_output(navigation: Navigation, water: WaterVelocity, current: Current) -> GuidanceOutput:
    config = prepare(PathFollowerConfig(minimum_speed=0.2))
    state = first_state(config, empty_approach())
    return follow(config, PATH, state, measured(navigation, water), current, 0.0)[1]


@pytest.mark.parametrize("speed", [0.0, 0.1, 0.19])
def test_below_the_least_speed_drift_and_alpha_are_not_used(speed: float) -> None:
    aside = Navigation(0.0, 2.0, 0.0, 0.0)
    output = first_output(aside, WaterVelocity(0.0, speed), Current(0.5, 0.5))
    assert (output.beta_r, output.alpha, output.theta_n) == (0.0, 0.0, 0.0)
    assert output.psi_d == pytest.approx(-math.atan(2.0 / 6.0))


def test_above_the_least_speed_they_are() -> None:
    output = first_output(Navigation(0.0, 0.0, 0.0, 0.0), WaterVelocity(0.2, 0.05), Current(0.0, 0.1))
    assert output.beta_r == pytest.approx(math.atan2(0.05, 0.2))
    assert output.theta_n == pytest.approx(0.1 / math.hypot(0.2, 0.05))


def test_a_long_gap_counts_as_a_short_one() -> None:
    config = prepare(PathFollowerConfig())
    inputs = measured(Navigation(0.0, 0.0, 0.0, 0.0), AHEAD), NO_CURRENT
    state, _ = follow(config, PATH, first_state(config, empty_approach()), *inputs, 0.0)
    _, output = follow(config, PATH, state, *inputs, 75.0)
    assert output.x_p == pytest.approx(SPEED * LONGEST_STEP)
