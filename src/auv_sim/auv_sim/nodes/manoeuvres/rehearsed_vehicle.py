"""The simulated vehicle of a rehearsal: free running, and never ahead of the node that flies it."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from auv_sim.nodes.plant_node import RemusPlantNode

#: Longest wait for the answer to an odometry, s of wall time; then the vehicle moves on, as a real one does.
PATIENCE = 2.0


class AwaitedAnswers:
    """The commands that the present odometry lacks, of those that have ever come."""

    def __init__(self) -> None:
        self._commanded: set[str] = set()
        self._missing: set[str] = set()
        self._since = 0.0

    def asked(self, now: float) -> None:
        """Begin to wait: an odometry was published at `now`, s of wall time."""
        self._missing, self._since = set(self._commanded), now

    def answered(self, topic: str) -> None:
        """Take a command in."""
        self._commanded.add(topic)
        self._missing.discard(topic)

    def complete(self, now: float) -> bool:
        """Return whether nothing is missing, or was waited for longer than `PATIENCE`."""
        return not self._missing or now - self._since > PATIENCE


class RehearsedVehicle(RemusPlantNode):
    """Takes a step once the commands for the present odometry have come, however slow the machine is.

    Before the first command it runs freely.

    Args:
        over: returns whether the program has ended; the vehicle then publishes no more.
    """

    def __init__(self, over: Callable[[], bool], **arguments: Any) -> None:
        self._over, self._answers_awaited = over, AwaitedAnswers()
        super().__init__(**arguments)
        assert self.free_run is not None
        self.free_run.may_step = self._may_step

    def publish_step(self) -> None:
        """Publish the present state and await its answer."""
        self._answers_awaited.asked(time.monotonic())
        super().publish_step()

    def take_command(self, topic: str, value: float) -> None:
        """Keep a command."""
        super().take_command(topic, value)
        self._answers_awaited.answered(topic)

    def _may_step(self) -> bool:
        """Return whether the program goes on and the present odometry has its answer."""
        return not self._over() and self._answers_awaited.complete(time.monotonic())
