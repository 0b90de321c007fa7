"""How far the simulator may be ahead of its recorder."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from std_msgs.msg import UInt64

from auv_msgs_py.contract import topics
from auv_sim.nodes.held_commands import orders_of
from auv_sim.nodes.stepping.recording_lead import RecordingLead
from hulls import REMUS


class Node:
    parameters = SimpleNamespace(recorded_vehicles=1)

    def __init__(self) -> None:
        self.asked: list[int] = []
        self.report: Callable[[UInt64], None]

    def advertise(self, _: Any) -> Any:
        return SimpleNamespace(publish=lambda message: self.asked.append(message.data))

    def listen(self, topic: Any, callback: Callable[[UInt64], None]) -> None:
        assert topic is topics.RECORDED_STEPS
        self.report = callback


def test_a_lead_that_is_used_up_waits_for_the_recorder_and_is_asked_for_in_time() -> None:
    node, proceeded = Node(), []
    lead = RecordingLead(node, orders_of(REMUS), lambda: proceeded.append(lead.used_up))
    for _ in range(topics.RECORDING_LEAD):
        assert not lead.used_up
        lead.count()
        lead.ask()
    assert lead.used_up
    assert node.asked
    assert node.asked[-1] <= topics.RECORDING_LEAD
    node.report(UInt64(data=1))
    assert proceeded == [False]
    lead.count()
    assert lead.used_up


def test_the_silence_begins_when_the_lead_is_used_up(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("auv_sim.nodes.stepping.recording_lead.time.monotonic", lambda: now[0])
    lead = RecordingLead(node := Node(), orders_of(REMUS), lambda: None)
    now[0] = 100.0
    for _ in range(topics.RECORDING_LEAD):
        lead.count()
    now[0] = 103.0
    assert lead.silence == 3.0
    node.report(UInt64(data=0))
    assert lead.silence == 0.0
