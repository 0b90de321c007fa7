"""The time of /clock for several vehicles in lockstep. ROS-free."""

from __future__ import annotations

from collections.abc import Iterable

from auv_msgs_py.contract import topics
from auv_msgs_py.contract.mission_word import MissionState

#: States before a vehicle's mission; empty: none heard yet.
_BEFORE = ("", MissionState.IDLE)


class FleetTime:
    """The latest time that every vehicle under way has reached.

    A vehicle that holds, or whose mission is over, takes no steps in lockstep, so the others do not wait for
    it. One that has not begun stops the time, so that all begin together.

    Args:
        vehicles: their names.
    """

    def __init__(self, vehicles: Iterable[str]) -> None:
        self._reached = dict.fromkeys(vehicles, topics.FIRST_STAMP_NS)
        self._states = dict.fromkeys(self._reached, "")
        #: Time, ns; it never goes back.
        self.now = topics.FIRST_STAMP_NS

    @property
    def has_begun(self) -> bool:
        """Whether every vehicle has begun its mission."""
        return all(state not in _BEFORE for state in self._states.values())

    def reach(self, vehicle: str, stamp: int) -> None:
        """Note the time up to which a vehicle's steps are answered, ns."""
        self._reached[vehicle] = stamp

    def enter(self, vehicle: str, state: str) -> None:
        """Note the state of a vehicle's mission; a mission that has begun stays begun."""
        if state not in _BEFORE or self._states[vehicle] in _BEFORE:
            self._states[vehicle] = state

    def advance(self) -> bool:
        """Move the time as far as the vehicles under way allow; return whether it has moved."""
        awaited = (*_BEFORE, MissionState.RUNNING)
        under_way = [self._reached[name] for name, state in self._states.items() if state in awaited]
        before, self.now = self.now, max(self.now, min(under_way, default=self.now))
        return self.now > before
