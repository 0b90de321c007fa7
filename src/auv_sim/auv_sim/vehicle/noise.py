"""Errors of a measurement: white noise, a constant offset, a slow drift, gaps, delay."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import DrawnRow, Draws, Ring, RunMemory, Seed, draw, slot

#: Times are compared with this tolerance, s: they are sums of steps.
SAME = 1e-9


@settings
class NoiseConfig:
    """Errors of a measured number, in its unit; with all at 0 the truth is unchanged."""

    white: float = setting(0.0, "standard deviation of each measurement", ge=0.0)
    bias: float = setting(0.0, "standard deviation of a constant offset, drawn once for a run", ge=0.0)
    drift: float = setting(0.0, "standard deviation of a slowly varying offset", ge=0.0)
    drift_time: float = setting(60.0, "time constant of the drift", unit="s", gt=0.0)


@settings
class DropoutConfig:
    """Random gaps; both times are means of exponential distributions."""

    every: float = setting(0.0, "mean time from the end of a gap to the next; 0: no gaps", unit="s", ge=0.0)
    length: float = setting(1.0, "mean length of a gap", unit="s", gt=0.0)


class GaussMarkov(NamedTuple):
    """Configuration of a first-order Gauss-Markov process, Fossen's model of a current.

    Attributes:
        deviation: standard deviation.
        time: time constant T, s.
        limit: the value is kept within +- this.
        step, keep, fresh: the discrete process for the usual step (s): the share of its value that it keeps,
            and the standard deviation of its increment.
        row: normal numbers.
    """

    deviation: float
    time: float
    limit: float
    step: float
    keep: float
    fresh: float
    row: DrawnRow


def gauss_markov_of(
    deviation: float, time: float, seed: Seed, draws: Draws, limit: float = math.inf, rate: float = 0.0
) -> tuple[GaussMarkov, float]:
    """Return the configuration of a process and its first value.

    Args:
        deviation, time, limit: as in `GaussMarkov`.
        seed: of its generator.
        draws: of the run.
        rate: of its evaluation, 1/s; 0: at every step.
    """
    generator = draws.generator(seed)
    first = deviation * float(generator.standard_normal())
    row = draws.normals(generator, rate) if deviation else draws.none()
    step = draws.step
    config = GaussMarkov(deviation, time, limit, step, *discrete(deviation, time, step), row)
    return config, min(max(first, -limit), limit)


@pure
def discrete(deviation: float, time: float, dt: float) -> tuple[float, float]:
    """Return the share of its value that a process keeps over `dt` seconds, and the deviation of the rest."""
    return math.exp(-dt / time), deviation * math.sqrt(-math.expm1(-2.0 * dt / time))


@pure
def gauss_markov(config: GaussMarkov, value: float, memory: RunMemory, dt: float) -> float:
    """Return the value `dt` seconds later: V' = -V/T + w, discretised exactly."""
    deviation, time, limit, step, keep, fresh, row = config
    if not (deviation > 0.0 and dt > 0.0):
        return value
    if dt != step:
        keep, fresh = discrete(deviation, time, dt)
    return min(max(keep * value + fresh * draw(memory, row), -limit), limit)


class Noise(NamedTuple):
    """Configuration of the error of one measured number in one run: its offset, white noise and drift."""

    bias: float
    white: float
    row: DrawnRow
    drift: GaussMarkov


def noise_of(config: NoiseConfig, seed: Seed, draws: Draws, rate: float = 0.0) -> tuple[Noise, float]:
    """Return the configuration of an error and the first value of its drift.

    Args:
        config: its size.
        seed: of its generators.
        draws: of the run.
        rate: measurements a second; 0: at every step.
    """
    generator = draws.generator((*seed, 0))
    bias = config.bias * float(generator.standard_normal())
    row = draws.normals(generator, rate) if config.white else draws.none()
    drift, first = gauss_markov_of(config.drift, config.drift_time, (*seed, 1), draws, rate=rate)
    return Noise(bias, config.white, row, drift), first


@pure
def noise(config: Noise, drift: float, memory: RunMemory, dt: float) -> tuple[float, float]:
    """Return the drift and the error of the measurement `dt` seconds after the last one."""
    bias, white, row, process = config
    drift = gauss_markov(process, drift, memory, dt)
    error = bias + drift
    if white > 0.0:
        error += white * draw(memory, row)
    return drift, error


class Dropouts(NamedTuple):
    """Configuration of a sensor's gaps: mean time to the next one and mean length, s."""

    every: float
    length: float
    row: DrawnRow


def dropouts_of(config: DropoutConfig, seed: Seed, draws: Draws) -> tuple[Dropouts, float]:
    """Return the configuration of a sensor's gaps, and the time until the first, s."""
    if not config.every:
        return Dropouts(config.every, config.length, draws.none()), math.inf
    generator = draws.generator(seed)
    left = config.every * float(generator.standard_exponential())
    row = draws.exponentials(generator, 0.5 * (config.every + config.length))
    return Dropouts(config.every, config.length, row), left


@pure
def dropouts(config: Dropouts, silent: bool, left: float, memory: RunMemory, dt: float) -> tuple[bool, float]:
    """Return whether a sensor is silent `dt` seconds later, and the time until that changes, s."""
    left -= dt
    while left <= 0.0:
        silent = not silent
        left += (config.length if silent else config.every) * draw(memory, config.row)
    return silent, left


def period_of(rate: float) -> float:
    """Return the period of a sensor's rate (1/s), s; 0 for one that measures at every step."""
    return 1.0 / rate if rate else 0.0


@pure
def sampler(period: float, until: float, dt: float) -> tuple[float, bool]:
    """Return the time until a sensor's next measurement, s, and whether it measures `dt` seconds later.

    The period is kept; a step longer than it gives one measurement.

    Args:
        period: s; 0 for a measurement at every step.
        until: 0 at first.
        dt: s.
    """
    until -= dt
    if until > SAME:
        return until, False
    return max(until + period, 0.0), True


class Delay(NamedTuple):
    """Configuration of a delay: its steps, and the ring of delayed entries."""

    steps: int
    ring: Ring


def delay_of(latency: float, draws: Draws, width: int = 1) -> Delay:
    """Return the delay of a latency (s, rounded up to whole steps) for entries of `width` numbers."""
    steps = max(math.ceil((latency - SAME) / draws.step), 0)
    return Delay(steps, draws.ring(steps + 1, width))


@pure
def delayed(delay: Delay, k: int) -> int:
    """Return the place in `RunMemory.kept` of the entry that arrives at step `k`; at first, of the oldest."""
    return slot(delay.ring, max(k - delay.steps, 0))
