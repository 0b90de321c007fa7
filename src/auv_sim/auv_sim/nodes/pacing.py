"""Steps at the pace of the wall clock. ROS-free."""

from __future__ import annotations

#: Steps of lag that are caught up; time lost beyond them stays lost.
PATIENCE = 4


class Pacer:
    """Keeps steps at a fixed period of wall time; a late timer is caught up, and no step is left out.

    At most one step is due at each poll. Polled twice a period, the pace can double, and steps caught up
    never come in a burst without commands in between. A machine that cannot keep the pace slows time down.

    Args:
        period: wall time of a step, s.
    """

    def __init__(self, period: float) -> None:
        self.period = period
        #: Wall time lost for good, s.
        self.behind = 0.0
        self._next: float | None = None

    @property
    def ask_every(self) -> float:
        """Period of polling, s."""
        return 0.5 * self.period

    def restart(self, now: float) -> None:
        """Count from now (s, monotonic)."""
        self._next = now

    def due(self, now: float) -> bool:
        """Return whether a step is due now (s, monotonic)."""
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
