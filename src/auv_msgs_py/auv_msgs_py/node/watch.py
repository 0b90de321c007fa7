"""What a node notices about its surroundings without looking into a message. ROS-free."""

from __future__ import annotations

from collections import Counter


class RateWatch:
    """Finds topics on which far more comes than any vehicle sends.

    Args:
        highest: rate that is still believed, Hz of ROS time.
    """

    #: Rates are taken over at least so much time, s.
    window = 0.2

    def __init__(self, highest: float) -> None:
        self.highest = highest
        self.counts: Counter[str] = Counter()
        self._at: float | None = None
        self._told = ""

    def floods(self, now: float) -> dict[str, float] | None:
        """The rates (Hz) that are too high, by topic; None while too little time has passed to say."""
        if self._at is not None and 0.0 <= now - self._at < self.window:
            return None
        before, self._at = self._at, now
        counts, self.counts = self.counts, Counter()
        if before is None or now < before:
            return {}
        rates = {topic: count / (now - before) for topic, count in counts.items()}
        return {topic: rate for topic, rate in rates.items() if rate > self.highest}

    def told(self, now: float) -> str:
        """The same for people; empty when nothing floods."""
        rates = self.floods(now)
        if rates is not None:
            text = ", ".join(f"{name} comes at {rate:.0f} Hz" for name, rate in rates.items())
            self._told = f"{text}: more than {self.highest:g} Hz" if text else ""
        return self._told


class ClockWatch:
    """Finds that simulated time stands still, by a clock that does not.

    Args:
        bound: standing still for longer than this is told, s.
    """

    def __init__(self, bound: float = 2.0) -> None:
        self.bound = bound
        self._now = 0.0
        self._since: float | None = None

    def stands_still(self, now: float, steady: float) -> bool:
        """Take in ROS time and steady time, s; a clock that was never set does not stand still."""
        if now != self._now or self._since is None:
            self._now, self._since = now, steady
        return self._now > 0.0 and steady - self._since > self.bound
