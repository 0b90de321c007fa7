"""What a simulator under measurement notes while it steps, and how it tells it: one line of JSON."""

from __future__ import annotations

import json
import time
from collections import deque
from typing import Any

#: What stands in front of a finished run's figures.
MARK = "stopwatch: "
#: Steps before time is taken: caches and processor clocks settle.
WARM_UP = 100
#: Steps between two readings.
BLOCK = 100


def tell(figures: dict[str, Any]) -> None:
    """Print the figures for whoever started this process."""
    print(MARK + json.dumps(figures), flush=True)


class Stopwatch:
    """Lockstep: reads the clock every `BLOCK` steps and tells it when all steps are done.

    Args:
        wanted: steps to time, after those for warming up.
    """

    def __init__(self, wanted: int) -> None:
        self.steps = 0
        self.finished = False
        self._wanted = WARM_UP + wanted
        self._readings: list[float] = []

    def step(self) -> None:
        """A step begins."""
        if self.steps >= WARM_UP and (self.steps - WARM_UP) % BLOCK == 0:
            self._readings.append(time.perf_counter())
        self.steps += 1
        if self.steps > self._wanted and not self.finished:
            self.finished = True
            tell({"steps": self.steps, "readings": self._readings})


class LatencyWatch:
    """Free running: how long each odometry waits for its rudder command.

    The autopilot answers every odometry exactly once, so an answer belongs to the oldest one without.

    Args:
        wanted: odometries to watch, after those for warming up.
    """

    #: So many odometries without an answer, and the answers are lost rather than late.
    LOST = 4

    def __init__(self, wanted: int) -> None:
        self.finished = False
        self._left = WARM_UP + wanted
        self._wanted = wanted
        self._open: deque[float] = deque()
        self._sent: list[float] = []
        self._latencies: list[float] = []
        self._missed = 0

    def sent(self) -> None:
        """An odometry goes out."""
        now = time.perf_counter()
        if self._open:
            self._missed += 1
            if len(self._open) >= self.LOST:
                self._open.clear()
        self._open.append(now)
        self._sent.append(now)
        self._left -= 1
        if self._left == self._wanted:
            self._missed, self._latencies, self._sent = 0, [], [now]
        if self._left < 0 and not self.finished:
            self.finished = True
            tell({"latencies": self._latencies, "sent": self._sent, "missed": self._missed})

    def answered(self) -> None:
        """A rudder command has come."""
        if self._open:
            self._latencies.append(time.perf_counter() - self._open.popleft())
