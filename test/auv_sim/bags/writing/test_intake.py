"""A recorder's time by /clock, whatever comes on that topic."""

from __future__ import annotations

import struct
from types import SimpleNamespace
from typing import Any

import pytest

from auv_sim.bags.writing.intake import ReceivedMessage, Timestamps

TOPIC: Any = SimpleNamespace(name="/clock")


def clock(seconds: int, nanoseconds: int) -> bytes:
    return b"\x00\x01\x00\x00" + struct.pack("<iI", seconds, nanoseconds)


def sent(at: int) -> ReceivedMessage:
    return at, 1, 1, at, TOPIC, b""


def tick(at: int, told: int) -> ReceivedMessage:
    return at, 0, 1, at, TOPIC, clock(told, 0)


def times_of(times: Timestamps, batch: list[ReceivedMessage]) -> list[int]:
    """Return the log time of each message, s, as a recorder gives it."""
    found = []
    for sent_ns, order, _, received_ns, _, data in batch:
        if order == 0:
            times.tick(sent_ns, data)
        log_ns, publish_ns = times.of(sent_ns, received_ns)
        assert log_ns == publish_ns
        found.append(log_ns // 10**9)
    return found


@pytest.mark.parametrize("wrong", [clock(-1, 0), clock(2**31 - 1, 2**32 - 1), b"\x00\x01\x00\x00\x05"])
def test_a_clock_that_is_no_time_moves_nothing(wrong: bytes) -> None:
    times = Timestamps(simulated=True)
    spoiled: ReceivedMessage = (1, 0, 1, 1, TOPIC, wrong)
    times.begin([spoiled])
    assert times_of(times, [tick(1, 5), spoiled]) == [5, 5]


def test_a_message_gets_the_time_at_which_it_was_sent_not_the_newest() -> None:
    """It came while the topics were being emptied: /clock, emptied last, has gone on since."""
    times = Timestamps(simulated=True)
    batch = [tick(100, 1), sent(150), tick(200, 2), tick(300, 3), tick(400, 4)]
    times.begin(batch)
    assert times_of(times, batch) == [1, 1, 2, 3, 4]
    late = [sent(199), sent(200), sent(350), tick(500, 5), sent(450), sent(500), sent(501)]
    assert times_of(times, late) == [1, 2, 3, 5, 4, 5, 5]


def test_a_machine_clock_that_is_set_back_makes_nothing_old() -> None:
    times = Timestamps(simulated=True)
    hour = 3600 * 10**9
    batch = [tick(hour + 100, 1), tick(hour + 200, 2), tick(100, 3), sent(150), tick(200, 4), sent(250)]
    times.begin(batch)
    assert times_of(times, batch) == [1, 2, 3, 3, 4, 4]
    assert times_of(times, [sent(hour + 300)]) == [4]


def test_a_latched_message_of_long_ago_gets_the_newest_time() -> None:
    times = Timestamps(simulated=True)
    hour = 3600 * 10**9
    batch = [tick(hour, 1), tick(hour + 100, 2)]
    times.begin(batch)
    times_of(times, batch)
    assert times_of(times, [sent(5)]) == [2]


def test_what_comes_before_the_first_clock_gets_its_time() -> None:
    times = Timestamps(simulated=True)
    batch = [sent(50), tick(100, 7)]
    times.begin(batch)
    assert times_of(times, batch) == [7, 7]


def test_without_simulated_time_the_machines_clock_counts() -> None:
    times = Timestamps(simulated=False)
    times.tick(10, clock(5, 0))
    assert times.now is None
    assert times.of(20, 30) == (30, 20)


def test_hours_of_clock_need_no_more_memory() -> None:
    times = Timestamps(simulated=True)
    times.begin([])
    for k in range(50_000):
        times.tick(k, clock(k, 0))
    assert len(times._sent) == len(times._clock_times) <= 20_000
    assert times_of(times, [sent(45_000)]) == [45_000]
