"""What a spoiled graph says: the mission's state and progress, and the nodes' reports in /diagnostics."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Callable
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import Vector3Stamped
from rclpy.node import Node
from std_msgs.msg import Float64, String

from auv_msgs_py.contract import qos, topics
from auv_msgs_py.node.transport import decoder
from auv_msgs_py.values.errors import MessageRefused
from auv_sim.nodes.fault_relay import raw


class GraphListener:
    """Listens to one graph.

    Args:
        node: whose subscriptions are used.
        relayed: whether there is a relay; the mission's state is then heard in front of it.

    Attributes:
        state: of the mission.
        s: path parameter.
        farthest: the largest path parameter since it was last set to 0.
        thrust_cmd: the last command.
        off_path: distance from the virtual point, m.
        said: node -> its last report.
        heard: node -> time of that report by `time.monotonic`, s.
        on_diagnostics: called with each node's name and report.
    """

    def __init__(self, node: Node, relayed: bool) -> None:
        self._node = node
        self.state = ""
        self.s = self.farthest = self.thrust_cmd = self.off_path = 0.0
        self.said: dict[str, DiagnosticStatus] = {}
        self.heard: dict[str, float] = {}
        self.on_diagnostics: Callable[[str, DiagnosticStatus], None] = lambda *_: None
        state = raw("mission_state") if relayed else "mission_state"
        self._listen(topics.DIAGNOSTICS, topics.DIAGNOSTICS.name, DiagnosticArray, self._on_diagnostics)
        self._listen(topics.MISSION_STATE, state, String, self._on_state)
        self._listen(topics.PATH_PARAMETER, "path_parameter", Float64, self._on_s)
        self._listen(topics.THRUST_CMD, "thrust_cmd", Float64, self._on_thrust)
        self._listen(topics.PATH_ERROR, "path_error", Vector3Stamped, self._on_error)

    def _listen(self, topic: topics.Topic, name: str, kind: type[Any], callback: Any) -> None:
        decode = decoder(topic)

        def guarded(data: bytes) -> None:
            with contextlib.suppress(MessageRefused):
                callback(decode(data))

        self._node.create_subscription(kind, name, guarded, qos.requested(topic, topic.latched), raw=True)

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            self.said[status.hardware_id] = status
            self.heard[status.hardware_id] = time.monotonic()
            self.on_diagnostics(status.hardware_id, status)

    def _on_state(self, message: String) -> None:
        self.state = message.data

    def _on_s(self, message: Float64) -> None:
        self.s = message.data
        self.farthest = max(self.farthest, self.s)

    def _on_error(self, message: Vector3Stamped) -> None:
        self.off_path = math.hypot(message.vector.x, message.vector.y)

    def _on_thrust(self, message: Float64) -> None:
        self.thrust_cmd = message.data


def says(status: DiagnosticStatus, text: str) -> bool:
    """Whether a report of a condition that is not OK contains this text."""
    if status.level == DiagnosticStatus.OK:
        return False
    conditions = [pair.value for pair in status.values if pair.key.startswith("condition")]
    return any(text in line for line in (status.message, *conditions))
