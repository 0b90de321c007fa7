"""The simulator's lead over its recorder: it waits for what it has published to be recorded."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from std_msgs.msg import UInt64

from auv_msgs_py.contract import topics
from auv_msgs_py.values.types import STOP
from auv_sim.nodes.held_commands import Orders


class RecordingLead:
    """Counts the steps that are published and not yet recorded, and asks the recorder for its count.

    Args:
        node: the simulator.
        orders: of the vehicle; one that dives records more topics.
        proceed: called when more steps have been recorded.
    """

    def __init__(self, node: Any, orders: Orders, proceed: Callable[[], None]) -> None:
        lead = topics.RECORDING_LEAD if orders.stop == STOP else topics.SPATIAL_RECORDING_LEAD
        vehicles = node.parameters.recorded_vehicles
        self._lead = topics.shared(lead, vehicles)
        self._ask_every = topics.shared(topics.RECORDING_REQUEST, vehicles)
        self._proceed = proceed
        self._published = self._recorded = 0
        self._recorded_at = time.monotonic()
        self._request = node.advertise(topics.RECORD_REQUEST)
        node.listen(topics.RECORDED_STEPS, self._on_recorded)

    @property
    def used_up(self) -> bool:
        """Whether the next step has to wait for the recorder."""
        return self._published - self._recorded >= self._lead

    @property
    def silence(self) -> float:
        """Time since the recorder's last count, or since the lead was used up, s."""
        return time.monotonic() - self._recorded_at

    def count(self) -> None:
        """Count a step that is about to be published."""
        self._published += 1
        if self._published - self._recorded == self._lead:
            self._recorded_at = time.monotonic()

    def ask(self) -> None:
        """Ask the recorder for its count, every few steps, once a step is published."""
        if self._published % self._ask_every == 0:
            self._request.publish(UInt64(data=self._published))

    def _on_recorded(self, message: UInt64) -> None:
        self._recorded, self._recorded_at = int(message.data), time.monotonic()
        self._proceed()
