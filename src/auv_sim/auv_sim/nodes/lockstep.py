"""The simulator's side of lockstep: no step without an answer, no answer without a step.

Why it cannot go wrong is written down in `auv_msgs_py.contract.pairing`.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from diagnostic_msgs.msg import DiagnosticArray
from rclpy.clock import Clock, ClockType
from std_msgs.msg import UInt64

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.node.health import Health
from auv_msgs_py.node.lockstep_gate import LockstepGate
from auv_msgs_py.values.types import Command

if TYPE_CHECKING:
    from auv_sim.nodes.plant_node import RemusPlantNode

_BY_NAME = {topic.name: topic for topic in (*topics.CONTRACT, topics.RECORDED_STEPS)}


class Lockstep:
    """Takes the next step when both commands for the present one are there and the mission is running.

    Args:
        node: the simulator.
    """

    def __init__(self, node: RemusPlantNode) -> None:
        self._node = node
        self._pairing = Pairing((topics.RUDDER_CMD.name, topics.THRUST_CMD.name), strict=True)
        self._open_since: float | None = None
        self._left_running = False
        self._awaits_state = False
        #: Whether the newest command has thrust.
        self._under_thrust = False
        self._begun = False
        self._command: Command | None = None
        self._recorded, self._recorded_at = 0, time.monotonic()
        self._published = 0
        self._waits: dict[str, tuple[float, str]] = {}
        self._refused: dict[str, str] = {}
        node.listen(topics.DIAGNOSTICS, self._on_diagnostics)
        self._request = node.advertise(topics.RECORD_REQUEST) if node.parameters.recorded else None
        if node.parameters.recorded:
            node.listen(topics.RECORDED_STEPS, self._on_recorded)
        node.create_timer(0.2, self._check, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def waiting_for(self) -> str:
        """The commands that the present step lacks."""
        return "" if self._open_since is None else ", ".join(self._missing())

    def _missing(self) -> tuple[str, ...]:
        return self._pairing.missing or self._pairing.topics

    def on_command(self, topic: str, value: float) -> None:
        """A valid command came."""
        if not self._pairing.put(topic, value):
            return
        self._command = Command(*self._pairing.take())
        self._open_since = None
        # With thrust the mission ran at this step, whatever else was said meanwhile (by another publisher, or
        # by an abort that the next step will show). Without thrust it did not run. Its state travels on
        # another topic and may be late: wait for it, or the number of steps would depend on the race.
        self._under_thrust = self._command.thrust > 0.0
        if self._under_thrust:
            self._left_running = False
        self._awaits_state = not (self._under_thrust or self._left_running)
        self._proceed()

    def on_mission_state(self) -> None:
        """The mission's state changed."""
        if not self._node.mission_running:
            self._left_running = True
            self._awaits_state = False
        self._proceed()

    def _on_recorded(self, message: UInt64) -> None:
        self._recorded, self._recorded_at = int(message.data), time.monotonic()
        self._proceed()

    def _proceed(self) -> None:
        if self._open_since is not None or self._awaits_state:
            return
        if not (self._under_thrust or self._node.mission_running):
            return
        if self._node.parameters.recorded and self._published - self._recorded >= topics.RECORDING_LEAD:
            return
        if self._begun:
            assert self._command is not None
            self._node.advance(self._command)
        self._begun = True
        self._left_running = False
        self._published += 1
        if self._published - self._recorded == topics.RECORDING_LEAD:
            self._recorded_at = time.monotonic()
        self._open_since = time.monotonic()
        self._node.publish_step()
        if self._request is not None and self._published % topics.RECORDING_REQUEST == 0:
            self._request.publish(UInt64(data=self._published))

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for status in message.status:
            for pair in status.values:
                if pair.key == "waiting_for":
                    self._waits[status.hardware_id] = time.monotonic(), pair.value
                elif pair.key == Health.REFUSED:
                    self._refused[status.hardware_id] = pair.value

    def _check(self) -> None:
        """End the run, with the culprit's name, when a step stays without an answer."""
        if self._node.fault:
            return
        if self._open_since is None:
            self._check_recorder()
            return
        if self._node.gate_waits_for():
            self._open_since = time.monotonic()
            return
        bound = self._node.parameters.answer_timeout
        if time.monotonic() - self._open_since > bound:
            self._node.fail(f"{self._where()} got no answer within {bound:g} s: {self._culprit()}")

    def _check_recorder(self) -> None:
        under_way = self._under_thrust or self._node.mission_running
        waits = self._published - self._recorded >= topics.RECORDING_LEAD and under_way
        if not (self._node.parameters.recorded and waits):
            return
        bound = self._node.parameters.answer_timeout
        if time.monotonic() - self._recorded_at > bound:
            self._node.fail(
                f"{self._where()} was not recorded within {bound:g} s:"
                f" {topics.RECORDER} did not send {topics.RECORDED_STEPS.name}"
            )

    def _where(self) -> str:
        return f"step {self._node.steps} (t = {self._node.stamp * 1e-9:.2f} s)"

    def _culprit(self) -> str:
        """Follow which node waits for which topic.

        The first that reports nothing, or waits for nothing, is the culprit; on the way there, a message that
        the waiting node has refused.
        """
        topic = _BY_NAME[self._missing()[0]]
        if refusal := self._refusal(topics.PLANT, ", ".join(self._missing())):
            return refusal
        for _ in topics.CONTRACT:
            at, waits = self._waits.get(topic.publisher, (0.0, ""))
            if refusal := self._refusal(topic.publisher, waits):
                return refusal
            reported = self._open_since is not None and at > self._open_since
            following = _BY_NAME.get(waits.split(",")[0]) if reported else None
            if following is None or following.publisher == topics.PLANT:
                if reported and LockstepGate.lacks_reader(waits):
                    return f"{topic.publisher} waits for {waits}"
                break
            topic = following
        return f"{topic.publisher} did not send {topic.name}"

    def _refusal(self, node: str, waits: str) -> str:
        """What a node has refused of the topics that it waits for, with the value; else an empty text."""
        refused = self._refused.get(node, "")
        is_awaited = refused.partition(":")[0] in waits.split(", ")
        return f"{node} refused {refused}" if refused and is_awaited else ""
