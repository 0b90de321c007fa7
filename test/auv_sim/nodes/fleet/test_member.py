"""One vehicle of a fleet in lockstep: when it reports and when it waits, without ROS."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.wire import Clock
from auv_sim.nodes.fleet.member import FleetMember

FIRST = topics.FIRST_STAMP_NS


class Node:
    """The part of the simulator's node that is used."""

    def __init__(self) -> None:
        self.reports: list[int] = []
        self.on_clock: Any = None

    def advertise(self, topic: Any) -> Any:
        assert topic is topics.VEHICLE_PROGRESS
        return SimpleNamespace(publish=self._publish)

    def _publish(self, message: Clock) -> None:
        self.reports.append(message.clock.sec * 10**9 + message.clock.nanosec)

    def listen(self, topic: Any, callback: Any) -> None:
        assert topic is topics.CLOCK
        self.on_clock = callback


def clock(ns: int) -> Any:
    return SimpleNamespace(clock=SimpleNamespace(sec=ns // 10**9, nanosec=ns % 10**9))


def test_it_waits_one_second_ahead_of_the_clock_and_goes_on_with_it() -> None:
    node, proceeded = Node(), []
    member = FleetMember(node, lambda: proceeded.append(1))
    step, stamp = 50_000_000, FIRST
    while member.may_take(step, stamp):
        stamp += step
    assert stamp == FIRST + topics.FLEET_LEAD_NS
    assert node.reports == [FIRST, FIRST + topics.FLEET_REPORT_NS, FIRST + topics.FLEET_LEAD_NS]
    node.on_clock(clock(FIRST + step))
    assert proceeded == [1]
    assert member.may_take(step, stamp)
    member.repeat()
    assert node.reports[-1] == stamp


@pytest.mark.parametrize("step", [1_000_000, 50_000_000, 333_000_000, 490_000_000, 700_000_000, 10**9])
def test_the_last_vehicle_waits_only_for_its_own_report(step: int) -> None:
    """/clock stands at its last report; with any step that a simulator has, it may take the next one."""
    node = Node()
    member = FleetMember(node, lambda: None)
    for k in range(2 * 10**9 // step + 5):
        stamp = FIRST + k * step
        if not member.may_take(step, stamp):
            node.on_clock(clock(node.reports[-1]))
            assert member.may_take(step, stamp), k
