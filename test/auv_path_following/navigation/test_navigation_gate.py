"""Which odometry is accepted."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.values.types import Navigation
from auv_path_following.navigation.navigation_gate import NavigationGate, NavigationGateConfig, Passed

ACCEPTED, REFUSED, MOVED = Passed.ACCEPTED, Passed.REFUSED, Passed.MOVED
DT = 0.1
TOP_SPEED = 2.0


@pytest.fixture
def gate():
    return NavigationGate(NavigationGateConfig(), TOP_SPEED)


def at(t, north=0.0, psi=0.0, r=0.0):
    """A vehicle that goes east at 2 m/s."""
    return Navigation(north, 2.0 * t, psi, r)


def fly(gate, measurements, under_way=True, dt=DT):
    return [gate.judge(navigation, dt, under_way).passed for navigation in measurements]


@settings(max_examples=50)
@given(
    st.lists(
        st.tuples(st.floats(-4.4, 4.4), st.floats(-math.pi, math.pi), st.floats(-2.4, 2.4)),
        min_size=2, max_size=40,
    )
)  # fmt: skip
def test_what_a_vehicle_can_do_is_always_accepted(steps):
    gate = NavigationGate(NavigationGateConfig(), TOP_SPEED)
    x = y = psi = 0.0
    for k, (speed, course, r) in enumerate(steps):
        x += speed * math.cos(course) * DT
        y += speed * math.sin(course) * DT + 1e-6 * k
        psi = math.remainder(psi + r * DT, 2.0 * math.pi)
        assert gate.judge(Navigation(x, y, psi, r), DT, True).passed is ACCEPTED


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        (at(1.1, north=100.0), "position 100.0 m"),
        (at(1.1, psi=math.pi), "heading 180 deg"),
        (at(1.1, psi=-1.6), "heading 92 deg"),
        (at(1.1, r=100.0), "yaw rate of 100 rad/s"),
    ],
)
def test_a_lone_outlier_is_refused_and_named(gate, wrong, named):
    assert set(fly(gate, [at(k * DT) for k in range(11)])) == {ACCEPTED}
    judged = gate.judge(wrong, DT, True)
    assert judged.passed is REFUSED
    assert named in judged.found
    assert fly(gate, [at(1.2), at(1.3)]) == [ACCEPTED, ACCEPTED]


@pytest.mark.parametrize("jump", [{"north": 100.0}, {"psi": math.pi}, {"psi": 1.6}])
def test_a_jump_that_stays_is_accepted_after_a_while_and_only_then(gate, jump):
    fly(gate, [at(k * DT) for k in range(11)])
    verdicts = fly(gate, [at(k * DT, **jump) for k in range(11, 60)])
    first = verdicts.index(MOVED)
    assert set(verdicts[:first]) == {REFUSED}
    assert first * DT == pytest.approx(3.0, abs=2 * DT)
    assert set(verdicts[first + 1 :]) == {ACCEPTED}


def test_places_that_do_not_agree_are_never_accepted(gate):
    fly(gate, [at(k * DT) for k in range(11)])
    wild = [at(k * DT, north=300.0 + 100.0 * (k % 2)) for k in range(11, 100)]
    assert set(fly(gate, wild)) == {REFUSED}


@pytest.mark.parametrize(
    ("step", "named"),
    [
        (Navigation(5.2, 0.0, 0.0, 0.0), "a position that moved"),
        (Navigation(0.0, 0.1, 0.4, 0.0), "a heading that turned"),
    ],
)
def test_a_place_that_runs_away_in_small_steps_is_never_accepted(gate, step, named):
    """Every step is within the margin of one; together they are not, nor do they agree among themselves."""
    judged = [
        gate.judge(
            Navigation(step.x * k, step.y * k, math.remainder(step.psi * k, math.tau), 0.0), 0.05, True
        )
        for k in range(400)
    ]
    assert named in next(j.found for j in judged if j.passed is REFUSED)
    # A heading that spins is now and then where it may be.
    assert [j.passed for j in judged].count(ACCEPTED) < 200
    assert MOVED not in [j.passed for j in judged]


@given(
    st.lists(
        st.tuples(st.floats(-1.7, 1.7), st.floats(-1.7, 1.7), st.floats(-0.17, 0.17)),
        min_size=100,
        max_size=200,
    )
)
@settings(max_examples=20)
def test_noise_within_the_margins_is_accepted_for_ever(noise):
    gate = NavigationGate(NavigationGateConfig(), TOP_SPEED)
    for k, (x, y, psi) in enumerate(noise):
        assert gate.judge(Navigation(x, 2.0 * k * DT + y, psi, 0.0), DT, True).passed is ACCEPTED


def test_after_refused_positions_a_heading_that_turned_meanwhile_is_accepted(gate):
    def turning(k, north=0.0):
        return at(k * DT, north=north, psi=0.7 * k * DT, r=0.7)

    fly(gate, [turning(k) for k in range(11)])
    assert set(fly(gate, [turning(k, north=100.0 * (1 + k % 2)) for k in range(11, 41)])) == {REFUSED}
    assert set(fly(gate, [turning(k) for k in range(41, 60)])) == {ACCEPTED}


def test_an_impossible_yaw_rate_never_becomes_possible(gate):
    fly(gate, [at(0.0)])
    assert set(fly(gate, [at(k * DT, r=100.0) for k in range(1, 200)])) == {REFUSED}


def test_a_first_measurement_is_accepted_wherever_it_is(gate):
    assert gate.judge(at(0.0, north=1e5, psi=3.0), 0.0, False).passed is ACCEPTED
    gate.reset()
    assert gate.judge(at(0.0, north=-1e5), DT, False).passed is ACCEPTED


def test_after_a_dropout_the_vehicle_may_be_where_it_can_have_come_to(gate):
    fly(gate, [at(0.0)])
    assert gate.judge(at(10.0, psi=2.0), 10.0, True).passed is ACCEPTED
    assert gate.judge(at(10.0, north=80.0), 10.0, True).passed is REFUSED


def test_a_frozen_pose_is_refused_until_it_changes(gate):
    fly(gate, [at(k * DT) for k in range(11)])
    verdicts = fly(gate, [at(1.0)] * 40)
    assert verdicts.index(REFUSED) * DT == pytest.approx(2.0, abs=2 * DT)
    # The vehicle has been stopped since, which is no reason to accept it again.
    assert set(fly(gate, [at(1.0)] * 40, under_way=False)) == {REFUSED}
    assert fly(gate, [at(1.1), at(1.2)]) == [ACCEPTED, ACCEPTED]


def test_a_pose_that_froze_under_way_is_refused_also_when_the_vehicle_is_stopped_meanwhile(gate):
    fly(gate, [at(k * DT) for k in range(11)])
    assert set(fly(gate, [at(1.0)] * 10)) == {ACCEPTED}
    assert REFUSED in fly(gate, [at(1.0)] * 15, under_way=False)


@pytest.mark.parametrize("late", [1, 3])
def test_a_vehicle_that_stops_dead_may_lie_still_though_its_log_says_so_a_moment_later(gate, late):
    fly(gate, [at(k * DT) for k in range(11)])
    assert set(fly(gate, [at(1.0)] * late)) == {ACCEPTED}
    assert set(fly(gate, [at(1.0)] * 1000, under_way=False)) == {ACCEPTED}


def test_after_a_freeze_the_vehicle_may_be_where_it_can_have_come_to(gate):
    fly(gate, [at(k * DT) for k in range(11)])
    fly(gate, [at(1.0)] * 50)
    assert fly(gate, [at(6.0, psi=1.5), at(6.1, psi=1.6)]) == [ACCEPTED, ACCEPTED]


def test_a_vehicle_that_lies_still_may_say_so(gate):
    assert set(fly(gate, [at(1.0)] * 1000, under_way=False)) == {ACCEPTED}


def test_a_slow_navigation_behind_a_fast_odometry_is_not_frozen(gate):
    slow = [at(math.floor(k * DT)) for k in range(100)]  # a new pose once a second
    assert set(fly(gate, slow)) == {ACCEPTED}


def test_it_can_be_switched_off():
    gate = NavigationGate(NavigationGateConfig(enabled=False), TOP_SPEED)
    assert fly(gate, [at(0.0), at(0.1, north=1000.0, r=50.0)]) == [ACCEPTED, ACCEPTED]
