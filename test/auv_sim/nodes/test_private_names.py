"""A node that defines a private method of its base would replace it unnoticed."""

from __future__ import annotations

import importlib

import pytest
from rclpy.node import Node

from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.launch.composed import NODES

RELAY = "auv_sim.nodes.fault_relay:FaultRelay"


@pytest.mark.parametrize("place", [*NODES.values(), RELAY])
def test_no_node_replaces_a_private_method_of_its_base(place: str) -> None:
    module, name = place.split(":")
    node = getattr(importlib.import_module(module), name)
    base = SuiteNode if issubclass(node, SuiteNode) else Node
    private = {key for key in vars(base) if key.startswith("_") and not key.startswith("__")}
    classes = node.__mro__[: node.__mro__.index(base)]
    assert [key for cls in classes for key in vars(cls) if key in private] == []
