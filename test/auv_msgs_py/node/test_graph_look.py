"""The look at the graph over real DDS: each other party has a context, hence a participant, of its own."""

from __future__ import annotations

import dataclasses
import time
import types
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rosgraph_msgs.msg import Clock

from auv_msgs_py.contract.claim import Claim, of_simulator
from auv_msgs_py.node import graph_look
from auv_msgs_py.node.graph_look import LOOK, GraphLook, GraphTaken

MISSION = Claim(holder="/auv/mission_launcher", namespace="/auv", names=("ailos_guidance",), clock=True)
NO_CLOCK = Claim(holder="/auv/mission_launcher", namespace="/auv", names=("ailos_guidance",), clock=False)
#: Duration of a look that ends at once, with what it finds; a slow machine discovers late, s.
PATIENT = 60.0


class Party:
    """A node in a participant of its own."""

    def __init__(self, name: str, namespace: str) -> None:
        self.context = rclpy.Context()
        rclpy.init(args=[], context=self.context)
        self.node = rclpy.create_node(name, namespace=namespace, context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)

    def close(self) -> None:
        self.node.destroy_node()
        rclpy.try_shutdown(context=self.context)


@pytest.fixture
def party(domain: int) -> Iterator[Callable[[str, str], Party]]:
    made: list[Party] = []

    def make(name: str, namespace: str) -> Party:
        made.append(Party(name, namespace))
        return made[-1]

    yield make
    for one in made:
        one.close()


def looks(*parties: tuple[Party, GraphLook]) -> list[str]:
    """Let all look to the end; returns what each found, empty for nothing."""
    found: dict[int, str] = {}
    while len(found) < len(parties):
        for k, (party, look) in enumerate(parties):
            party.executor.spin_once(timeout_sec=0.005)
            try:
                if k not in found and look.ended():
                    found[k] = ""
            except GraphTaken as error:
                found[k] = str(error)
    return [found[k] for k in range(len(parties))]


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Callable[[float], None]:
    """Replace the steady clock of the look; call to set the time."""
    now = [0.0]
    fake = types.SimpleNamespace(monotonic=lambda: now[0], time_ns=time.time_ns)
    monkeypatch.setattr(graph_look, "time", fake)
    return lambda seconds: now.__setitem__(0, seconds)


def test_an_empty_graph_is_free_within_half_a_second(party: Any, clock: Callable[[float], None]) -> None:
    me = party("mission_launcher", "/auv")
    look = GraphLook(me.node, MISSION)
    for k in range(round(LOOK / 0.02)):
        assert not look.ended()
        clock(0.02 * (k + 1) + 1e-6)
    assert look.ended()
    assert look.claim.held


def test_a_pause_of_the_machine_is_no_look(party: Any, clock: Callable[[float], None]) -> None:
    """Nothing is discovered while this process gets no processor time."""
    me = party("mission_launcher", "/auv")
    look = GraphLook(me.node, MISSION)
    clock(10.0)
    assert not look.ended()
    clock(20.0)
    assert not look.ended()
    assert not look.claim.held


def test_a_node_of_the_same_name_is_named(party: Any) -> None:
    _, me = party("ailos_guidance", "/auv"), party("mission_launcher", "/auv")
    (found,) = looks((me, GraphLook(me.node, NO_CLOCK, length=PATIENT)))
    assert found.startswith("/auv/mission_launcher: found /auv/ailos_guidance running, expected a graph")


def test_two_vehicles_in_real_time_have_room_beside_each_other(party: Any) -> None:
    _, me = party("ailos_guidance", "/auv2"), party("mission_launcher", "/auv")
    assert looks((me, GraphLook(me.node, NO_CLOCK))) == [""]


def test_a_clock_of_any_simulator_is_named_unless_none_is_needed(party: Any) -> None:
    other, me = party("gazebo", "/"), party("mission_launcher", "/auv")
    other.node.create_publisher(Clock, "/clock", 10)
    (found,) = looks((me, GraphLook(me.node, MISSION, length=PATIENT)))
    assert "found /clock published by /gazebo" in found
    real = party("mission_launcher", "/auv2")
    no_clock = dataclasses.replace(NO_CLOCK, namespace="/auv2")
    assert looks((real, GraphLook(real.node, no_clock))) == [""]


def test_own_publishers_of_the_clock_do_not_count(party: Any) -> None:
    me = party("remus_plant", "/auv")
    me.node.create_publisher(Clock, "/clock", 10)
    assert looks((me, GraphLook(me.node, of_simulator("/auv", "remus_plant"), ("/auv/remus_plant",)))) == [""]


def test_a_later_claim_gives_way_to_a_held_one_and_of_two_at_once_one_stays(party: Any) -> None:
    first, second, third = (party("mission_launcher", name) for name in ("/auv", "/auv2", "/auv"))
    looking = first, GraphLook(first.node, MISSION)
    at_once = looks(looking, (second, GraphLook(second.node, MISSION, length=PATIENT)))
    assert sorted(bool(found) for found in at_once) == [False, True]
    assert at_once[0] == ""
    (late,) = looks((third, GraphLook(third.node, MISSION, length=PATIENT)))
    assert "/clock taken by /auv/mission_launcher (process" in late
