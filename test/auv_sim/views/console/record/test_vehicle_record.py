"""One vehicle's record: what changes is sent once, and a late browser receives everything."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from auv_msgs_py.contract import topics
from auv_sim.views.console.record.readiness import CHAIN, NAVIGATION, PlanLines
from auv_sim.views.console.record.track_columns import NAMES, PLACE
from auv_sim.views.console.record.vehicle_record import VehicleRecord
from auv_sim.views.console.record.wire_messages import ROWS_HEADER, text_of

PLAN = PlanLines(True, ("short: flyable",))


def texts(messages: list[str | bytes], kind: str) -> list[dict[str, Any]]:
    found = [json.loads(message) for message in messages if isinstance(message, str)]
    return [message for message in found if message["kind"] == kind]


def rows(messages: list[str | bytes]) -> np.ndarray[Any, Any]:
    parts = [np.frombuffer(m[ROWS_HEADER.size :], "<f4") for m in messages if isinstance(m, bytes)]
    return np.concatenate([*parts, np.empty(0, np.float32)]).reshape(-1, len(NAMES))


def heads(messages: list[str | bytes]) -> list[tuple[int, ...]]:
    return [ROWS_HEADER.unpack_from(m) for m in messages if isinstance(m, bytes)]


def tick(record: VehicleRecord, now: float) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(record.tick(now))
    return found


def heard(record: VehicleRecord, now: float, *silent: str) -> None:
    for name in (*CHAIN, NAVIGATION):
        if name not in silent:
            record.health.hear(name, 0, "ok", now)


def test_changes_are_sent_once_and_a_late_browser_gets_all() -> None:
    record = VehicleRecord(2, "/auv")
    for k in range(5):
        record.values["x"] = 10.0 * k
        assert record.take_row(100.0 + k)
    first = record.changes(0.0)
    assert [m["t0"] for m in texts(first, "begin")] == [100.0]
    assert list(rows(first)[:, PLACE["t"]]) == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert rows(record.changes(0.1)).shape == (0, len(NAMES))
    record.take_row(105.0)
    more = record.changes(0.2)
    assert heads(more) == [(2, 1, 5, 1)]
    assert list(rows(record.whole(0.3))[:, PLACE["x"]]) == [0.0, 10.0, 20.0, 30.0, 40.0, 40.0]


def test_a_tick_is_sent_when_something_changes_and_else_once_a_second() -> None:
    record = VehicleRecord(0, "/auv")
    assert len(texts(record.changes(0.0), "tick")) == 1
    assert texts(record.changes(0.5), "tick") == []
    record.seen.stamp = 3.0
    assert len(texts(record.changes(0.6), "tick")) == 1
    assert len(texts(record.changes(1.7), "tick")) == 1


def test_a_lone_older_stamp_is_left_out_and_two_begin_a_new_table() -> None:
    record = VehicleRecord(0, "/auv")
    for stamp in (10.0, 11.0):
        record.take_row(stamp)
    record.changes(0.0)
    assert not record.take_row(5.0)
    assert record.take_row(12.0)
    assert not record.take_row(1.0)
    assert record.take_row(1.1), "time went back"
    found = record.changes(0.1)
    (begin,) = texts(found, "begin")
    assert (begin["epoch"], begin["t0"]) == (2, 1.1)
    assert list(rows(found)[:, PLACE["t"]]) == [0.0]
    assert not record.take_row(1.1), "the same stamp again"


def test_a_wall_clock_stamp_keeps_its_resolution() -> None:
    record = VehicleRecord(0, "/auv")
    for k in range(3):
        record.take_row(1.8e9 + 0.05 * k)
    assert rows(record.whole(0.0))[:, PLACE["t"]] == pytest.approx([0.0, 0.05, 0.1], abs=1e-6)


def test_a_restarted_console_shows_the_track_again(tmp_path: Path) -> None:
    before = VehicleRecord(0, "/auv", tmp_path)
    before.belongs_to("one")
    for k in range(4):
        before.values["y"] = float(k)
        before.take_row(1000.0 + k)
        before.changes(0.1 * k)
    again = VehicleRecord(0, "/auv", tmp_path)
    again.belongs_to("one")
    again.take_row(1004.0)
    found = again.changes(0.0)
    assert texts(found, "begin")[0]["t0"] == 1000.0
    assert list(rows(found)[:, PLACE["t"]]) == [0.0, 1.0, 2.0, 3.0, 4.0]
    other = VehicleRecord(0, "/auv", tmp_path)
    other.belongs_to("a simulator that was started anew")
    other.take_row(1004.0)
    assert len(rows(other.changes(0.0))) == 1


def test_another_publisher_begins_a_new_table() -> None:
    record = VehicleRecord(0, "/auv")
    record.belongs_to("one")
    record.take_row(50.0)
    record.changes(0.0)
    record.belongs_to("other")
    assert record.take_row(60.0)
    assert list(rows(record.changes(0.1))[:, PLACE["t"]]) == [0.0]


def test_a_silent_node_greys_the_state_and_raises_an_alarm_until_it_is_acknowledged() -> None:
    record = VehicleRecord(0, "/auv")
    heard(record, 0.0)
    record.progress.state = "running"
    assert texts(record.changes(1.9), "alarms") == []
    assert tick(record, 1.9)["fresh"] is True
    heard(record, 1.9, topics.GUIDANCE)
    (alarms,) = texts(record.changes(2.1), "alarms")
    assert [alarm["text"] for alarm in alarms["alarms"]] == ["ailos_guidance is silent"]
    now = tick(record, 2.1)
    assert now["fresh"] is False
    row = next(row for row in now["health"] if row["node"] == topics.GUIDANCE)
    assert (row["level"], row["age"]) == (3, 2.1)
    heard(record, 2.2)
    (alarms,) = texts(record.changes(2.3), "alarms")
    assert [alarm["active"] for alarm in alarms["alarms"]] == [False], "it stays"
    assert record.acknowledge(alarms["alarms"][0]["id"])
    assert texts(record.changes(2.4), "alarms")[0]["alarms"] == []
    assert not record.acknowledge(99)


def test_an_operators_hold_is_no_alarm_and_a_lost_navigation_is() -> None:
    record = VehicleRecord(0, "/auv")
    heard(record, 0.0)
    record.progress.state = "holding"
    record.progress.status = {"state": "holding", "reason": "hold was called"}
    record.health.hear(topics.GUIDANCE, 2, "holding: hold was called", 0.0)
    assert texts(record.changes(0.1), "alarms") == []
    record.progress.status = {"state": "holding", "reason": "no usable navigation for 0.5 s"}
    (alarms,) = texts(record.changes(0.2), "alarms")
    assert [alarm["text"] for alarm in alarms["alarms"]] == ["mission holds: no usable navigation for 0.5 s"]


def test_start_is_unlocked_by_the_preflight_alone() -> None:
    record = VehicleRecord(0, "/auv")
    record.progress.state = "idle"
    assert tick(record, 0.0)["can"] == {"start": False, "hold": False, "resume": False, "abort": True}
    heard(record, 0.0, NAVIGATION)
    assert not tick(record, 0.1)["can"]["start"], "the plan was not checked"
    record.set_course({"path": []}, PLAN)
    assert not tick(record, 0.1)["can"]["start"], "a vehicle starts only with its odometry"
    record.health.hear(topics.PLANT, 0, "waits", 0.1)
    assert tick(record, 0.1)["can"]["start"], "a simulator sends no odometry before the start"
    record.set_course({"path": []}, PlanLines(False, ("turn too tight",)))
    assert not tick(record, 0.1)["can"]["start"]
    record.set_course({"path": []}, PLAN)
    assert not tick(record, 2.2)["can"]["start"], "the nodes are silent"
    heard(record, 3.0)
    record.progress.state = "running"
    assert tick(record, 3.0)["can"] == {"start": False, "hold": True, "resume": False, "abort": True}
    record.progress.state = "holding"
    assert tick(record, 3.0)["can"]["resume"]


def test_a_start_is_refused_by_the_preflight_the_state_and_another_mission() -> None:
    record = VehicleRecord(0, "/auv")
    record.progress.state, record.progress.status = "idle", {"digest": "a"}
    record.set_course({"path": []}, PlanLines(False, ("turn too tight",)))
    heard(record, 0.0)
    assert record.start_refusal("a", 0.1) == "plan: turn too tight"
    record.set_course({"path": []}, PLAN)
    assert record.start_refusal("a", 0.1) == record.start_refusal(None, 0.1) == ""
    assert "another mission" in record.start_refusal("b", 0.1)
    assert record.start_refusal("a", 3.0).startswith("nodes: ")
    record.progress.state = "running"
    assert record.start_refusal("a", 0.1) == "the mission is running"


def test_an_alarm_begins_at_a_mission_time() -> None:
    record = VehicleRecord(0, "/auv")
    heard(record, 0.0)
    record.take_row(1000.0)
    record.progress.state, record.progress.status = "running", {"begun at [s]": "990.0"}
    record.progress.at(1000.0)
    heard(record, 2.1, topics.GUIDANCE)
    (alarms,) = texts(record.changes(2.2), "alarms")
    assert [alarm["since"] for alarm in alarms["alarms"]] == [10.0]


@pytest.mark.parametrize("state", ["idle", "complete", "aborted"])
def test_a_vehicle_whose_odometry_has_stopped_may_not_start(state: str) -> None:
    record = VehicleRecord(0, "/auv")
    record.progress.state = state
    record.set_course({"path": []}, PLAN)
    heard(record, 0.0)
    assert tick(record, 0.1)["can"]["start"]
    heard(record, 3.0, NAVIGATION)
    assert not tick(record, 3.0)["can"]["start"]
    record.health.hear(topics.PLANT, 0, "waits", 3.0)
    assert tick(record, 3.0)["can"]["start"], "a simulator that waits stops its odometry"


def test_figures_of_a_mission_under_way() -> None:
    record = VehicleRecord(0, "/auv")
    progress = record.progress
    progress.state = "running"
    progress.status = {
        "state": "running", "reason": "started", "length [m]": "200.0", "begun at [s]": "10.0",
        "flown share": "0.25",
    }  # fmt: skip
    for k in range(41):
        record.values |= {"x": 2.0 * k, "y": 0.0, "z": 0.0}
        record.take_row(10.0 + k)
    progress.to_go = 120.0
    record.set_course({"joints": [{"s": 70.0, "kind": "arc"}, {"s": 100.0, "kind": "line"}]}, PLAN)
    found = tick(record, 0.0)
    assert (found["mission_time"], found["flown"], found["reason"]) == (40.0, 50.0, "started")
    assert found["time_to_go"] == pytest.approx(60.0)
    assert found["next_joint"] == {"kind": "line", "distance": 20.0, "time": pytest.approx(10.0)}
    progress.state = "aborted"
    assert tick(record, 0.0)["reason"] == "", "the status is of another state"
    record.take_row(90.0)
    assert tick(record, 0.0)["mission_time"] == 40.0, "it stops with the mission"


def test_numbers_that_are_not_finite_are_null_in_json() -> None:
    assert json.loads(text_of("tick", a=float("nan"), b=[float("inf"), 1.0], c={"d": -float("inf")})) == {
        "kind": "tick", "a": None, "b": [None, 1.0], "c": {"d": None},
    }  # fmt: skip


def test_an_event_that_two_report_is_one() -> None:
    record = VehicleRecord(0, "/auv")
    record.events.add("running: started", "ailos_guidance", "info", None, 5.0)
    record.events.add("running: started", "ailos_guidance", "info", 0.1, 5.2)
    record.events.add("running: started", "ailos_guidance", "info", 0.1, 9.0)
    (events,) = texts(record.changes(0.0), "events")
    assert [event["id"] for event in events["events"]] == [1, 2]
    assert texts(record.changes(0.1), "events") == []
    assert len(texts(record.whole(0.2), "events")[0]["events"]) == 2
