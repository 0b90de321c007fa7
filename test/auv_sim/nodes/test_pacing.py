"""The pacer with a clock made by hand."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_sim.nodes.pacing import PATIENCE, Pacer


def test_one_step_a_period_beginning_at_once():
    pacer = Pacer(0.05)
    assert [pacer.due(100.0 + 0.025 * k + 1e-6) for k in range(6)] == [True, False] * 3
    assert pacer.behind == 0.0


def test_too_early_is_not_yet():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    assert not pacer.due(10.049)
    assert pacer.due(10.051)


def test_a_late_timer_is_caught_up_at_double_pace():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    # Those of 10.05, 10.10 and 10.15 are late; asked twice a period they are done by 10.22.
    assert [pacer.due(10.17 + pacer.ask_every * k) for k in range(4)] == [True, True, True, True]
    assert not pacer.due(10.249)
    assert pacer.behind == 0.0


@given(st.lists(st.floats(0.0, 0.9 * PATIENCE), max_size=60))
def test_no_step_is_lost_or_invented_while_the_pace_is_kept(delays):
    """Delays in periods, each followed by as many questions as are needed to catch up."""
    pacer, now = Pacer(0.05), 50.0
    taken = int(pacer.due(now))
    for delay in delays:
        now += 0.05 * delay
        while pacer.due(now):
            taken += 1
        # Those of 50, 50 + period, ... up to now.
        assert taken == pytest.approx((now - 50.0) / 0.05 + 0.5, abs=0.5 + 1e-6)
    assert pacer.behind == 0.0


def test_a_machine_that_is_too_slow_makes_time_slow_and_says_how_far():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    taken = sum(pacer.due(20.0 + 1e-9) for _ in range(300))
    assert taken in (PATIENCE, PATIENCE + 1)  # of 200; rounding decides about the last
    assert pacer.behind == pytest.approx(10.0 - (PATIENCE + 1) * 0.05, abs=1e-6)


def test_restart_counts_from_now():
    pacer = Pacer(0.05)
    pacer.due(10.0)
    pacer.restart(500.0)
    assert [pacer.due(500.0), pacer.due(500.0)] == [True, False]
    assert pacer.behind == 0.0
