"""What a node notices without looking into a message."""

from __future__ import annotations

from auv_msgs_py.node.watch import ClockWatch, RateWatch


def floods(watch, rate, seconds, period=0.5):
    now, found = 100.0, []
    for _ in range(int(seconds / period)):
        watch.counts["odom"] += round(rate * period)
        watch.counts["desired_yaw"] += round(20 * period)
        now += period
        found.append(watch.floods(now))
    return found


def test_a_flood_is_named_and_the_others_are_not():
    assert floods(RateWatch(500.0), 2000.0, 2.0) == [{}, *[{"odom": 2000.0}] * 3]


def test_what_a_vehicle_sends_is_no_flood():
    assert floods(RateWatch(500.0), 100.0, 2.0) == [{}] * 4


def test_too_little_time_says_nothing_and_loses_nothing():
    watch = RateWatch(500.0)
    watch.floods(0.0)
    watch.counts["odom"] += 200
    assert watch.floods(0.1) is None
    assert watch.floods(0.25) == {"odom": 800.0}


def test_a_clock_that_goes_back_begins_anew():
    watch = RateWatch(500.0)
    watch.floods(100.0)
    watch.counts["odom"] += 10_000
    assert watch.floods(1.0) == {}


def test_a_clock_that_stands_still_is_reported_once_it_has_run():
    watch = ClockWatch(2.0)
    assert [watch.stands_still(0.0, t) for t in (0.0, 5.0, 10.0)] == [False] * 3
    assert [watch.stands_still(1.0, t) for t in (10.1, 12.0, 12.2)] == [False, False, True]
    assert not watch.stands_still(1.05, 12.3)
