"""A pressure sensor: depth with an offset, a scale error, noise and a lag."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.draws import Draws, Now, Seed
from auv_sim.vehicle.noise import Noise, NoiseConfig, noise, noise_of, period_of, sampler


@settings
class DepthConfig:
    """A pressure sensor, scaled to depth."""

    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors of the depth, m")
    scale: float = setting(
        0.0, "standard deviation of the scale's error, drawn once for a run", ge=0.0, le=0.2
    )
    lag: float = setting(0.0, "time constant of its response, of first order", unit="s", ge=0.0, le=5.0)
    rate: float = setting(0.0, "measurements a second; 0: at every step", unit="1/s", ge=0.0)


class DepthSensor(NamedTuple):
    """Configuration of a pressure sensor: scale, noise, lag and period, s."""

    scale: float
    noise: Noise
    lag: float
    period: float


class DepthState(NamedTuple):
    """State of a pressure sensor.

    Attributes:
        depth: the last measurement, m.
        pressure: the depth at which its lagging membrane is, m.
        drift: m.
        until, since: time until the next measurement and since the last one, s.
        is_new: whether it was measured now.
    """

    depth: float
    pressure: float
    drift: float
    until: float
    since: float
    is_new: bool


def depth_sensor_of(config: DepthConfig, seed: Seed, draws: Draws) -> tuple[DepthSensor, DepthState]:
    """Return configuration and first state of a pressure sensor."""
    error, drift = noise_of(config.noise, (*seed, 0), draws, config.rate)
    scale = 1.0 + config.scale * float(draws.generator((*seed, 1)).standard_normal())
    sensor = DepthSensor(scale, error, config.lag, period_of(config.rate))
    return sensor, DepthState(0.0, 0.0, drift, 0.0, 0.0, False)


@pure
def measure_depth(config: DepthSensor, state: DepthState, z: float, now: Now, dt: float) -> DepthState:
    """Return the state with the last measured depth, m.

    Args:
        config, state: of the sensor.
        z: true depth, m.
        now: of the run.
        dt: s.
    """
    scale, errors, lag, period = config
    depth, pressure, drift, until, since, _ = state
    if now.k == 0 or not lag > 0.0:
        pressure = z
    else:
        pressure += (z - pressure) * -math.expm1(-dt / lag)
    since += dt
    until, due = sampler(period, until, dt)
    if due:
        drift, error = noise(errors, drift, now.memory, since)
        depth, since = scale * pressure + error, 0.0
    return DepthState(depth, pressure, drift, until, since, due)
