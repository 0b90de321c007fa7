"""When the wall clock asks for a step. ROS-free."""

from __future__ import annotations

#: How many steps of lag are caught up; time that is lost beyond them stays lost.
PATIENCE = 4


class Pacer:
    """Keeps steps at a fixed period of wall time; a late timer is caught up, no step is left out.

    One step at a time is due, and asked twice a period the pace can double. What is caught up is no burst
    of steps without a command in between. When the machine cannot keep the pace, time goes slower than asked.

    Args:
        period: wall time of a step, s.
    """

    def __init__(self, period: float) -> None:
        self.period = period
        #: Wall time by which the steps lag behind what was asked for, for good, s.
        self.behind = 0.0
        self._next: float | None = None

    @property
    def ask_every(self) -> float:
        """How often to ask, s."""
        return 0.5 * self.period

    def restart(self, now: float) -> None:
        """Count from now (s, monotonic)."""
        self._next = now

    def due(self, now: float) -> bool:
        """Whether a step is to be taken now (s, monotonic)."""
        if self._next is None:
            self._next = now
        lag = now - self._next
        if lag < 0.0:
            return False
        beyond = lag - PATIENCE * self.period
        if beyond > 0.0:
            self.behind += beyond
            self._next += beyond
        self._next += self.period
        return True
