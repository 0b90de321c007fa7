"""docs/interface.md names every topic of the table with its type, and no other."""

from __future__ import annotations

import re
from pathlib import Path

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState

PAGE = Path(__file__).resolve().parents[1] / "docs" / "interface.md"
ALL = (*topics.CONTRACT, *topics.SPATIAL_CONTRACT, *topics.RECORDING, topics.GRAPH_CLAIMS, topics.GOAL_POSE)
ROW = re.compile(r"^\| `([^`]+)` \| ([a-z_]+/msg/\w+) \|(?: (\w+) \|)?", re.MULTILINE)


def test_the_page_and_the_table_agree() -> None:
    listed = {name: kind for name, kind, _ in ROW.findall(PAGE.read_text(encoding="utf-8"))}
    table = {topic.name: topic.type for topic in ALL}
    assert listed == table


def test_the_page_names_every_state_of_a_mission() -> None:
    assert f"| {', '.join(MissionState)};" in PAGE.read_text(encoding="utf-8")


def test_the_page_names_the_right_publisher() -> None:
    publishers = {topic.name: topic.publisher for topic in ALL}
    for name, _, publisher in ROW.findall(PAGE.read_text(encoding="utf-8")):
        if publisher in {topics.OBSERVER, topics.GUIDANCE, topics.AUTOPILOT, topics.RECORDER}:
            assert publishers[name] == publisher
