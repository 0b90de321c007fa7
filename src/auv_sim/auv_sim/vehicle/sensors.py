"""The instruments: their settings, and those of a vehicle in the plane.

Compass, gyro, two velocity logs, acoustic position fixes.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import pydantic

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.settings.validators import unfit
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import WaterVelocity
from auv_sim.vehicle.diving.altimeter import AltimeterConfig
from auv_sim.vehicle.diving.depth_sensor import DepthConfig
from auv_sim.vehicle.diving.surface_fixes import SurfaceFixConfig
from auv_sim.vehicle.draws import Draws, Now, Seed, slot
from auv_sim.vehicle.noise import Delay, Noise, NoiseConfig, delay_of, delayed, noise, noise_of
from auv_sim.vehicle.position_fixes import FixConfig, Fixes, FixesState, fixes_of, measure_position
from auv_sim.vehicle.remus import PlantState
from auv_sim.vehicle.velocity_log import Log, LogState, VelocityConfig, log_of, measure_velocity


@settings
class AngleConfig:
    """Compass (degrees) or gyro (degrees a second)."""

    noise_deg: NoiseConfig = setting(factory=NoiseConfig, doc="errors, deg or deg/s")
    latency: float = setting(0.0, "age of its measurements", unit="s", ge=0.0, le=5.0)


@settings
class SensorsConfig:
    """All instruments; ideal by default."""

    heading: AngleConfig = setting(factory=AngleConfig, doc="compass (AHRS)")
    yaw_rate: AngleConfig = setting(factory=AngleConfig, doc="gyro")
    water_track: VelocityConfig = setting(factory=VelocityConfig, doc="velocity through the water")
    bottom_track: VelocityConfig = setting(factory=VelocityConfig, doc="velocity over ground (DVL)")
    position: FixConfig = setting(factory=FixConfig, doc="position fixes (USBL)")
    roll: AngleConfig = setting(factory=AngleConfig, doc="of the AHRS, for a vehicle that dives")
    pitch: AngleConfig = setting(factory=AngleConfig, doc="of the AHRS, for a vehicle that dives")
    pitch_rate: AngleConfig = setting(factory=AngleConfig, doc="gyro, for a vehicle that dives")
    depth: DepthConfig = setting(factory=DepthConfig, doc="pressure sensor, for a vehicle that dives")
    altimeter: AltimeterConfig = setting(factory=AltimeterConfig, doc="altimeter, for a vehicle that dives")
    surface_fix: SurfaceFixConfig = setting(
        factory=SurfaceFixConfig, doc="satellite fixes, for a vehicle that dives"
    )

    @pydantic.model_validator(mode="after")
    def _water_has_no_height(self) -> SensorsConfig:
        if self.water_track.highest > 0.0:
            raise unfit(
                f"highest: {self.water_track.highest:g} under water_track",
                "it under bottom_track: a log of the water needs no bottom",
            )
        return self


class Measurements(NamedTuple):
    """One step's measurements.

    Attributes:
        psi, r: rad, rad/s.
        water: velocity through the water, m/s, FRD; the last measurement.
        water_lock: whether it was measured now.
        u, v: velocity over ground, m/s, FRD; the last measurement.
        bottom_lock: whether it was measured now.
        first, after: range of the fixes that arrived, in the count of the ring's entries.
    """

    psi: float
    r: float
    water: WaterVelocity
    water_lock: bool
    u: float
    v: float
    bottom_lock: bool
    first: int
    after: int


class Angle(NamedTuple):
    """Configuration of compass or gyro; the noise is in deg or deg/s. Its state is the drift."""

    noise: Noise
    delay: Delay


def angle_of(config: AngleConfig, seed: Seed, draws: Draws) -> tuple[Angle, float]:
    """Return the configuration of a compass or gyro, and the first value of its drift."""
    error, drift = noise_of(config.noise_deg, seed, draws)
    return Angle(error, delay_of(config.latency, draws)), drift


@pure
def measure_angle(config: Angle, drift: float, truth: float, now: Now, dt: float) -> tuple[float, float]:
    """Return the drift and the measured angle or rate, rad or rad/s."""
    drift, error = noise(config.noise, drift, now.memory, dt)
    measured = truth + math.radians(error)
    if config.delay.steps == 0:
        return drift, measured
    now.memory.kept[slot(config.delay.ring, now.k)] = measured
    return drift, now.memory.kept[delayed(config.delay, now.k)]


class Sensors(NamedTuple):
    """Configuration of all instruments of one vehicle in one run."""

    heading: Angle
    yaw_rate: Angle
    water_track: Log
    bottom_track: Log
    position: Fixes


class SensorsState(NamedTuple):
    """State of all instruments; of compass and gyro, their drifts."""

    heading: float
    yaw_rate: float
    water_track: LogState
    bottom_track: LogState
    position: FixesState


def sensors_of(config: SensorsConfig, seed: Seed, draws: Draws) -> tuple[Sensors, SensorsState]:
    """Return configuration and first state of all instruments.

    Args:
        config: their errors.
        seed: of their generators.
        draws: of the run.
    """
    heading, compass = angle_of(config.heading, (*seed, 0), draws)
    yaw_rate, gyro = angle_of(config.yaw_rate, (*seed, 1), draws)
    water, water_state = log_of(config.water_track, (*seed, 2), draws)
    bottom, bottom_state = log_of(config.bottom_track, (*seed, 3), draws)
    fixes, fixes_state = fixes_of(config.position, (*seed, 4), draws)
    state = SensorsState(compass, gyro, water_state, bottom_state, fixes_state)
    return Sensors(heading, yaw_rate, water, bottom, fixes), state


@pure
def sense(
    config: Sensors, state: SensorsState, truth: PlantState, u: float, v: float, now: Now, dt: float
) -> tuple[SensorsState, Measurements]:
    """Measure, `dt` seconds after the last measurement.

    Args:
        config, state: of the instruments.
        truth: pose and velocity through the water.
        u, v: true velocity over ground, m/s, FRD.
        now: of the run.
        dt: s; 0 for the first measurement.
    """
    x, y, true_psi, ur, vr, true_r = truth
    compass, gyro, water, bottom, fixes = state
    water, water_lock = measure_velocity(config.water_track, water, ur, vr, now, dt)
    bottom, bottom_lock = measure_velocity(config.bottom_track, bottom, u, v, now, dt)
    compass, psi = measure_angle(config.heading, compass, true_psi, now, dt)
    gyro, r = measure_angle(config.yaw_rate, gyro, true_r, now, dt)
    fixes = measure_position(config.position, fixes, x, y, now, dt)
    measured = Measurements(
        wrap(psi),
        r,
        WaterVelocity(water.u, water.v),
        water_lock,
        bottom.u,
        bottom.v,
        bottom_lock,
        state.position.first,
        fixes.first,
    )
    return SensorsState(compass, gyro, water, bottom, fixes), measured
