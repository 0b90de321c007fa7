"""What a vehicle's feed takes at a poll, from queues that the test fills."""

from __future__ import annotations

from collections import deque
from typing import Any

import pytest
from rcl_interfaces.msg import Log
from std_msgs.msg import Float64, String

from auv_sim.nodes.console import graph_feed, vehicle_feed
from auv_sim.nodes.console.graph_feed import GraphFeed
from auv_sim.nodes.console.vehicle_feed import VehicleFeed
from auv_sim.views.console.record.fault_log import FaultLog
from auv_sim.views.console.record.vehicle_record import VehicleRecord


class Queues:
    """Stand in for the subscriptions: bounded queues, by the topic's full name."""

    def __init__(self) -> None:
        self.of: dict[str, deque[Any]] = {}

    def reader(self, _: Any, __: Any, name: str, depth: int = 1) -> Any:
        queue = self.of[name] = deque[Any](maxlen=depth)

        class Reader:
            def take(self) -> Any | None:
                return queue.popleft() if queue else None

        return Reader()


@pytest.fixture
def queues(monkeypatch: pytest.MonkeyPatch) -> Queues:
    found = Queues()
    for module in (vehicle_feed, graph_feed):
        monkeypatch.setattr(module, "PolledReader", found.reader)
    return found


def test_a_state_that_is_published_twice_counts_at_once(queues: Queues) -> None:
    record = VehicleRecord(0, "/auv")
    feed = VehicleFeed(None, record, 0, lambda: 5.0, FaultLog(print, lambda: 0.0))  # type: ignore[arg-type]
    words = queues.of["/auv/mission_state"]
    for word in ("running", "aborted"):
        words += [String(data=word)] * 2
        feed.poll()
        assert record.progress.state == word


def test_a_reader_that_fails_is_logged_and_keeps_no_other_from_reading(queues: Queues) -> None:
    record, lines = VehicleRecord(0, "/auv"), list[str]()
    feed = VehicleFeed(None, record, 0, lambda: 5.0, FaultLog(lines.append, lambda: 0.0))  # type: ignore[arg-type]
    queues.of["/auv/rudder_cmd"].append("no message")
    queues.of["/auv/thrust_cmd"].append(Float64(data=3.0))
    feed.poll()
    assert record.values["thrust"] == 3.0
    assert len(lines) == 1
    assert lines[0].startswith("the console failed at /auv rudder_cmd: AttributeError: ")


def test_a_flood_of_log_lines_is_read_in_parts(queues: Queues) -> None:
    faults = FaultLog(print, lambda: 0.0)
    graph = GraphFeed(None, ("/auv",), None, 0, str, print, faults)  # type: ignore[arg-type]
    queue = queues.of["/rosout"]
    queue += [Log(level=20, name="auv.ailos_guidance", msg=f"line {k}") for k in range(100)]
    graph.poll()
    assert len(queue) == 100 - graph_feed.MOST_AT_ONCE
    assert len(graph.records[0].events.after(0)) == graph_feed.MOST_AT_ONCE
