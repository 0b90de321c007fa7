"""Acoustic position fixes from outside (USBL): infrequent, delayed, sometimes a false echo."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import DrawnRow, Draws, Now, Ring, Seed, draw, slot
from auv_sim.vehicle.noise import (
    SAME,
    DropoutConfig,
    Dropouts,
    Noise,
    NoiseConfig,
    dropouts,
    dropouts_of,
    noise,
    noise_of,
    period_of,
    sampler,
)


@settings
class FixConfig:
    """Acoustic position fixes from outside (USBL), each with its time of measurement."""

    fitted: bool = setting(True, "whether there are such fixes")
    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors north and east, m")
    rate: float = setting(0.0, "fixes a second; 0: at every step", unit="1/s", ge=0.0)
    latency: float = setting(0.0, "from the measurement to its arrival on board", unit="s", ge=0.0, le=30.0)
    dropouts: DropoutConfig = setting(factory=DropoutConfig, doc="gaps")
    outliers: float = setting(0.0, "share of false echoes among the fixes", ge=0.0, le=1.0)
    outlier_nearest: float = setting(10.0, "least distance of a false echo", unit="m", ge=0.0)
    outlier_farthest: float = setting(50.0, "largest distance of a false echo", unit="m", ge=0.0)


class Fixes(NamedTuple):
    """Configuration of acoustic position fixes.

    Attributes:
        x, y: noise north and east, m.
        dropouts, period, latency: gaps; s, s.
        outliers, nearest, farthest: share of false echoes, and their distances, m.
        echoes: uniform numbers, three for each fix.
        ring: fixes on their way: time of arrival (s), north, east (m).
    """

    x: Noise
    y: Noise
    dropouts: Dropouts
    period: float
    latency: float
    outliers: float
    nearest: float
    farthest: float
    echoes: DrawnRow
    ring: Ring


class FixesState(NamedTuple):
    """State of the fixes: drifts (m), gap and times as in `LogState`, the range of fixes on their way."""

    x: float
    y: float
    silent: bool
    left: float
    until: float
    since: float
    first: int
    after: int


def fixes_of(config: FixConfig, seed: Seed, draws: Draws) -> tuple[Fixes, FixesState]:
    """Return configuration and first state of the position fixes."""
    x, first = noise_of(config.noise, (*seed, 0), draws, config.rate)
    y, second = noise_of(config.noise, (*seed, 1), draws, config.rate)
    gaps, left = dropouts_of(config.dropouts, (*seed, 2), draws)
    echoes = draws.uniforms(draws.generator((*seed, 3)), 3, config.rate)
    period = period_of(config.rate)
    ring = draws.ring(math.ceil(config.latency / max(period, draws.step)) + 3, 3)
    echo = config.outliers, config.outlier_nearest, config.outlier_farthest
    fixes = Fixes(x, y, gaps, period, config.latency, *echo, echoes, ring)
    until = 0.0 if config.fitted else math.inf
    return fixes, FixesState(first, second, False, left, until, 0.0, 0, 0)


@pure
def measure_position(config: Fixes, state: FixesState, x: float, y: float, now: Now, dt: float) -> FixesState:
    """Return the state after a fix may have been measured and others have arrived.

    The arrived ones lie between the former and the new `first`.

    Args:
        config, state: of the fixes.
        x, y: the truth, NED, m.
        now: of the run.
        dt: s.
    """
    drift_x, drift_y, silent, left, until, since, first, after = state
    memory, ring = now.memory, config.ring
    since += dt
    silent, left = dropouts(config.dropouts, silent, left, memory, dt)
    until, due = sampler(config.period, until, dt)
    if due:
        chance, size = draw(memory, config.echoes), draw(memory, config.echoes)
        bearing = draw(memory, config.echoes)
        drift_x, error_x = noise(config.x, drift_x, memory, since)
        drift_y, error_y = noise(config.y, drift_y, memory, since)
        x, y, since = x + error_x, y + error_y, 0.0
        if chance < config.outliers:
            far = config.nearest + size * (config.farthest - config.nearest)
            x, y = x + far * math.cos(2.0 * math.pi * bearing), y + far * math.sin(2.0 * math.pi * bearing)
        if not silent:
            at = slot(ring, after)
            memory.kept[at], memory.kept[at + 1], memory.kept[at + 2] = now.time + config.latency, x, y
            after += 1
    while first < after and memory.kept[slot(ring, first)] <= now.time + SAME:
        first += 1
    return FixesState(drift_x, drift_y, silent, left, until, since, first, after)
