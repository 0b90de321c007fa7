"""config/rviz/mission.rviz asks for topics that the nodes publish, with a QoS that matches theirs."""

from __future__ import annotations

from pathlib import Path

import yaml

from auv_msgs_py.contract import topics
from auv_sim.nodes.display import display_topics

FILE = Path(__file__).resolve().parents[1] / "config" / "rviz" / "mission.rviz"


def test_its_topics_exist_and_match() -> None:
    manager = yaml.safe_load(FILE.read_text(encoding="utf-8"))["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == "map"
    known = {
        f"/auv/{topic.name}": topic
        for topic in (
            display_topics.MARKERS, display_topics.LIVE_MARKERS, display_topics.ROBOT_DESCRIPTION,
            topics.ODOM,
        )
    }  # fmt: skip
    asked = [
        display.get("Topic") or display.get("Description Topic")
        for display in manager["Displays"]
        if "Topic" in display or "Description Topic" in display
    ]
    assert {topic["Value"] for topic in asked} == set(known)
    for topic in asked:
        latched = known[topic["Value"]].latched
        assert topic["Durability Policy"] == ("Transient Local" if latched else "Volatile")
        assert topic["Reliability Policy"] == ("Reliable" if latched else "Best Effort")
