"""A recorder's time by /clock, whatever comes on that topic."""

from __future__ import annotations

import struct
from types import SimpleNamespace
from typing import Any

import pytest

from auv_sim.recording.intake import Taken, Timestamps

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
