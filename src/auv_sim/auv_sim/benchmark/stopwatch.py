"""Reads the clock while a simulator steps."""

from __future__ import annotations

import json
import time

#: What a finished run prints in front of its figures.
MARK = "stopwatch: "
#: Steps before time is taken: caches and processor clocks settle.
WARM_UP = 100
#: Steps between two readings.
BLOCK = 100


class Stopwatch:
    """Reads the clock every `BLOCK` steps and prints one line when all steps are done.

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
        if self.steps > self._wanted:
            self.finished = True
            print(MARK + json.dumps({"steps": self.steps, "block": BLOCK, "readings": self._readings}))
