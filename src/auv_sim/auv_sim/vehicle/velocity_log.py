"""A Doppler log: velocity over ground or through the water, with scale error, noise, gaps and delay."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import Draws, Now, Seed, slot
from auv_sim.vehicle.noise import (
    Delay,
    DropoutConfig,
    Dropouts,
    Noise,
    NoiseConfig,
    delay_of,
    delayed,
    dropouts,
    dropouts_of,
    noise,
    noise_of,
    period_of,
    sampler,
)


@settings
class VelocityConfig:
    """A Doppler log, over ground or through the water."""

    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors of each component, m/s")
    scale: float = setting(
        0.0, "standard deviation of the scale's error, drawn once for a run", ge=0.0, le=0.2
    )
    rate: float = setting(0.0, "measurements a second; 0: at every step", unit="1/s", ge=0.0)
    latency: float = setting(0.0, "age of its measurements", unit="s", ge=0.0, le=5.0)
    dropouts: DropoutConfig = setting(factory=DropoutConfig, doc="gaps")
    lock: bool = setting(True, "whether bottom or water is within its range")
    highest: float = setting(
        0.0,
        "over ground, for a vehicle that dives above a bottom: largest height with lock; 0: no limit",
        unit="m",
        ge=0.0,
    )


class Log(NamedTuple):
    """Configuration of a Doppler log in one run: scale, noise of both components, gaps, period (s), delay."""

    scale: float
    forward: Noise
    starboard: Noise
    dropouts: Dropouts
    period: float
    delay: Delay
    lock: bool


class LogState(NamedTuple):
    """State of a Doppler log.

    Attributes:
        u, v: the last measurement, m/s.
        forward, starboard: drifts, m/s.
        silent, left: whether it is silent, and the time until that changes, s.
        until, since: time until the next measurement and since the last one, s.
    """

    u: float
    v: float
    forward: float
    starboard: float
    silent: bool
    left: float
    until: float
    since: float


def log_of(config: VelocityConfig, seed: Seed, draws: Draws) -> tuple[Log, LogState]:
    """Return configuration and first state of a Doppler log."""
    forward, first = noise_of(config.noise, (*seed, 0), draws, config.rate)
    starboard, second = noise_of(config.noise, (*seed, 1), draws, config.rate)
    gaps, left = dropouts_of(config.dropouts, (*seed, 2), draws)
    scale = 1.0 + config.scale * float(draws.generator((*seed, 3)).standard_normal())
    delay = delay_of(config.latency, draws, 2)
    log = Log(scale, forward, starboard, gaps, period_of(config.rate), delay, config.lock)
    return log, LogState(0.0, 0.0, first, second, False, left, 0.0, 0.0)


@pure
def measure_velocity(
    config: Log, state: LogState, u: float, v: float, now: Now, dt: float
) -> tuple[LogState, bool]:
    """Return the state with the reported velocity, and whether the log has lock on bottom or water.

    Between two measurements it repeats the last one.

    Args:
        config, state: of the log.
        u, v: the truth, m/s, FRD.
        now: of the run.
        dt: s.
    """
    scale, forward_noise, starboard_noise, gaps, period, delay, lock = config
    last_u, last_v, forward, starboard, silent, left, until, since = state
    memory, _, k = now
    silent, left = dropouts(gaps, silent, left, memory, dt)
    seen = lock and not silent
    if delay.steps > 0:
        at, kept = slot(delay.ring, k), memory.kept
        kept[at], kept[at + 1] = u, v
        at = delayed(delay, k)
        u, v = kept[at], kept[at + 1]
    since += dt
    until, due = sampler(period, until, dt)
    if (due and seen) or k == 0:
        forward, error_u = noise(forward_noise, forward, memory, since)
        starboard, error_v = noise(starboard_noise, starboard, memory, since)
        last_u, last_v, since = scale * u + error_u, scale * v + error_v, 0.0
    return LogState(last_u, last_v, forward, starboard, silent, left, until, since), seen
