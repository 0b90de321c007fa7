"""The missions that `mission_status` reports in a recording."""

from __future__ import annotations

from pathlib import Path

from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from rclpy.serialization import serialize_message

from auv_msgs_py.contract import topics
from auv_sim.bags.content.mission_list import listed
from auv_sim.bags.definitions import definition
from auv_sim.bags.reading.recording import Bag, RecordedTopic


def bag_of(*statuses: dict[str, str]) -> Bag:
    kind = topics.MISSION_STATUS.type
    topic = RecordedTopic("/auv/mission_status", kind, definition(kind).text, "ros2msg")
    for k, values in enumerate(statuses):
        pairs = [KeyValue(key=key, value=value) for key, value in values.items()]
        topic.put(k + 1, k, k, serialize_message(DiagnosticStatus(values=pairs)), True)
    return Bag(Path("bag"), topics={topic.name: topic})


def status(name: str, begun: str, state: str, **more: str) -> dict[str, str]:
    return {"mission": name, "digest": name * 2, "begun at [s]": begun, "state": state, **more}


def test_a_mission_is_listed_once_it_has_begun_and_again_when_it_begins_anew() -> None:
    found = listed(
        bag_of(
            status("a", "", "idle"),
            status("a", "1.5", "running"),
            status("a", "1.5", "aborted", reason="abort was called"),
            status("a", "9.0", "running", **{"start at": "subpath 2"}),
            status("b", "", "holding"),
            status("b", "30.0", "complete"),
        ),
        None,
    )
    assert [(one.name, one.begun, one.place, one.state) for one in found] == [
        ("a", 1.5, "", "aborted"), ("a", 9.0, "subpath 2", "running"), ("b", 30.0, "", "complete"),
    ]  # fmt: skip
    assert found[0].reason == "abort was called"
    assert found[2].digest == "bb"


def test_statuses_without_usable_numbers_list_nothing() -> None:
    assert listed(bag_of({}, status("a", "soon", "running"), status("a", "nan", "running")), None) == []
    assert listed(Bag(Path("bag")), None) == []
