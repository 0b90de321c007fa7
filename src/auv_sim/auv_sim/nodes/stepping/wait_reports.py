"""Which node keeps a lockstep step from being answered, found in the nodes' diagnostics."""

from __future__ import annotations

import time
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.node.health import Health
from auv_msgs_py.node.lockstep_gate import LockstepGate
from auv_msgs_py.node.transport import generated_decoder

_BY_NAME = {topic.name: topic for topic in (*topics.CONTRACT, topics.RECORDED_STEPS)}


class WaitReports:
    """Keeps the newest report of each node: the topic it waits for, and the message it refused.

    Args:
        namespace: of the nodes, where there are others in the graph; empty: all are of one vehicle.
    """

    def __init__(self, namespace: str = "") -> None:
        self._prefix = f"{namespace}/" if namespace else ""
        self._waits: dict[str, tuple[float, str]] = {}
        self._refused: dict[str, str] = {}
        self._own, self._decode = namespace.encode(), generated_decoder(topics.DIAGNOSTICS)

    def hear(self, data: bytes) -> None:
        """Take in a serialised DiagnosticArray; one that names no own node is not even decoded."""
        if self._own in data:
            self.take_in(self._decode(data), time.monotonic())

    def take_in(self, diagnostics: Any, now: float) -> None:
        """Note the reports of a DiagnosticArray that arrived at `now`, s of steady time."""
        for status in diagnostics.status:
            if not status.name.startswith(self._prefix):
                continue
            for pair in status.values:
                if pair.key == "waiting_for":
                    self._waits[status.hardware_id] = now, pair.value
                elif pair.key == Health.REFUSED:
                    self._refused[status.hardware_id] = pair.value

    def culprit(self, missing: tuple[str, ...], since: float) -> str:
        """Return why a step has no answer: follow which node waits for which topic.

        The first node that reports nothing, or waits for nothing, is the culprit; or, on the way there, one
        that refused a message it waits for.

        Args:
            missing: topics that the simulator waits for.
            since: steady time at which the step was published, s; older reports do not count.
        """
        topic = _BY_NAME[missing[0]]
        if refusal := self._refusal(topics.PLANT, ", ".join(missing)):
            return refusal
        for _ in topics.CONTRACT:
            at, waits = self._waits.get(topic.publisher, (0.0, ""))
            if refusal := self._refusal(topic.publisher, waits):
                return refusal
            is_current = at > since
            following = _BY_NAME.get(waits.split(",")[0]) if is_current else None
            if following is None or following.publisher == topics.PLANT:
                if is_current and LockstepGate.lacks_reader(waits):
                    return f"{topic.publisher} waits for {waits}"
                break
            topic = following
        return f"{topic.publisher} did not send {topic.name}"

    def _refusal(self, node: str, waits: str) -> str:
        """Return the message that a node refused, with its value, if it waits for its topic; else empty."""
        refused = self._refused.get(node, "")
        is_awaited = refused.partition(":")[0] in waits.split(", ")
        return f"{node} refused {refused}" if refused and is_awaited else ""
