"""The contract's quality of service, read off the graph."""

from __future__ import annotations

from functools import partial

from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.topics import Topic
from auv_path_following.nodes.current_observer_node import CurrentObserverNode
from auv_path_following.nodes.guidance_node import GuidanceNode
from auv_path_following.nodes.heading_autopilot_node import HeadingAutopilotNode
from auv_sim.nodes.plant_node import RemusPlantNode
from node_bench import Bench

ALL_NODES = (RemusPlantNode, CurrentObserverNode, GuidanceNode, HeadingAutopilotNode)


def _are_read(bench: Bench, topic: Topic, name: str) -> bool:
    readers = {info.node_name for info in bench.node.get_subscriptions_info_by_topic(name)}
    return set(topic.subscribers) <= readers


def test_every_endpoint_has_the_contracts_quality_of_service(bench: Bench) -> None:
    for make in ALL_NODES:
        # Only a simulator whose navigation has errors publishes the truth.
        bench.start(make, **({"sea": "rough"} if make is RemusPlantNode else {}))
    for topic in topics.CONTRACT:
        name = bench.node.resolve_topic_name(topic.name)
        durability = DurabilityPolicy.TRANSIENT_LOCAL if topic.latched else DurabilityPolicy.VOLATILE
        offered = [
            info
            for info in bench.node.get_publishers_info_by_topic(name)
            if info.node_name != "bench" and info.topic_type == topic.type
        ]
        assert offered, topic.name
        for info in offered:
            assert info.qos_profile.reliability is ReliabilityPolicy.RELIABLE, topic.name
            assert info.qos_profile.durability is durability, topic.name
        # Every one of them is there, or the loop below would say nothing.
        bench.until(partial(_are_read, bench, topic, name))
        for info in bench.node.get_subscriptions_info_by_topic(name):
            if info.node_name in topic.subscribers:
                expected = ReliabilityPolicy.RELIABLE if topic.latched else ReliabilityPolicy.BEST_EFFORT
                assert info.qos_profile.reliability is expected, topic.name
