"""Look at the graph for conflicts before a launcher or simulator publishes anything."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import socket
import time
import uuid
from collections import Counter

from rclpy.node import Node
from std_msgs.msg import String

from auv_msgs_py.contract import claim as claims
from auv_msgs_py.contract import qos, topics
from auv_msgs_py.contract.claim import Claim
from auv_msgs_py.node.transport import generated_decoder
from auv_msgs_py.values.errors import ConfigurationError, MessageRefused

#: Duration of a look, s of wall time: discovery on one machine takes 0.1 to 0.2 s. A process that was killed
#: no longer announces itself, so a new participant does not see it.
LOOK = 0.5
#: Most time between two calls of `ended` that counts as looking, s: a process without processor time
#: discovers nothing.
_MOST_AT_ONCE = 0.1
#: Name that rclpy gives to a node of which only an endpoint has been discovered.
_UNKNOWN = "_NODE_NAME_UNKNOWN_"
#: Most claims that are kept.
_MOST = 1000


class GraphTaken(ConfigurationError):
    """What was about to be published is published already; the running nodes were not touched."""


class GraphLook:
    """Look for another /clock and for nodes of the same names, and hold a claim against later ones.

    Args:
        node: whose publisher and subscription are used; spin it.
        claim: what the process will publish; `process`, `since` and `token` are filled in here.
        own: full names of nodes of this process that are in the graph and publish /clock.
        length: duration of the look, s of wall time without pauses of this process.
    """

    def __init__(self, node: Node, claim: Claim, own: tuple[str, ...] = (), length: float = LOOK) -> None:
        self._node, self._length = node, length
        self.claim = dataclasses.replace(
            claim,
            process=f"process {os.getpid()} on {socket.gethostname()}",
            since=time.time_ns(),
            token=uuid.uuid4().hex,
        )
        self._own = Counter(own)
        self._others: dict[str, Claim] = {}
        self._looked, self._called = 0.0, time.monotonic()
        topic = topics.GRAPH_CLAIMS
        self._decode = generated_decoder(topic)
        self._publisher = node.create_publisher(String, topic.name, qos.offered(topic))
        self._publisher.publish(String(data=self.claim.encode()))
        profile = qos.requested(topic, reliable=True, depth=100)
        node.create_subscription(String, topic.name, self._on_claim, profile, raw=True)

    def _on_claim(self, data: bytes) -> None:
        with contextlib.suppress(MessageRefused):
            other = claims.decode(self._decode(data).data)
            if other is not None and len(self._others) < _MOST:
                self._others[other.token] = other

    def ended(self, ready: bool = True) -> bool:
        """Return whether the look is over without a conflict; from then on the claim is held. Call it often.

        Args:
            ready: whether the nodes have loaded; until then a longer look costs no time.

        Raises:
            GraphTaken: a conflict was found.
        """
        if self.claim.held:
            return True
        before, self._called = self._called, time.monotonic()
        self._looked += min(self._called - before, _MOST_AT_ONCE)
        over = ready and self._looked >= self._length
        self.check()
        self._check_graph(over)
        if over:
            self.claim = dataclasses.replace(self.claim, held=True)
            self._publisher.publish(String(data=self.claim.encode()))
        return over

    def check(self) -> None:
        """Compare with the claims received so far.

        Raises:
            GraphTaken: another claim conflicts with this one, and stays.
        """
        for other in self._others.values():
            contested = self.claim.contested(other)
            if contested and self.claim.gives_way_to(other):
                self._refuse(f"{contested} taken by {other.holder} ({other.process})")

    def _check_graph(self, over: bool) -> None:
        """Look for conflicts with nodes without a claim: nodes started one by one, foreign simulators."""
        names = Counter(
            topics.full_name(namespace, name)
            for name, namespace in self._node.get_node_names_and_namespaces()
            if namespace == self.claim.namespace and name in self.claim.names and name != topics.LAUNCHER
        )
        for name in sorted(names - self._own):
            self._refuse(f"{name} running")
        if not self.claim.clock:
            return
        clocks = Counter(
            topics.full_name(info.node_namespace, info.node_name)
            for info in self._node.get_publishers_info_by_topic(topics.CLOCK.name)
        )
        for name in sorted(clocks - self._own):
            if _UNKNOWN not in name:
                self._refuse(f"{topics.CLOCK.name} published by {name}")
            elif over:
                self._refuse(f"{topics.CLOCK.name} published by a node without a name")

    def _refuse(self, found: str) -> None:
        place = "ROS domain" if topics.CLOCK.name in found else "ROS domain or namespace"
        expected = f"a graph without it, hence another {place} (nothing that runs was touched)"
        raise GraphTaken(self.claim.holder, found, expected)
