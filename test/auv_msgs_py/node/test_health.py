"""What is refused is logged once for each kind, and counted every time."""

from __future__ import annotations

import pytest

from auv_msgs_py.contract import topics
from auv_msgs_py.node.health import Health
from auv_msgs_py.values.errors import MessageRefused
from node_bench import Bench


class Log:
    def __init__(self) -> None:
        self.lines: list[str] = []

    def error(self, line: str) -> None:
        self.lines.append(line)


@pytest.fixture
def reporting(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> tuple[Health, list[str]]:
    log = Log()
    monkeypatch.setattr(bench.node, "get_logger", lambda: log)
    return Health(bench.node), log.lines


def late(topic: str) -> MessageRefused:
    return MessageRefused(topic, "a stamp that is not newer than the last", "rising stamps")


def test_two_topics_in_turn_are_two_lines(reporting: tuple[Health, list[str]]) -> None:
    health, lines = reporting
    for _ in range(100):
        health.refuse(late("odom"))
        health.refuse(late("velocity_through_water"))
    assert len(lines) == 2
    assert health.refused == {"odom": 100, "velocity_through_water": 100}


def test_another_kind_on_one_topic_is_logged_with_both_names(
    reporting: tuple[Health, list[str]],
) -> None:
    health, lines = reporting
    health.refuse(late("odom"))
    health.refuse(MessageRefused("odom", "frame_id 'earth' with child_frame_id 'keel'", "a pair of map"))
    assert len(lines) == 2 and "earth" in lines[1] and "keel" in lines[1]


def test_another_number_is_not_another_kind(reporting: tuple[Health, list[str]]) -> None:
    health, lines = reporting
    for k in range(50):
        found, expected = f"a position {30.0 + k:.1f} m away", f"at most {1.5 * k:.1f} m after {k:.2e} s"
        health.refuse(MessageRefused("odom", found, expected))
    assert len(lines) == 1
    health.refuse(MessageRefused("odom", "a heading 90 deg away", "at most 30 deg"))
    assert len(lines) == 2


def test_what_comes_just_after_a_report_is_published_long_before_the_next_one_is_due(bench: Bench) -> None:
    """The next regular report of this node would come in an hour; and a flood is not a flood of reports."""
    bench._listen(topics.DIAGNOSTICS)
    health = Health(bench.node, period=3600.0)
    bench.until(lambda: health._publisher.get_subscription_count() == 1)
    for name in ("first", "second"):
        health.publish()
        for _ in range(50):
            health.refuse(late(name))
        bench.until(lambda name=name: bench.diagnosed(f"refused: {name}"))
    bench.spin(0.3)
    assert len(bench.received[topics.DIAGNOSTICS.name]) < 10
