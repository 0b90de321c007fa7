"""From stamps to dt: what is new, what is old, and what is a new beginning. ROS-free."""

from __future__ import annotations

import enum
from typing import NamedTuple


class Verdict(enum.Enum):
    """What to do with a stamped message."""

    ACCEPT = "accept"
    REFUSE = "refuse"
    RESTART = "restart"


class Tick(NamedTuple):
    """The verdict and, for an accepted stamp, the seconds since the last one (0 on the first)."""

    verdict: Verdict
    dt: float


class StampGuard:
    """Judges the stamps of one topic.

    A stamp not newer than the last is refused: a message that was overtaken or sent twice. A second old
    stamp that continues the refused one shows that time itself went back (a reset, a looped bag): start anew.

    Args:
        ordered: lockstep: nothing is ever overtaken, so the first older stamp already means a restart.
    """

    def __init__(self, ordered: bool = False) -> None:
        self.ordered = ordered
        self.refused = 0
        self.reset()

    def reset(self) -> None:
        """The next stamp is a first one."""
        self._last: int | None = None
        self._refused: int | None = None

    def judge(self, stamp: int) -> Tick:
        """Take in a stamp, nanoseconds."""
        if self._last is None:
            self._last = stamp
            return Tick(Verdict.ACCEPT, 0.0)
        if stamp > self._last:
            dt = (stamp - self._last) * 1e-9
            self._last, self._refused = stamp, None
            return Tick(Verdict.ACCEPT, dt)
        continues = self._refused is not None and stamp > self._refused
        if (self.ordered and stamp < self._last) or continues:
            self._last, self._refused = stamp, None
            return Tick(Verdict.RESTART, 0.0)
        self._refused = stamp
        self.refused += 1
        return Tick(Verdict.REFUSE, 0.0)
