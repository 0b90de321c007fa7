"""The node that flies manoeuvres, over DDS: a whole program, another node's commands, lost navigation."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import pytest

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Navigation
from auv_sim.nodes.manoeuvres.manoeuvres_node import ManoeuvresNode
from node_bench import Bench

PROGRAM = """
version: 1
name: short
legs:
  - straight: {seconds: 0.5, thrust: 0.5}
  - circle: {seconds: SECONDS, rudder_deg: 10}
"""


def started(bench: Bench, tmp_path: Path, seconds: float) -> Any:
    file = tmp_path / "short.yaml"
    file.write_text(PROGRAM.replace("SECONDS", str(seconds)))
    bench._listen(topics.MISSION_STATE)
    return bench.start(ManoeuvresNode, role=topics.AUTOPILOT, program=str(file), consent=True, lateness=60.0)


def words(bench: Bench) -> list[str]:
    heard = [message.data for message in bench.received["mission_state"]]
    return [word for word, _ in itertools.groupby(heard)]


def fly(bench: Bench, steps: int, begin: int = 0) -> None:
    for k in range(begin, begin + steps):
        count = len(bench.received["thrust_cmd"])
        bench.odometry(10.0 + 0.1 * k, Navigation(0.19 * k, 0.0, 0.0, 0.0))
        bench.until(lambda count=count: len(bench.received["thrust_cmd"]) > count)  # type: ignore[misc]


def test_it_does_not_move_without_consent(bench: Bench) -> None:
    with pytest.raises(ConfigurationError, match="manoeuvres: consent: found false"):
        bench.start(ManoeuvresNode)


def test_a_program_is_flown_and_ends_with_zeros(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 0.5)
    fly(bench, 12)
    bench.until(lambda: node.finished)
    rudder = [message.data for message in bench.received["rudder_cmd"]]
    thrust = [message.data for message in bench.received["thrust_cmd"]]
    assert thrust[0] == pytest.approx(3.24) and rudder[0] == 0.0
    assert max(rudder) == pytest.approx(0.1745, abs=1e-3)  # to port
    assert thrust[-5:] == [0.0] * 5 and rudder[-5:] == [0.0] * 5
    assert words(bench) == ["running", "complete"]
    assert not node.fault


def test_commands_of_another_node_stop_it(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    topic = topics.RUDDER_CMD
    bench.node.create_publisher(qos.message_class(topic.type), topic.name, qos.offered(topic))
    bench.until(lambda: bool(node.run.over))
    assert "rudder_cmd is published by /auv/bench, /auv/manoeuvres" in node.run.over
    count = len(bench.received["thrust_cmd"])
    bench.until(lambda: len(bench.received["thrust_cmd"]) > count)
    assert bench.received["thrust_cmd"][-1].data == 0.0
    bench.until(lambda: words(bench) == ["running", "aborted"])


def test_lost_navigation_and_its_own_end_stop_it(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    bench.until(lambda: bool(node.run.over))
    assert node.run.over == "no usable odometry"
    bench.until(lambda: bench.received["thrust_cmd"][-1].data == 0.0)
    bench.until(lambda: bool(node.fault))
    assert node.fault == "ended early: no usable odometry"


def test_it_sends_zeros_when_it_is_interrupted(bench: Bench, tmp_path: Path) -> None:
    node = started(bench, tmp_path, 60.0)
    fly(bench, 3)
    node.close()
    bench.until(lambda: bench.received["thrust_cmd"][-1].data == 0.0)
    assert node.run.over == "interrupted"
