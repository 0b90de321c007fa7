"""What a simulator under measurement notes while it steps, and reports as one line of JSON."""

from __future__ import annotations

import json
import time
from collections import deque
from typing import Any

#: Begins the line with a finished run's figures.
MARK = "stopwatch: "
#: Steps before time is taken: caches and processor clocks settle.
WARM_UP = 100
#: Steps between two readings.
BLOCK = 100


def report(figures: dict[str, Any]) -> None:
    """Print the figures for the parent process."""
    print(MARK + json.dumps(figures), flush=True)


class Stopwatch:
    """Lockstep: reads the clock every `BLOCK` steps and reports when all steps are done.

    Args:
        count: steps to time, after those for warming up.
    """

    def __init__(self, count: int) -> None:
        self.steps = 0
        self.finished = False
        self._last = WARM_UP + count
        self._readings: list[float] = []

    def step(self) -> None:
        """Note that a step begins."""
        if self.steps >= WARM_UP and (self.steps - WARM_UP) % BLOCK == 0:
            self._readings.append(time.perf_counter())
        self.steps += 1
        if self.steps > self._last and not self.finished:
            self.finished = True
            report({"steps": self.steps, "readings": self._readings})


class LatencyWatch:
    """Free running: measures how long each odometry waits for its rudder command.

    The autopilot answers every odometry exactly once, so an answer belongs to the oldest one without.

    Args:
        count: odometries to watch, after those for warming up.
    """

    #: Odometries without an answer from which on the answers count as lost, not late.
    LOST = 4

    def __init__(self, count: int) -> None:
        self.finished = False
        self._left = WARM_UP + count
        self._count = count
        self._open: deque[float] = deque()
        self._sent: list[float] = []
        self._latencies: list[float] = []
        self._missed = 0

    def sent(self) -> None:
        """Note that an odometry goes out."""
        now = time.perf_counter()
        if self._open:
            self._missed += 1
            if len(self._open) >= self.LOST:
                self._open.clear()
        self._open.append(now)
        self._sent.append(now)
        self._left -= 1
        if self._left == self._count:
            self._missed, self._latencies, self._sent = 0, [], [now]
        if self._left < 0 and not self.finished:
            self.finished = True
            report({"latencies": self._latencies, "sent": self._sent, "missed": self._missed})

    def answered(self) -> None:
        """Note that a rudder command has come."""
        if self._open:
            self._latencies.append(time.perf_counter() - self._open.popleft())
