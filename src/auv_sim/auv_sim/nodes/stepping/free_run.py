"""The simulator's free run: steps by the wall clock, or by the fleet's /clock, with the newest commands."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

from rclpy import clock as ros_clock

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import stamp_of
from auv_msgs_py.contract.wire import Clock
from auv_sim.nodes.pacing import PATIENCE, Pacer


class FreeRun:
    """Takes the steps that are due; until a mission runs, the vehicle is held at its initial state.

    Args:
        node: the simulator.

    Attributes:
        pacer: of the wall clock; None where the fleet's /clock sets the pace.
        at_rest: whether the run has not begun: time passes, and the vehicle stays where it is.
        may_step: returns whether a step by the wall clock is taken when it is due.
    """

    def __init__(self, node: Any) -> None:
        p = node.parameters
        self._node = node
        self._begun = False
        self.at_rest = bool(p.hold_until_running)
        self.may_step: Callable[[], bool] = lambda: True
        self.pacer = None if p.shared_clock else Pacer(p.step / p.speed)
        if self.pacer is None:
            node.listen(topics.CLOCK, self._on_clock)
        else:
            steady = ros_clock.Clock(clock_type=ros_clock.ClockType.STEADY_TIME)
            node.create_timer(self.pacer.ask_every, self._tick, clock=steady)

    @property
    def _silent(self) -> bool:
        """Whether nothing is published before the mission, and the vehicle waits for it."""
        return self.at_rest and not self._node.parameters.publish_at_rest

    def _tick(self) -> None:
        """Take the next step when the wall clock demands it."""
        assert self.pacer is not None
        if self._silent:
            self.pacer.restart(time.monotonic())
        elif self.may_step() and self.pacer.due(time.monotonic()):
            self._take_step()

    def _on_clock(self, message: Clock) -> None:
        """Take the steps that are due by the fleet's /clock; time that a slow machine loses is caught up."""
        node, now = self._node, stamp_of(message.clock, topics.CLOCK.name)
        if self._silent:
            node.steps = max(0, now - topics.FIRST_STAMP_NS) // node.step_ns
            return
        for _ in range(PATIENCE):
            if self._begun and node.stamp + node.step_ns > now:
                break
            self._take_step()

    def _take_step(self) -> None:
        node = self._node
        node.command = node.held_command()
        if self._begun and self.at_rest and not node.reset_requested:
            node.steps += 1
        elif self._begun:
            node.advance(node.command)
        self._begun = True
        node.publish_step()
