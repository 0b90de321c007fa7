"""Decide whether the newest reference may still be followed. No ROS, no clock of its own."""

from __future__ import annotations

from auv_msgs_py.contract.mission_word import MissionState
from auv_msgs_py.values.types import Reference, SpatialReference

AnyReference = Reference | SpatialReference


class ReferenceWatch:
    """Keep the newest reference; find guidance that is silent or contradicts the state of its mission."""

    def __init__(self) -> None:
        self.newest: AnyReference | None = None
        self._at = 0.0
        self._contradicted: float | None = None
        #: Whether `allowed` found no new reference within the timeout.
        self.silent = False
        #: Contradiction that `allowed` found: a desired thrust without a running mission; else empty.
        self.contradiction = ""

    def put(self, reference: AnyReference, now: float) -> None:
        """Keep a reference that came at `now`, s."""
        self.newest, self._at = reference, now

    def allowed(self, now: float, mission: str, timeout: float) -> AnyReference | None:
        """Return the newest reference if it may be followed, else None.

        Args:
            now: s.
            mission: the latest state of the mission; empty before the first message.
            timeout: longest age of a reference, and longest contradiction to the mission's state, s.
        """
        reference = self.newest
        if reference is None:
            return None
        # After the clock went back, a reference from its future counts as old.
        self.silent = abs(now - self._at) > timeout
        if self.silent or not self._agrees(reference.thrust, now, mission, timeout):
            return None
        return reference

    def _agrees(self, thrust: float, now: float, mission: str, timeout: float) -> bool:
        """Return whether thrust and state agree; on two topics, a short contradiction is normal."""
        if not thrust > 0.0 or mission in ("", MissionState.RUNNING):
            self._contradicted, self.contradiction = None, ""
            return True
        if self._contradicted is None:
            self._contradicted = now
        if abs(now - self._contradicted) > timeout:
            self.contradiction = f"is {thrust:g} though the mission is {mission}"
        return not self.contradiction
