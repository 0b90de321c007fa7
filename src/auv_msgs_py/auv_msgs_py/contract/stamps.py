"""From stamps to dt: accept new stamps, refuse old ones, find restarts. ROS-free."""

from __future__ import annotations

import enum
from typing import NamedTuple


class StampVerdict(enum.Enum):
    """What to do with a stamped message."""

    ACCEPT = "accept"
    REFUSE = "refuse"
    RESTART = "restart"


class Tick(NamedTuple):
    """Verdict and, for an accepted stamp, the time since the last one, s (0 for the first)."""

    verdict: StampVerdict
    dt: float


class StampGuard:
    """Judge the stamps of one topic.

    A stamp that is not newer than the last is refused: its message was overtaken or sent twice. A second old
    stamp that continues the refused one shows that time went back (a reset, a looped bag): a restart.

    Args:
        ordered: in lockstep no message is overtaken, so the first older stamp means a restart.
    """

    def __init__(self, ordered: bool = False) -> None:
        self.ordered = ordered
        self.refused = 0
        self.reset()

    def reset(self) -> None:
        """Forget all stamps; the next one is the first."""
        self._last: int | None = None
        self._refused: int | None = None

    def is_old(self, stamp: int) -> bool:
        """Return whether a stamp is not newer than the last accepted one."""
        return self._last is not None and stamp <= self._last

    def judge(self, stamp: int) -> Tick:
        """Judge a stamp, ns."""
        if self._last is None:
            self._last = stamp
            return Tick(StampVerdict.ACCEPT, 0.0)
        if stamp > self._last:
            dt = (stamp - self._last) * 1e-9
            self._last, self._refused = stamp, None
            return Tick(StampVerdict.ACCEPT, dt)
        continues = self._refused is not None and stamp > self._refused
        if (self.ordered and stamp < self._last) or continues:
            self._last, self._refused = stamp, None
            return Tick(StampVerdict.RESTART, 0.0)
        self._refused = stamp
        self.refused += 1
        return Tick(StampVerdict.REFUSE, 0.0)


class StampTiming(enum.Enum):
    """Age of a stamp compared with that of earlier messages."""

    PUNCTUAL = "punctual"
    LATE = "late"
    EARLY = "early"
    STEPPED = "stepped"


class Punctuality:
    """Compare stamps with the receiver's clock, which may differ from the sender's by a constant.

    The age of the most punctual message so far is the measure of all others. So a vehicle with a wrong clock
    can be flown, and messages that begin to come late are found. A single stamp from the future is refused; a
    later one that has advanced with the receiver's clock shows that the sender's clock was set forward, and
    is the new measure. While the receiver's clock stands still, after a pause, none does.

    Args:
        bound: largest deviation from the measure, later or earlier, s.
        forget: largest rise of the measure, s per s: two clocks never run equally fast.
    """

    def __init__(self, bound: float, forget: float = 1e-3) -> None:
        self.bound = bound
        self.forget = forget
        self.reset()

    def reset(self) -> None:
        """Forget the measure; the next stamp sets it."""
        self._measure: float | None = None
        self._at = 0.0
        #: Of the first stamp of a new time ahead: time of its receipt, s, and the stamp, ns.
        self._early: tuple[float, int] | None = None

    def judge(self, now: float, stamp: int) -> StampTiming:
        """Judge a stamp (ns) received at `now` (s); a clock that shows 0 is not set yet."""
        if now <= 0.0:
            return StampTiming.PUNCTUAL
        age = now - stamp * 1e-9
        if self._measure is None or now < self._at:  # the first one, or the receiver's clock went back
            self._measure, self._at, self._early = age, now, None
            return StampTiming.PUNCTUAL
        lateness = age - self._measure
        if lateness > self.bound:
            return StampTiming.LATE
        if lateness < -self.bound:
            received, first = self._early or (now, stamp)
            passed, advance = now - received, 1e-9 * (stamp - first)
            if not 0.0 < advance <= passed + self.bound:  # the first one, set back, or forward once more
                self._early = now, stamp
                return StampTiming.EARLY
            if passed < 0.5 * advance:
                return StampTiming.EARLY
            self._measure, self._at, self._early = age, now, None
            return StampTiming.STEPPED
        self._measure = min(age, self._measure + self.forget * (now - self._at))
        self._at, self._early = now, None
        return StampTiming.PUNCTUAL
