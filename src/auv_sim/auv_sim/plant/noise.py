"""What a measurement has besides the truth: white noise, a constant offset, a slow drift, gaps, lateness.

Every law draws from a generator of its own, made from a seed: two runs are equal to the last bit, a reset
begins the same run again, and switching one error off leaves all others as they were.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from typing import Generic, TypeVar

import numpy as np

from auv_msgs_py.settings import setting, settings

T = TypeVar("T")

#: The seed of the run, and the place of the law in it.
Seed = Sequence[int]

#: Times are compared with this tolerance, s: they are sums of steps.
_SAME = 1e-9


@settings
class NoiseConfig:
    """Errors of a measured number, in that number's unit. With all at 0 the truth comes through unchanged."""

    white: float = setting(0.0, "standard deviation of each measurement", ge=0.0)
    bias: float = setting(0.0, "standard deviation of a constant offset, drawn once for a run", ge=0.0)
    drift: float = setting(0.0, "standard deviation of a slowly varying offset", ge=0.0)
    drift_time: float = setting(60.0, "time in which the drift forgets itself", unit="s", gt=0.0)


class GaussMarkov:
    """First-order Gauss-Markov process, discretised exactly for any step: Fossen's model of a current.

    V' = -V/T + w, with w such that V has the given standard deviation at all times, the first included.

    Args:
        deviation: standard deviation.
        time: time constant T, s.
        seed: of its generator.
        limit: the value is kept within +- this.
    """

    def __init__(self, deviation: float, time: float, seed: Seed, limit: float = math.inf) -> None:
        self.deviation, self.time, self.limit, self._seed = deviation, time, limit, tuple(seed)
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        self._generator = np.random.default_rng(self._seed)
        self._decay: tuple[float, float, float] = (-1.0, 1.0, 0.0)
        self.value = self._within(self.deviation * float(self._generator.standard_normal()))

    def update(self, dt: float) -> float:
        """The value `dt` seconds later."""
        if self.deviation and dt > 0.0:
            known, keep, fresh = self._decay
            if dt != known:
                keep = math.exp(-dt / self.time)
                fresh = self.deviation * math.sqrt(-math.expm1(-2.0 * dt / self.time))
                self._decay = dt, keep, fresh
            self.value = self._within(keep * self.value + fresh * float(self._generator.standard_normal()))
        return self.value

    def _within(self, value: float) -> float:
        return min(max(value, -self.limit), self.limit)


class Noise:
    """The error of one measured number.

    Args:
        config: how large.
        seed: of its generators.
    """

    def __init__(self, config: NoiseConfig, seed: Seed) -> None:
        self.config, self._seed = config, tuple(seed)
        self._drift = GaussMarkov(config.drift, config.drift_time, (*self._seed, 1))
        self.reset()

    def reset(self) -> None:
        """Begin the same run again: the same offset, the same noise."""
        self._generator = np.random.default_rng((*self._seed, 0))
        self.bias = self.config.bias * float(self._generator.standard_normal())
        self._drift.reset()

    def update(self, dt: float) -> float:
        """The error of the measurement `dt` seconds after the last one."""
        error = self.bias + self._drift.update(dt)
        if self.config.white:
            error += self.config.white * float(self._generator.standard_normal())
        return error


@settings
class DropoutConfig:
    """Gaps that come and go at random; both times are means of exponential distributions."""

    every: float = setting(0.0, "mean time from the end of a gap to the next; 0: no gaps", unit="s", ge=0.0)
    length: float = setting(1.0, "mean length of a gap", unit="s", gt=0.0)


class Dropouts:
    """Whether a sensor is silent.

    Args:
        config: how often and how long.
        seed: of its generator.
    """

    def __init__(self, config: DropoutConfig, seed: Seed) -> None:
        self.config, self._seed = config, tuple(seed)
        self.reset()

    def reset(self) -> None:
        """Begin the same run again, with the sensor speaking."""
        self._generator = np.random.default_rng(self._seed)
        self.silent = False
        self._left = self._lasts()

    def update(self, dt: float) -> bool:
        """Whether it is silent `dt` seconds later."""
        self._left -= dt
        while self._left <= 0.0:
            self.silent = not self.silent
            self._left += self._lasts()
        return self.silent

    def _lasts(self) -> float:
        if not self.config.every:
            return math.inf
        mean = self.config.length if self.silent else self.config.every
        return mean * float(self._generator.standard_exponential())


class Sampler:
    """When a sensor of a given rate measures.

    Args:
        rate: measurements a second; 0 for one at every step.
    """

    def __init__(self, rate: float) -> None:
        self._period = 1.0 / rate if rate else 0.0
        self.reset()

    def reset(self) -> None:
        """The next update is the first measurement."""
        self._until = 0.0

    def update(self, dt: float) -> bool:
        """Whether it measures `dt` seconds later."""
        self._until -= dt
        if self._until > _SAME:
            return False
        # The beat is kept; a step longer than the period is one measurement all the same.
        self._until = max(self._until + self._period, 0.0)
        return True


class Delay(Generic[T]):
    """Hands on what was measured `latency` seconds ago; at the beginning, the oldest there is.

    Args:
        latency: s; rounded up to whole steps.
    """

    def __init__(self, latency: float) -> None:
        self._latency = latency
        self.reset()

    def reset(self) -> None:
        """Forget what is on its way."""
        self._now = 0.0
        self._on_its_way: deque[tuple[float, T]] = deque()

    def update(self, value: T, dt: float) -> T:
        """Take in the value `dt` seconds later, hand out the one that arrives then."""
        self._now += dt
        self._on_its_way.append((self._now, value))
        while len(self._on_its_way) > 1 and self._on_its_way[1][0] <= self._now - self._latency + _SAME:
            self._on_its_way.popleft()
        return self._on_its_way[0][1]
