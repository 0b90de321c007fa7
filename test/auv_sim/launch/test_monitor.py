"""When the launcher takes a mission for flown, whatever single messages say."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from geometry_msgs.msg import Vector3Stamped
from std_msgs.msg import Float64, String

from auv_sim.launch import monitor
from auv_sim.launch.monitor import Monitor


@pytest.fixture
def flying(domain: int) -> Iterator[Monitor]:
    """A launcher in the middle of a path of seven subpaths."""
    made = Monitor("/auv")
    made._on_state(String(data="running"))
    made._on_parameter(Float64(data=2.1))
    made._on_to_go(Float64(data=350.0))
    yield made
    made.close()


def test_complete_counts_at_the_end_of_the_path_only(flying: Monitor) -> None:
    flying._on_state(String(data="complete"))
    flying._on_state(String(data="complete"))
    assert not flying.completed(7)
    flying._on_parameter(Float64(data=7.0))
    assert not flying.completed(7)
    flying._on_to_go(Float64(data=0.0))
    assert flying.completed(7)


def test_running_takes_back_a_complete(flying: Monitor, monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(monitor.time, "monotonic", lambda: now[0])
    flying._on_state(String(data="complete"))
    now[0] += monitor._UNDISPUTED - 0.1
    flying._on_state(String(data="running"))
    now[0] += monitor._UNDISPUTED
    assert not flying.completed(7)
    flying._on_state(String(data="complete"))
    now[0] += monitor._UNDISPUTED
    assert flying.completed(7)  # the last path_parameter was lost; the recording decides


def test_one_forged_abort_ends_nothing(flying: Monitor) -> None:
    flying._on_state(String(data="aborted"))
    assert flying.state == "running"
    flying._on_state(String(data="running"))
    assert flying.state == "running"


def test_numbers_and_stamps_that_mean_nothing_are_left_out(flying: Monitor) -> None:
    for wrong in (float("nan"), float("inf"), -1.0):
        flying._on_parameter(Float64(data=wrong))
    message = Vector3Stamped()
    message.header.stamp.sec, message.header.stamp.nanosec = 2**31 - 1, 2**32 - 1
    flying._on_error(message)
    assert (flying.s, flying.stamp, flying.mission_time) == (2.1, 0, 0.0)
