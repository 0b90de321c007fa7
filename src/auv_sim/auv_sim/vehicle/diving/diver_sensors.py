"""The instruments of a vehicle that dives."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialWater
from auv_sim.vehicle.diving.altimeter import (
    Altimeter,
    AltimeterState,
    altimeter_of,
    measure_range,
)
from auv_sim.vehicle.diving.bottom import Bottom, bottom_at
from auv_sim.vehicle.diving.depth_sensor import DepthSensor, DepthState, depth_sensor_of, measure_depth
from auv_sim.vehicle.diving.spatial_log import (
    SpatialLog,
    SpatialLogState,
    measure_spatial_velocity,
    spatial_log_of,
)
from auv_sim.vehicle.diving.surface_fixes import (
    SurfaceFixes,
    SurfaceFixesState,
    measure_at_surface,
    surface_fixes_of,
)
from auv_sim.vehicle.draws import Draws, Now, Seed
from auv_sim.vehicle.hulls.rigid_body import BodyState, angles_of
from auv_sim.vehicle.position_fixes import Fixes, FixesState, fixes_of, measure_position
from auv_sim.vehicle.sensors import Angle, SensorsConfig, angle_of, measure_angle


class SpatialMeasurements(NamedTuple):
    """One step's measurements.

    Attributes:
        phi, theta, psi, q, r: rad, rad/s.
        depth: the last measurement, m.
        is_depth_new: whether it was measured now.
        altitude: range to the bottom along body z, m; infinite without an echo, NaN without an altimeter.
        water: velocity through the water, m/s, FRD; the last measurement.
        water_lock: whether it was measured now.
        ground: u, v, w over ground, m/s, FRD; the last measurement.
        bottom_lock: whether it was measured now.
        first, after: range of the acoustic fixes that arrived, in the count of their ring's entries.
        surface_first, surface_after: the same of satellite fixes.
    """

    phi: float
    theta: float
    psi: float
    q: float
    r: float
    depth: float
    is_depth_new: bool
    altitude: float
    water: SpatialWater
    water_lock: bool
    ground: tuple[float, float, float]
    bottom_lock: bool
    first: int
    after: int
    surface_first: int
    surface_after: int


class AttitudeSensors(NamedTuple):
    """Configuration of AHRS and gyros."""

    roll: Angle
    pitch: Angle
    heading: Angle
    pitch_rate: Angle
    yaw_rate: Angle


#: Drifts of AHRS and gyros, deg or deg/s, in the order of `AttitudeSensors`.
Drifts = tuple[float, float, float, float, float]


class SpatialSensors(NamedTuple):
    """Configuration of all instruments of one vehicle in one run."""

    attitude: AttitudeSensors
    depth: DepthSensor
    altimeter: Altimeter
    water_track: SpatialLog
    bottom_track: SpatialLog
    position: Fixes
    surface_fix: SurfaceFixes


class SpatialSensorsState(NamedTuple):
    """State of all instruments."""

    attitude: Drifts
    depth: DepthState
    altimeter: AltimeterState
    water_track: SpatialLogState
    bottom_track: SpatialLogState
    position: FixesState
    surface_fix: SurfaceFixesState


def spatial_sensors_of(
    config: SensorsConfig, seed: Seed, draws: Draws
) -> tuple[SpatialSensors, SpatialSensorsState]:
    """Return configuration and first state of all instruments.

    Instruments that a vehicle in the plane has too draw the same numbers as there.

    Args:
        config: their errors.
        seed: of their generators.
        draws: of the run.
    """
    heading, compass = angle_of(config.heading, (*seed, 0), draws)
    yaw_rate, yaw_gyro = angle_of(config.yaw_rate, (*seed, 1), draws)
    water, water_state = spatial_log_of(config.water_track, (*seed, 2), draws)
    ground, ground_state = spatial_log_of(config.bottom_track, (*seed, 3), draws)
    fixes, fixes_state = fixes_of(config.position, (*seed, 4), draws)
    roll, roll_drift = angle_of(config.roll, (*seed, 5), draws)
    pitch, pitch_drift = angle_of(config.pitch, (*seed, 6), draws)
    pitch_rate, pitch_gyro = angle_of(config.pitch_rate, (*seed, 7), draws)
    depth, depth_state = depth_sensor_of(config.depth, (*seed, 8), draws)
    altimeter, altimeter_state = altimeter_of(config.altimeter, (*seed, 9), draws)
    surface, surface_state = surface_fixes_of(config.surface_fix, (*seed, 10), draws)
    attitude = AttitudeSensors(roll, pitch, heading, pitch_rate, yaw_rate)
    drifts = roll_drift, pitch_drift, compass, pitch_gyro, yaw_gyro
    return (
        SpatialSensors(attitude, depth, altimeter, water, ground, fixes, surface),
        SpatialSensorsState(
            drifts, depth_state, altimeter_state, water_state, ground_state, fixes_state, surface_state
        ),
    )


@pure
def measure_attitude(
    config: AttitudeSensors, drifts: Drifts, body: BodyState, now: Now, dt: float
) -> tuple[Drifts, tuple[float, float, float, float, float]]:
    """Return the drifts, and measured roll, pitch, heading (rad), pitch and yaw rate (rad/s)."""
    phi, theta, psi = angles_of(body)
    a, phi = measure_angle(config.roll, drifts[0], phi, now, dt)
    b, theta = measure_angle(config.pitch, drifts[1], theta, now, dt)
    c, psi = measure_angle(config.heading, drifts[2], psi, now, dt)
    d, q = measure_angle(config.pitch_rate, drifts[3], body.q, now, dt)
    e, r = measure_angle(config.yaw_rate, drifts[4], body.r, now, dt)
    return (a, b, c, d, e), (phi, theta, wrap(psi), q, r)


@pure
def sense_in_space(
    config: SpatialSensors, state: SpatialSensorsState, body: BodyState,
    over_ground: tuple[float, float, float], bottom: Bottom, now: Now, dt: float,
) -> tuple[SpatialSensorsState, SpatialMeasurements]:  # fmt: skip
    """Measure, `dt` seconds after the last measurement.

    Args:
        config, state: of the instruments.
        body: true pose and velocity through the water.
        over_ground: true u, v, w over ground, m/s, FRD.
        bottom: below the vehicle.
        now: of the run.
        dt: s; 0 for the first measurement.
    """
    through = body.ur, body.vr, body.wr
    height = bottom_at(bottom, body.x, body.y) - body.z if bottom.depth > 0.0 else 0.0
    water, water_lock = measure_spatial_velocity(config.water_track, state.water_track, through, 0.0, now, dt)
    ground, lock = measure_spatial_velocity(
        config.bottom_track, state.bottom_track, over_ground, height, now, dt
    )
    drifts, (phi, theta, psi, q, r) = measure_attitude(config.attitude, state.attitude, body, now, dt)
    fixes = measure_position(config.position, state.position, body.x, body.y, now, dt)
    depth = measure_depth(config.depth, state.depth, body.z, now, dt)
    altimeter = measure_range(config.altimeter, state.altimeter, bottom, body, now, dt)
    surface = measure_at_surface(config.surface_fix, state.surface_fix, body.x, body.y, body.z, now, dt)
    measured = SpatialMeasurements(
        phi, theta, psi, q, r,
        depth.depth, depth.is_new,
        altimeter.last,
        SpatialWater(water.plane.u, water.plane.v, water.w), water_lock,
        (ground.plane.u, ground.plane.v, ground.w), lock,
        state.position.first, fixes.first,
        state.surface_fix.fixes.first, surface.fixes.first,
    )  # fmt: skip
    return SpatialSensorsState(drifts, depth, altimeter, water, ground, fixes, surface), measured
