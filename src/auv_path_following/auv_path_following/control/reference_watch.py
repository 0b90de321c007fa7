"""Whether what guidance asked for last may still be obeyed. No ROS, no clock of its own."""

from __future__ import annotations

from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.values.types import Reference


class ReferenceWatch:
    """Keeps the newest reference, and finds guidance silent or at odds with the state of its mission."""

    def __init__(self) -> None:
        self.newest: Reference | None = None
        self._at = 0.0
        self._contradicted: float | None = None
        #: What `allowed` found last: no new reference for too long.
        self.silent = False
        #: And: thrust is desired, though the mission has not been running for a while.
        self.contradiction = ""

    def put(self, reference: Reference, now: float) -> None:
        """Take in a reference that came at `now`, s."""
        self.newest, self._at = reference, now

    def allowed(self, now: float, mission: str, timeout: float) -> Reference | None:
        """The newest reference, if it may be obeyed.

        Args:
            now: s.
            mission: the mission's state as it was told last; empty when it never was.
            timeout: how long a reference holds, and how long it may contradict the mission's state, s.
        """
        reference = self.newest
        if reference is None:
            return None
        # A clock that went back is no reason to trust what came in its future.
        self.silent = abs(now - self._at) > timeout
        if self.silent or not self._agrees(reference.thrust, now, mission, timeout):
            return None
        return reference

    def _agrees(self, thrust: float, now: float, mission: str, timeout: float) -> bool:
        """The two come on different topics, so a short contradiction is nothing."""
        if not thrust > 0.0 or mission in ("", MissionState.RUNNING):
            self._contradicted, self.contradiction = None, ""
            return True
        if self._contradicted is None:
            self._contradicted = now
        if abs(now - self._contradicted) > timeout:
            self.contradiction = f"is {thrust:g} though the mission is {mission}"
        return not self.contradiction
