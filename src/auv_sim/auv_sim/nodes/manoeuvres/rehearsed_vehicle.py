"""The simulated vehicle of a rehearsal: free running, and never ahead of the node that flies it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.node.lockstep_gate import LockstepGate
from auv_msgs_py.node.runtime import SuiteNode
from auv_sim.nodes.held_commands import orders_of
from auv_sim.nodes.manoeuvres.manoeuvres_node import INTERRUPTED, ManoeuvresNode
from auv_sim.nodes.plant_node import RemusPlantNode

#: Longest wait for the answer to an odometry, s of wall time; then the vehicle moves on, as a real one does.
#: Of the time between two looks no more than `LOOK` counts: a process that was stopped has not waited.
PATIENCE, LOOK = 2.0, 0.1
_COMMANDS = (topics.RUDDER_CMD, topics.THRUST_CMD, topics.STERNPLANE_CMD)
#: Longest time for which the vehicle coasts after the program, s; time that the node which flies it
#: waits for its next step, s of wall time.
COASTING, _STALL = 15.0, 3.0
#: Counts as an answer: the first message that the mission runs.
_RUNNING = topics.MISSION_STATE.name


class AwaitedAnswers:
    """The commands that the present odometry lacks.

    Args:
        commands: topics of the commands that answer each odometry.
    """

    def __init__(self, commands: Iterable[str]) -> None:
        self._commands = frozenset(commands)
        self._missing: set[str] = set()
        self._begun = False
        self._looked = self._waited = 0.0

    def asked(self, now: float) -> None:
        """Begin to wait: an odometry was published at `now`, s of wall time.

        Until the mission runs, that is awaited too.
        """
        self._missing = set(self._commands) | (set() if self._begun else {_RUNNING})
        self._looked, self._waited = now, 0.0

    def answered(self, topic: str) -> None:
        """Take a command in, or the state of a mission that runs."""
        self._begun = self._begun or topic == _RUNNING
        self._missing.discard(topic)

    def complete(self, now: float) -> bool:
        """Return whether nothing is missing, or was waited for longer than `PATIENCE`."""
        self._waited += min(now - self._looked, LOOK)
        self._looked = now
        return not self._missing or self._waited > PATIENCE


class RehearsedVehicle(RemusPlantNode):
    """Takes a step once the commands for the present odometry have come, however slow the machine is.

    The first odometry is published once all readers are matched, and the vehicle coasts for a time of its own
    after the program: one seed makes one flight, to the last bit.

    Args:
        flyer: returns the node that flies it.
    """

    def __init__(self, flyer: Callable[[], ManoeuvresNode], **arguments: Any) -> None:
        self._flyer = flyer
        self._gates: list[LockstepGate] = []
        self._coasts_from: tuple[int, float] | None = None
        super().__init__(**arguments)
        self._answers_awaited = AwaitedAnswers(orders_of(self.vehicle).limits)
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

    def mission_runs(self) -> None:
        """Begin to move with the next step."""
        super().mission_runs()
        self._answers_awaited.answered(_RUNNING)

    def _may_step(self) -> bool:
        """Return whether the program goes on and the present odometry has its answer."""
        flyer = self._flyer()
        if flyer.finished or flyer.fault or (flyer.run.over and not self._coasts(flyer)):
            return False
        self._gates = self._gates or [_gate(self), _gate(flyer)]
        if any(gate.waiting_for() for gate in self._gates):
            return False
        return self._answers_awaited.complete(time.monotonic())

    def _coasts(self, flyer: ManoeuvresNode) -> bool:
        """Return whether the vehicle still coasts after the program, which its flyer waits for."""
        if self._coasts_from is None:
            self._coasts_from = self.stamp, time.monotonic()
        begun, since = self._coasts_from
        coasts: bool = (self.stamp - begun) * 1e-9 < min(
            ManoeuvresNode.farewell * self.parameters.speed, COASTING
        )
        if flyer.run.over != INTERRUPTED:
            flyer.farewell = time.monotonic() - since + _STALL if coasts else 0.0
        return coasts


def _gate(node: SuiteNode) -> LockstepGate:
    """Return what opens once the recorder and the other node read what this one publishes."""
    reads = {topics.ODOM: topics.MANOEUVRES, **dict.fromkeys(_COMMANDS, topics.PLANT)}
    publishers = {
        topic._replace(subscribers=(reads[topic],) if topic in reads else ()): publisher
        for topic, publisher in node.publishers_by_topic.items()
    }
    return LockstepGate(node, publishers, recorded=True)
