"""The simulator's side of a fleet in lockstep: report its time, and wait when it is too far ahead."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.conversions import set_stamp, stamp_of
from auv_msgs_py.contract.wire import Clock


class FleetMember:
    """Keeps one vehicle within `FLEET_LEAD_NS` of the fleet's /clock.

    Args:
        node: the simulator.
        proceed: called when /clock has moved.
    """

    def __init__(self, node: Any, proceed: Callable[[], None]) -> None:
        self._proceed = proceed
        self._message = Clock()
        self._publisher = node.advertise(topics.VEHICLE_PROGRESS)
        self._reported = 0
        self._clock = topics.FIRST_STAMP_NS
        node.listen(topics.CLOCK, self._on_clock)

    def may_take(self, step_ns: int, stamp: int) -> bool:
        """Return whether the next step, `step_ns` later, may be taken; report that `stamp` was answered."""
        if stamp - self._reported >= topics.FLEET_REPORT_NS:
            self._reported = stamp
            self.repeat()
        return stamp + step_ns - self._clock <= topics.FLEET_LEAD_NS

    def repeat(self) -> None:
        """Repeat the last report, for a reader that has missed it."""
        if self._reported:
            set_stamp(self._message.clock, self._reported)
            self._publisher.publish(self._message)

    def _on_clock(self, message: Any) -> None:
        self._clock = stamp_of(message.clock, topics.CLOCK.name)
        self._proceed()
