"""Random, cut and extreme bytes to the decoder of every topic that a node subscribes to."""

from __future__ import annotations

import math
import random
import struct
from collections.abc import Callable
from typing import Any

import pytest
from rclpy.serialization import serialize_message

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.runtime import SuiteNode
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.launch.vehicle_driver import free_port
from auv_sim.nodes.mavlink.driver import MavlinkDriverNode
from auv_sim.nodes.plant_node import RemusPlantNode
from node_bench import Bench

NODES: dict[str, tuple[Callable[..., SuiteNode], dict[str, Any]]] = {
    "observer": (CurrentObserverNode, {"use_sim_time": True}),
    "guidance": (GuidanceNode, {"use_sim_time": True}),
    "autopilot": (HeadingAutopilotNode, {"use_sim_time": True}),
    "plant": (RemusPlantNode, {}),
    "plant in lockstep": (RemusPlantNode, {"lockstep": True}),
    "driver": (MavlinkDriverNode, {}),
}
BY_NAME = {topic.name: topic for topic in (*topics.CONTRACT, *topics.RECORDING)}
#: Numbers at the edges of float64, and a few that pass every check.
NUMBERS = (math.nan, math.inf, -math.inf, 1e308, -1e308, 5e-324, -0.0, 0.0, 1.0, 1e8, 4.2)


def start_node(bench: Bench, which: str) -> SuiteNode:
    """Start a node; the driver at a port that is free now."""
    make, parameters = NODES[which]
    if which == "driver":
        return bench.start(make, topics.PLANT, address=f"udpin:127.0.0.1:{free_port()}")
    return bench.start(make, **parameters)


def entries(node: SuiteNode) -> list[tuple[Topic, Callable[[bytes], None]]]:
    """Return what the middleware would call for each topic, and the topic."""
    return [
        (BY_NAME[name], subscription.callback)
        for subscription in node.subscriptions
        for name in ("/clock", "/diagnostics", subscription.topic_name.rsplit("/", 1)[-1])
        if name in BY_NAME and name.lstrip("/") == subscription.topic_name.rsplit("/", 1)[-1]
    ]


def example(topic: Topic) -> bytes:
    """Return a message of the topic that has a frame, a time and a text where its type has one."""
    message = qos.message_class(topic.type)()
    if hasattr(message, "header"):
        message.header.frame_id = "base_link" if topic is topics.WATER_VELOCITY else "map"
        message.header.stamp.sec = 5
    if hasattr(message, "child_frame_id"):
        message.child_frame_id = "base_link"
    if isinstance(getattr(message, "data", None), str):
        message.data = "running"
    return bytes(serialize_message(message))


@pytest.mark.parametrize("which", NODES)
def test_no_bytes_end_a_node_and_every_refusal_is_counted(bench: Bench, which: str) -> None:
    node = start_node(bench, which)
    chance = random.Random(which)
    heard = entries(node)
    assert {topic for topic, _ in heard} >= {t for t in topics.PER_STEP if node.get_name() in t.subscribers}
    for topic, receive in heard:
        whole = example(topic)
        before = node.health.refused[topic.name]
        last_field = len(whole) - 1 if topic is not topics.DIAGNOSTICS else len(whole) - 4
        cut = sorted(chance.sample(range(last_field), min(last_field, 40)))
        for length in cut:
            receive(whole[:length])
        assert node.health.refused[topic.name] - before == len(cut), topic.name
        for _ in range(200):
            receive(chance.randbytes(chance.randrange(0, 2 * len(whole))))
            receive(b"\x00\x01\x00\x00" + chance.randbytes(chance.randrange(0, 2 * len(whole))))
            changed = bytearray(whole)
            for _ in range(chance.randrange(1, 8)):
                changed[chance.randrange(len(changed))] = chance.randrange(256)
            receive(bytes(changed))
    # Lockstep ends a run that has a second publisher of a command, and says so: random bytes are one.
    assert not node.fault or (which == "plant in lockstep" and "second message within one step" in node.fault)
    node.health.publish()
    bench.until(lambda: bench.diagnosed("refused: ") or node.fault)


@pytest.mark.parametrize("which", [name for name in NODES if name != "plant in lockstep"])
def test_no_numbers_end_a_node(bench: Bench, which: str) -> None:
    """Well-formed messages whose every float64 is extreme, with rising stamps."""
    node = start_node(bench, which)
    chance = random.Random(which)
    for k in range(400):
        for topic, receive in entries(node):
            data = bytearray(example(topic))
            if topic.type.endswith(("Clock", "String", "DiagnosticArray", "UInt64")):
                continue
            if "Float64" not in topic.type:
                struct.pack_into("<iI", data, 4, 6 + k, chance.choice((0, 1, 999_999_999)))
            start = -(-(len(data) - 8) // 8) * 8 if "Float64" in topic.type else 40
            for at in range(len(data) - 8, start - 8, -8):
                struct.pack_into("<d", data, at, chance.choice(NUMBERS))
            receive(bytes(data))
    assert not node.fault
    bench.spin(0.1)
    for topic in (topics.RUDDER_CMD, topics.THRUST_CMD):
        assert all(math.isfinite(value) for value in bench.values(topic))
