"""The reference model: its limits hold for whatever guidance asks, and what it feeds forward is exact."""

from __future__ import annotations

import dataclasses
import math
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.control.hull_model import HullModel, tightest_turn
from auv_path_following.control.reference_model import (
    ReferenceConfig,
    ReferenceState,
    limits_of,
    prepare,
    shape,
)
from laws import Stepped

REMUS = vehicle.load("remus100")
RATE = REMUS.rudder.max_rate
CONFIG = ReferenceConfig(enabled=True)
DT = 0.05

angles = st.floats(-math.pi, math.pi)


def model(**changes):
    config = prepare(dataclasses.replace(CONFIG, **changes), REMUS, RATE)
    return Stepped(lambda c, state, inputs, dt: (shape(c, state, *inputs, dt),) * 2, config, ReferenceState())


@settings(max_examples=60)
@given(
    st.lists(st.tuples(angles, st.floats(-0.1, 0.1)), min_size=5, max_size=60),
    st.sampled_from([0.02, 0.05, 0.1]),
)
def test_rate_acceleration_and_jerk_stay_within_their_limits(requests, dt):
    reference = model()
    limits = reference.config.limits
    last = reference.update((0.3, 0.0, 0.3, 0.0), 0.0)
    for psi_d, r_d in requests:
        shaped = reference.update((0.3, 0.0, psi_d, r_d), dt)
        assert abs(shaped.acceleration) <= limits.acceleration * (1 + 1e-9)
        assert abs(shaped.acceleration - last.acceleration) <= limits.jerk * dt * (1 + 1e-9)
        # It brakes with limited jerk, so it may run over the rate a little, never far.
        assert (
            abs(shaped.rate)
            <= limits.rate + 0.5 * limits.acceleration**2 / limits.jerk + limits.acceleration * dt
        )
        last = shaped


@settings(max_examples=40)
@given(st.lists(angles, min_size=5, max_size=60))
def test_what_is_fed_forward_are_the_exact_derivatives(requests):
    reference = model()
    last = reference.update((0.0, 0.1, 0.0, 0.0), 0.0)
    for psi_d in requests:
        shaped = reference.update((0.0, 0.0, psi_d, 0.0), DT)
        assert shaped.rate == pytest.approx(last.rate + last.acceleration * DT, abs=1e-12)
        moved = last.rate * DT + 0.5 * last.acceleration * DT * DT
        assert wrap(shaped.angle - last.angle - moved) == pytest.approx(0.0, abs=1e-12)
        last = shaped


@pytest.mark.parametrize("psi_d", [-3.0, -0.5, 0.2, 3.1])
def test_it_comes_to_rest_on_what_is_asked_without_running_over_it_far(psi_d):
    reference = model()
    furthest = 0.0
    for _ in range(1200):
        shaped = reference.update((0.0, 0.0, psi_d, 0.0), DT)
        furthest = max(furthest, math.copysign(1.0, psi_d) * shaped.angle - abs(psi_d))
    assert shaped.angle == pytest.approx(psi_d, abs=1e-6)
    assert abs(shaped.rate) < 1e-6
    assert furthest < 0.06


def test_it_starts_from_the_vehicle_and_again_after_a_reset():
    reference = model()
    assert reference.update((1.2, 0.15, -1.0, 0.0), 0.0)[1:3] == pytest.approx((1.2, 0.15))
    reference.update((1.2, 0.15, -1.0, 0.0), DT)
    reference.reset()
    assert reference.update((-2.0, -0.1, 1.0, 0.0), DT)[1:3] == pytest.approx((-2.0, -0.1))


def test_it_follows_a_turning_path_without_lag():
    reference = model()
    for k in range(800):
        psi_d = wrap(0.02 * k * DT)
        shaped = reference.update((0.0, 0.0, psi_d, 0.02), DT)
    assert wrap(shaped.angle - psi_d) == pytest.approx(0.0, abs=1e-3)
    assert shaped.rate == pytest.approx(0.02, abs=1e-4)


def test_given_limits_are_taken_and_others_follow_from_hull_and_rudder():
    given_limits = dataclasses.replace(CONFIG, max_rate=0.2, max_acceleration=0.1, max_jerk=0.5)
    assert limits_of(given_limits, REMUS, RATE) == (0.2, 0.1, 0.5)
    slow, fast = (limits_of(CONFIG, REMUS, share * RATE) for share in (0.5, 1.0))
    assert fast.jerk == pytest.approx(2.0 * slow.jerk)
    assert fast.acceleration == pytest.approx(2.0 * slow.acceleration)
    assert slow.rate < fast.rate <= REMUS.top_speed / tightest_turn(REMUS).radius
    weak = limits_of(CONFIG, vehicle.load("remus100_mismatch"), RATE)
    assert weak.jerk < fast.jerk


def test_a_fast_servo_makes_no_larger_rudder():
    slow, fast = (limits_of(CONFIG, REMUS, rate) for rate in (RATE, 20.0 * RATE))
    assert fast.jerk == pytest.approx(20.0 * slow.jerk)
    assert fast.acceleration == pytest.approx(HullModel(REMUS).b * REMUS.rudder.max_angle / 3.0)


BARE = vehicle.Vehicle(
    name="measured",
    length=1.6,
    thrust_max=100.0,
    thrust_unit="percent",
    rudder=REMUS.rudder,
    cruise=vehicle.Cruise(thrust=100.0, speed=2.0),
    turning=vehicle.Turning(radius=4.2),
)


def test_without_a_hull_all_missing_limits_are_named_with_numbers_to_begin_with():
    names = ["max_rate", "max_acceleration", "max_jerk"]
    listed = ", ".join(f"reference.{name}" for name in names)
    with pytest.raises(
        ConfigurationError, match=f"measured: hull: .* derive {listed} from, which are 0"
    ) as error:
        limits_of(CONFIG, BARE, RATE)
    advised = dict(re.findall(r"(max_\w+): ([\d.]+)", error.value.expected))
    assert list(advised) == names
    given = dataclasses.replace(CONFIG, **{name: float(value) for name, value in advised.items()})
    for number, by_hull in zip(limits_of(given, BARE, RATE), limits_of(CONFIG, REMUS, RATE), strict=True):
        assert (
            0.5 * by_hull < number < by_hull
        )  # narrower, as b may be anything from once to three times so much
    with pytest.raises(
        ConfigurationError, match=r"reference\.max_jerk from, which is 0, .* turning: max_jerk: 0\.37$"
    ):
        limits_of(dataclasses.replace(given, max_jerk=0.0), BARE, RATE)
