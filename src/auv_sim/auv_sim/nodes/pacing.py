"""How many steps the wall clock asks for. ROS-free."""

from __future__ import annotations


class Pacer:
    """Keeps steps at a fixed period of wall time; a late timer is caught up, no step is left out.

    When the machine cannot keep the pace, time goes slower than asked instead of piling up.

    Args:
        period: wall time of a step, s.
        patience: largest lag that is caught up, s.
    """

    def __init__(self, period: float, patience: float = 0.2) -> None:
        self.period = period
        self.patience = patience
        self.behind = 0.0
        self._next: float | None = None

    def restart(self, now: float) -> None:
        """Count from now (s, monotonic)."""
        self._next = now

    def due(self, now: float) -> int:
        """Steps to take now (s, monotonic)."""
        if self._next is None:
            self._next = now
        if now < self._next:
            return 0
        lag = now - self._next
        if lag > self.patience:
            self.behind += lag - self.patience
            self._next = now - self.patience
            lag = self.patience
        steps = int(lag / self.period) + 1
        self._next += steps * self.period
        return steps
