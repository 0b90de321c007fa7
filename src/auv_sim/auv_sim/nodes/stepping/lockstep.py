"""The simulator's side of lockstep: no step without an answer, no answer without a step.

`auv_msgs_py.contract.pairing` has the proof.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, Protocol

from rclpy.clock import Clock, ClockType

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.pairing import Pairing
from auv_msgs_py.contract.topics import Topic
from auv_sim.nodes.fleet.member import FleetMember
from auv_sim.nodes.held_commands import Orders
from auv_sim.nodes.stepping.recording_lead import RecordingLead
from auv_sim.nodes.stepping.wait_reports import WaitReports


class Simulator(Protocol):
    """The part of the simulator's node that lockstep uses."""

    parameters: Any
    mission_running: bool
    steps: int
    step_ns: int
    fault: str

    @property
    def stamp(self) -> int: ...
    def listen(self, topic: Topic, callback: Callable[[Any], None], raw: bool = False) -> None: ...
    def advertise(self, topic: Topic) -> Any: ...
    def create_timer(self, period: float, callback: Callable[[], None], *, clock: Any) -> Any: ...
    def get_namespace(self) -> str: ...
    def gate_waits_for(self) -> str: ...
    def advance(self, command: Any) -> None: ...
    def publish_step(self) -> None: ...
    def fail(self, text: str) -> None: ...


class Lockstep:
    """Takes the next step once all commands for the present one have arrived and the mission runs.

    Args:
        node: the simulator.
        orders: the commands that end a step.
    """

    def __init__(self, node: Simulator, orders: Orders) -> None:
        self._node = node
        self._orders = orders
        self._pairing = Pairing(tuple(orders.limits), strict=True)
        self._open_since: float | None = None
        self._left_running = False
        self._awaits_state = False
        #: Whether the newest command has thrust.
        self._under_thrust = False
        self._begun = False
        self._command: Any = None
        self._reports = WaitReports(node.get_namespace() if node.parameters.shared_clock else "")
        node.listen(topics.DIAGNOSTICS, self._reports.hear, raw=True)
        self._recording = RecordingLead(node, orders, self._proceed) if node.parameters.recorded else None
        self._fleet = FleetMember(node, self._proceed) if node.parameters.shared_clock else None
        node.create_timer(0.2, self._check, clock=Clock(clock_type=ClockType.STEADY_TIME))

    def waiting_for(self) -> str:
        """Return the commands that the present step lacks."""
        return "" if self._open_since is None else ", ".join(self._missing())

    def _missing(self) -> tuple[str, ...]:
        return self._pairing.missing or self._pairing.topics

    def on_command(self, topic: str, value: float) -> None:
        """Process a valid command."""
        if not self._pairing.put(topic, value):
            return
        self._command = type(self._orders.stop)(*self._pairing.take())
        self._open_since = None
        # With thrust the mission ran at this step, whatever state arrived meanwhile (of another publisher,
        # or of an abort that the next step will show). Without thrust it did not run. Its state travels on
        # another topic and may be late: wait for it, or the number of steps would depend on the race.
        self._under_thrust = self._command.thrust > 0.0
        if self._under_thrust:
            self._left_running = False
        self._awaits_state = not (self._under_thrust or self._left_running)
        self._proceed()

    def on_mission_state(self) -> None:
        """Process a mission state."""
        if not self._node.mission_running:
            self._left_running = True
            self._awaits_state = False
        self._proceed()

    def _proceed(self) -> None:
        if self._open_since is not None or self._awaits_state:
            return
        if not (self._under_thrust or self._node.mission_running):
            return
        if self._recording is not None and self._recording.used_up:
            return
        node = self._node
        if self._begun and self._fleet is not None and not self._fleet.may_take(node.step_ns, node.stamp):
            return
        if self._begun:
            assert self._command is not None
            self._node.advance(self._command)
        self._begun = True
        self._left_running = False
        if self._recording is not None:
            self._recording.count()
        self._open_since = time.monotonic()
        self._node.publish_step()
        if self._recording is not None:
            self._recording.ask()

    def _check(self) -> None:
        """End the run, naming the culprit, when a step stays without an answer."""
        if self._node.fault:
            return
        if self._fleet is not None:
            self._fleet.repeat()
        if self._open_since is None:
            self._check_recorder()
            return
        if self._node.gate_waits_for():
            self._open_since = time.monotonic()
            return
        bound = self._node.parameters.answer_timeout
        if time.monotonic() - self._open_since > bound:
            culprit = self._reports.culprit(self._missing(), self._open_since)
            self._node.fail(f"{self._where()} got no answer within {bound:g} s: {culprit}")

    def _check_recorder(self) -> None:
        if self._recording is None or not (self._under_thrust or self._node.mission_running):
            return
        bound = self._node.parameters.answer_timeout
        if self._recording.used_up and self._recording.silence > bound:
            self._node.fail(
                f"{self._where()} was not recorded within {bound:g} s:"
                f" {topics.RECORDER} did not send {topics.RECORDED_STEPS.name}"
            )

    def _where(self) -> str:
        return f"step {self._node.steps} (t = {self._node.stamp * 1e-9:.2f} s)"
