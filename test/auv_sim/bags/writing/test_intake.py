"""A recorder's time by /clock, whatever comes on that topic."""

from __future__ import annotations

import struct
from types import SimpleNamespace
from typing import Any

import pytest

from auv_sim.bags.writing.intake import Taken, Timestamps

TOPIC: Any = SimpleNamespace(name="/clock")


def clock(seconds: int, nanoseconds: int) -> Taken:
    return Taken(1, 0, 1, 1, TOPIC, b"\x00\x01\x00\x00" + struct.pack("<iI", seconds, nanoseconds))


@pytest.mark.parametrize(
    "wrong", [clock(-1, 0), clock(2**31 - 1, 2**32 - 1), Taken(1, 0, 1, 1, TOPIC, b"\x00\x01\x00\x00\x05")]
)
def test_a_clock_that_is_no_time_moves_nothing(wrong: Taken) -> None:
    times = Timestamps(simulated=True)
    times.begin([wrong])
    assert times.of(clock(5, 0)) == (5_000_000_000, 5_000_000_000)
    assert times.of(wrong) == (5_000_000_000, 5_000_000_000)


def sent(at: int) -> Taken:
    return Taken(at, 1, 1, at, TOPIC, b"")


def tick(at: int, told: int) -> Taken:
    return clock(told, 0)._replace(sent_ns=at)


def test_a_message_gets_the_time_at_which_it_was_sent_not_the_newest() -> None:
    """It came while the topics were being emptied: /clock, emptied last, has gone on since."""
    times = Timestamps(simulated=True)
    batch = [tick(100, 1), sent(150), tick(200, 2), tick(300, 3), tick(400, 4)]
    times.begin(batch)
    assert [times.of(taken)[0] // 10**9 for taken in batch] == [1, 1, 2, 3, 4]
    late = [sent(199), sent(200), sent(350), tick(500, 5), sent(450), sent(500), sent(501)]
    assert [times.of(taken)[0] // 10**9 for taken in late] == [1, 2, 3, 5, 4, 5, 5]


def test_a_machine_clock_that_is_set_back_makes_nothing_old() -> None:
    times = Timestamps(simulated=True)
    hour = 3600 * 10**9
    batch = [tick(hour + 100, 1), tick(hour + 200, 2), tick(100, 3), sent(150), tick(200, 4), sent(250)]
    times.begin(batch)
    assert [times.of(taken)[0] // 10**9 for taken in batch] == [1, 2, 3, 3, 4, 4]
    assert times.of(sent(hour + 300))[0] == 4 * 10**9


def test_a_latched_message_of_long_ago_gets_the_newest_time() -> None:
    times = Timestamps(simulated=True)
    hour = 3600 * 10**9
    batch = [tick(hour, 1), tick(hour + 100, 2)]
    times.begin(batch)
    for taken in batch:
        times.of(taken)
    assert times.of(sent(5))[0] == 2 * 10**9


def test_hours_of_clock_need_no_more_memory() -> None:
    times = Timestamps(simulated=True)
    times.begin([])
    for k in range(50_000):
        times.of(tick(k, k))
    assert len(times._sent) == len(times._said) <= 20_000
    assert times.of(sent(45_000))[0] == 45_000 * 10**9
