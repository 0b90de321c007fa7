"""Stamps: what is new, what is old, and what is a new beginning."""

from __future__ import annotations

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from auv_msgs_py.contract.stamps import Punctuality, StampGuard, StampTiming, StampVerdict

ACCEPT, REFUSE, RESTART = StampVerdict.ACCEPT, StampVerdict.REFUSE, StampVerdict.RESTART


def verdicts(stamps, ordered=False):
    guard = StampGuard(ordered)
    return [guard.judge(stamp).verdict for stamp in stamps]


@given(st.lists(st.integers(0, 2 * 10**18), min_size=1, max_size=20, unique=True), st.booleans())
def test_rising_stamps_are_accepted_with_the_seconds_between_them(stamps, ordered):
    stamps.sort()
    guard = StampGuard(ordered)
    ticks = [guard.judge(stamp) for stamp in stamps]
    assert {tick.verdict for tick in ticks} == {ACCEPT}
    assert ticks[0].dt == 0.0
    expected = [(b - a) / 1e9 for a, b in itertools.pairwise(stamps)]
    assert [tick.dt for tick in ticks[1:]] == pytest.approx(expected, rel=1e-12)


def test_dt_keeps_its_nanoseconds_on_a_clock_that_shows_the_date():
    guard = StampGuard()
    guard.judge(1_700_000_000_000_000_000)
    assert guard.judge(1_700_000_000_050_000_001).dt == pytest.approx(0.050000001, abs=1e-15)


@pytest.mark.parametrize("stamp", [100, 99, 50])
def test_a_lone_old_stamp_is_refused_counted_and_harmless(stamp):
    guard = StampGuard()
    guard.judge(100)
    assert guard.judge(stamp) == (REFUSE, 0.0)
    assert guard.refused == 1
    # The next good one counts from the last good one.
    assert guard.judge(150) == (ACCEPT, pytest.approx(50e-9))


def test_every_message_twice_is_no_restart():
    assert verdicts([1, 1, 2, 2, 3, 3]) == [ACCEPT, REFUSE] * 3


def test_time_that_went_back_is_seen_with_the_second_old_stamp():
    assert verdicts([100, 110, 5, 15, 25]) == [ACCEPT, ACCEPT, REFUSE, RESTART, ACCEPT]


def test_one_old_message_sent_again_and_again_is_no_restart():
    assert verdicts([100, 60, 60, 60, 110]) == [ACCEPT, REFUSE, REFUSE, REFUSE, ACCEPT]


def test_old_stamps_apart_from_each_other_are_no_restart():
    assert verdicts([100, 60, 110, 70, 120]) == [ACCEPT, REFUSE, ACCEPT, REFUSE, ACCEPT]


def test_in_lockstep_the_first_older_stamp_is_a_restart_and_an_equal_one_is_not():
    assert verdicts([100, 100, 50, 60], ordered=True) == [ACCEPT, REFUSE, RESTART, ACCEPT]


def test_after_a_restart_dt_counts_from_it():
    guard = StampGuard(ordered=True)
    guard.judge(10**9)
    assert guard.judge(0) == (RESTART, 0.0)
    assert guard.judge(5 * 10**7).dt == pytest.approx(0.05)


def test_reset_makes_the_next_stamp_a_first_one():
    guard = StampGuard()
    guard.judge(100)
    guard.reset()
    assert guard.judge(1) == (ACCEPT, 0.0)


def timings(pairs, bound=1.0):
    punctuality = Punctuality(bound)
    return [punctuality.judge(now, round(stamp * 1e9)) for now, stamp in pairs]


@pytest.mark.parametrize("offset", [0.0, -1e9, 37.5])
def test_a_clock_that_is_wrong_is_none_of_our_business(offset):
    pairs = [(1000.0 + 0.1 * k, 1000.0 + 0.1 * k + offset) for k in range(100)]
    assert set(timings(pairs)) == {StampTiming.PUNCTUAL}


def test_messages_that_begin_to_come_late_are_late_until_they_come_in_time():
    good = [(10.0 + 0.1 * k, 10.0 + 0.1 * k) for k in range(20)]
    late = [(14.0 + 0.1 * k, 12.0 + 0.1 * k) for k in range(300)]
    again = [(45.0 + 0.1 * k, 45.0 + 0.1 * k) for k in range(3)]
    verdicts = timings(good + late + again)
    assert set(verdicts[20:320]) == {StampTiming.LATE}
    assert set(verdicts[320:]) == {StampTiming.PUNCTUAL}


def test_two_clocks_may_drift_apart():
    pairs = [(k * 0.1, k * 0.1 * (1.0 - 5e-4)) for k in range(1, 100_000, 10)]
    assert set(timings(pairs)) == {StampTiming.PUNCTUAL}


def test_a_lone_stamp_from_the_future_is_refused_and_a_clock_set_forward_is_accepted():
    assert timings([(10.0, 10.0), (10.1, 110.0), (10.2, 10.2)]) == [
        StampTiming.PUNCTUAL, StampTiming.EARLY, StampTiming.PUNCTUAL,
    ]  # fmt: skip
    assert timings([(10.0, 10.0), (10.1, 110.0), (10.2, 110.1), (10.3, 110.2)]) == [
        StampTiming.PUNCTUAL, StampTiming.EARLY, StampTiming.STEPPED, StampTiming.PUNCTUAL,
    ]  # fmt: skip


def test_a_clock_that_is_set_forward_twice_is_accepted():
    twice = [(10.0, 10.0), (10.05, 15.05), (10.1, 1010.1), (10.15, 1010.15), (10.2, 1010.2)]
    assert timings(twice) == [
        StampTiming.PUNCTUAL, StampTiming.EARLY, StampTiming.EARLY, StampTiming.STEPPED, StampTiming.PUNCTUAL,
    ]  # fmt: skip


def test_a_receiver_whose_clock_stood_still_takes_no_sender_for_one_whose_clock_was_set():
    """After a pause a node may read several stamps before the /clock that came with them."""
    paused = [(10.0, 10.0), (10.0, 12.0), (10.0, 12.05), (10.01, 12.1), (12.15, 12.15), (12.2, 12.2)]
    assert timings(paused) == [
        StampTiming.PUNCTUAL, *[StampTiming.EARLY] * 3, StampTiming.PUNCTUAL, StampTiming.PUNCTUAL,
    ]  # fmt: skip


def test_an_unset_clock_judges_nothing_and_one_that_goes_back_begins_anew():
    assert (
        timings([(0.0, 500.0), (0.0, 1.0), (500.0, 500.0), (1.0, 1.0), (1.1, 1.1)])
        == [StampTiming.PUNCTUAL] * 5
    )
