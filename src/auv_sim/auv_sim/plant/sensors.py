"""The simulated vehicle's instruments: compass, gyro, two velocity logs, acoustic position fixes."""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import numpy as np

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import WaterVelocity
from auv_sim.plant.noise import Delay, DropoutConfig, Dropouts, Noise, NoiseConfig, Sampler, Seed


@settings
class AngleConfig:
    """Compass (degrees) or gyro (degrees a second)."""

    noise_deg: NoiseConfig = setting(factory=NoiseConfig, doc="errors, deg or deg/s")
    latency: float = setting(0.0, "age of what it tells", unit="s", ge=0.0, le=5.0)


@settings
class VelocityConfig:
    """A Doppler log, over ground or through the water."""

    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors of each component, m/s")
    scale: float = setting(
        0.0, "standard deviation of the scale's error, drawn once for a run", ge=0.0, le=0.2
    )
    rate: float = setting(0.0, "measurements a second; 0: at every step", unit="1/s", ge=0.0)
    latency: float = setting(0.0, "age of what it tells", unit="s", ge=0.0, le=5.0)
    dropouts: DropoutConfig = setting(factory=DropoutConfig, doc="gaps")
    lock: bool = setting(True, "whether there is anything within its reach: bottom or water")


@settings
class FixConfig:
    """Acoustic position fixes from outside (USBL), each with the time at which it was true."""

    noise: NoiseConfig = setting(factory=NoiseConfig, doc="errors north and east, m")
    rate: float = setting(0.0, "fixes a second; 0: at every step", unit="1/s", ge=0.0)
    latency: float = setting(0.0, "from the measurement to its arrival on board", unit="s", ge=0.0, le=30.0)
    dropouts: DropoutConfig = setting(factory=DropoutConfig, doc="gaps")
    outliers: float = setting(0.0, "share of the fixes that are false echoes", ge=0.0, le=1.0)
    outlier_nearest: float = setting(10.0, "a false echo lies at least so far off", unit="m", ge=0.0)
    outlier_farthest: float = setting(50.0, "and at most so far", unit="m", ge=0.0)


@settings
class SensorsConfig:
    """All instruments; ideal by default."""

    heading: AngleConfig = setting(factory=AngleConfig, doc="compass (AHRS)")
    yaw_rate: AngleConfig = setting(factory=AngleConfig, doc="gyro")
    water_track: VelocityConfig = setting(factory=VelocityConfig, doc="velocity through the water")
    bottom_track: VelocityConfig = setting(factory=VelocityConfig, doc="velocity over ground (DVL)")
    position: FixConfig = setting(factory=FixConfig, doc="position fixes (USBL)")


class Truth(NamedTuple):
    """What there is to measure: NED, FRD, m, rad, s; (u, v) over ground, (ur, vr) through the water."""

    x: float
    y: float
    psi: float
    r: float
    ur: float
    vr: float
    u: float
    v: float


class Fix(NamedTuple):
    """A position (m, north, east) and for how long it has been past, s."""

    x: float
    y: float
    age: float


class Measurements(NamedTuple):
    """One step's measurements: rad, rad/s, m/s; None where there is none."""

    psi: float
    r: float
    water: WaterVelocity
    water_lock: bool
    bottom: tuple[float, float] | None
    fixes: tuple[Fix, ...]


class AngleSensor:
    """Compass or gyro.

    Args:
        config: its errors.
        seed: of its generators.
    """

    def __init__(self, config: AngleConfig, seed: Seed) -> None:
        self._noise = Noise(config.noise_deg, seed)
        self._delay: Delay[float] = Delay(config.latency)

    def reset(self) -> None:
        """Begin the same run again."""
        self._noise.reset()
        self._delay.reset()

    def update(self, truth: float, dt: float) -> float:
        """What it tells `dt` seconds later, rad or rad/s."""
        return self._delay.update(truth + math.radians(self._noise.update(dt)), dt)


class VelocityLog:
    """A Doppler log: between two of its measurements it goes on telling the last one.

    Args:
        config: its errors.
        seed: of its generators.
    """

    def __init__(self, config: VelocityConfig, seed: Seed) -> None:
        self.config, self._seed = config, tuple(seed)
        self._noise = Noise(config.noise, (*seed, 0)), Noise(config.noise, (*seed, 1))
        self._dropouts = Dropouts(config.dropouts, (*seed, 2))
        self._sampler = Sampler(config.rate)
        self._delay: Delay[tuple[float, float]] = Delay(config.latency)
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        for part in (*self._noise, self._dropouts, self._sampler, self._delay):
            part.reset()
        generator = np.random.default_rng((*self._seed, 3))
        self._scale = 1.0 + self.config.scale * float(generator.standard_normal())
        self._last: tuple[float, float] | None = None
        self._since = 0.0

    def update(self, forward: float, starboard: float, dt: float) -> tuple[tuple[float, float], bool]:
        """The velocity it tells `dt` seconds later, m/s, and whether it sees bottom or water."""
        silent = self._dropouts.update(dt) or not self.config.lock
        measured = self._delay.update((forward, starboard), dt)
        self._since += dt
        if (self._sampler.update(dt) and not silent) or self._last is None:
            since, self._since = self._since, 0.0
            self._last = (
                self._scale * measured[0] + self._noise[0].update(since),
                self._scale * measured[1] + self._noise[1].update(since),
            )
        return self._last, not silent


class PositionFixes:
    """Acoustic fixes: seldom, late, sometimes an echo from elsewhere.

    Args:
        config: their errors.
        seed: of their generators.
    """

    def __init__(self, config: FixConfig, seed: Seed) -> None:
        self.config, self._seed = config, tuple(seed)
        self._noise = Noise(config.noise, (*seed, 0)), Noise(config.noise, (*seed, 1))
        self._dropouts = Dropouts(config.dropouts, (*seed, 2))
        self._sampler = Sampler(config.rate)
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        for part in (*self._noise, self._dropouts, self._sampler):
            part.reset()
        self._generator = np.random.default_rng((*self._seed, 3))
        self._under_way: deque[tuple[float, Fix]] = deque()
        self._now = self._since = 0.0

    def update(self, x: float, y: float, dt: float) -> tuple[Fix, ...]:
        """The fixes that arrive `dt` seconds later."""
        self._now += dt
        self._since += dt
        silent = self._dropouts.update(dt)
        if self._sampler.update(dt):
            since, self._since = self._since, 0.0
            fix = self._measure(x, y, since)
            if not silent:
                self._under_way.append((self._now + self.config.latency, fix))
        arrived = []
        while self._under_way and self._under_way[0][0] <= self._now + 1e-9:
            due, fix = self._under_way.popleft()
            arrived.append(fix._replace(age=fix.age + max(self._now - due, 0.0)))
        return tuple(arrived)

    def _measure(self, x: float, y: float, since: float) -> Fix:
        c = self.config
        chance, size, bearing = self._generator.random(3).tolist()
        x, y = x + self._noise[0].update(since), y + self._noise[1].update(since)
        if chance < c.outliers:
            far = c.outlier_nearest + size * (c.outlier_farthest - c.outlier_nearest)
            x, y = x + far * math.cos(2.0 * math.pi * bearing), y + far * math.sin(2.0 * math.pi * bearing)
        return Fix(x, y, c.latency)


class Sensors:
    """All instruments of one vehicle.

    Args:
        config: their errors.
        seed: of the run.
    """

    def __init__(self, config: SensorsConfig, seed: Seed) -> None:
        self.heading = AngleSensor(config.heading, (*seed, 0))
        self.yaw_rate = AngleSensor(config.yaw_rate, (*seed, 1))
        self.water_track = VelocityLog(config.water_track, (*seed, 2))
        self.bottom_track = VelocityLog(config.bottom_track, (*seed, 3))
        self.position = PositionFixes(config.position, (*seed, 4))

    def reset(self) -> None:
        """Begin the same run again."""
        for part in (self.heading, self.yaw_rate, self.water_track, self.bottom_track, self.position):
            part.reset()

    def update(self, truth: Truth, dt: float) -> Measurements:
        """Measure, `dt` seconds after the last time."""
        water, water_lock = self.water_track.update(truth.ur, truth.vr, dt)
        bottom, bottom_lock = self.bottom_track.update(truth.u, truth.v, dt)
        return Measurements(
            psi=wrap(self.heading.update(truth.psi, dt)),
            r=self.yaw_rate.update(truth.r, dt),
            water=WaterVelocity(*water),
            water_lock=water_lock,
            bottom=bottom if bottom_lock else None,
            fixes=self.position.update(truth.x, truth.y, dt),
        )
