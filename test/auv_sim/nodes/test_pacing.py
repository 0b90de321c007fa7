"""The pacer with a clock made by hand."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_sim.nodes.pacing import Pacer


def test_one_step_a_period_beginning_at_once():
    pacer = Pacer(0.05)
    assert [pacer.due(100.0 + 0.05 * k + 1e-6) for k in range(5)] == [1, 1, 1, 1, 1]
    assert pacer.behind == 0.0


def test_too_early_is_not_yet():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    assert pacer.due(10.049) == 0
    assert pacer.due(10.051) == 1


def test_a_late_timer_is_caught_up():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    assert pacer.due(10.17) == 3  # those of 10.05, 10.10 and 10.15
    assert pacer.due(10.19) == 0
    assert pacer.due(10.21) == 1


@settings(deadline=None)
@given(st.lists(st.floats(0.0, 0.19), max_size=60), st.floats(0.01, 0.1))
def test_no_step_is_lost_or_invented_while_the_pace_is_kept(delays, period):
    pacer, now = Pacer(period, patience=0.2), 50.0
    taken = pacer.due(now)
    for delay in delays:
        now += delay
        taken += pacer.due(now)
        # Those of 50, 50 + period, ... up to now.
        assert taken == pytest.approx((now - 50.0) / period + 0.5, abs=0.5 + 1e-6)
    assert pacer.behind == 0.0


def test_a_machine_that_is_too_slow_makes_time_slow_and_says_how_far():
    pacer = Pacer(0.05, patience=0.2)
    pacer.due(10.0)
    assert pacer.due(20.0) == 5  # of 200: the lag that is caught up is bounded
    assert pacer.behind == pytest.approx(10.0 - 0.05 - 0.2)
    # From there on the pace is the usual one.
    assert [pacer.due(20.0 + 0.05 * k + 1e-6) for k in range(1, 4)] == [1, 1, 1]


def test_restart_counts_from_now():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    pacer.restart(500.0)
    assert pacer.due(500.0) == 1
    assert pacer.due(500.0) == 0
    assert pacer.behind == 0.0
