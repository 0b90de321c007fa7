"""A vehicle that dives, with ideal measurements: one step of its plant, and what is seen of it."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import SpatialCurrent, SpatialNavigation, SpatialWater
from auv_sim.vehicle.hulls.rigid_body import BodyState
from auv_sim.vehicle.hulls.spatial_plant import (
    SpatialAfloat,
    SpatialPlant,
    SpatialPlantInputs,
    spatial_ground_velocity,
    spatial_navigation_of,
    spatial_plant_step,
    spatial_water_of,
)


class SpatialSeen(NamedTuple):
    """Measurements of a vehicle that dives, and the truth behind them.

    Attributes:
        navigation: reported by the vehicle, NED.
        water: velocity through the water, reported by its log, m/s, FRD.
        water_lock: whether it was measured now; otherwise it is the last measurement.
        u, v, w: measured velocity over ground, m/s, FRD; NaN without bottom lock.
        altitude: measured range to the bottom along body z, m; infinite without an echo, NaN without an
            altimeter.
        motion: true pose and velocity through the water.
        rudder, sternplanes: measured angles of the servos, rad.
        current: true current where the vehicle is, m/s, NED.
    """

    navigation: SpatialNavigation
    water: SpatialWater
    water_lock: bool
    u: float
    v: float
    w: float
    altitude: float
    motion: BodyState
    rudder: float
    sternplanes: float
    current: SpatialCurrent


@pure
def measure_ideally(
    config: SpatialPlant, state: SpatialAfloat, inputs: SpatialPlantInputs, dt: float
) -> tuple[SpatialAfloat, SpatialSeen]:
    """Return ideal measurements, without an altimeter."""
    hull, rudder, sternplanes = state
    _, current, _ = inputs
    u, v, w = spatial_ground_velocity(hull, current)
    navigation, water = spatial_navigation_of(hull), spatial_water_of(hull)
    angles = rudder.angle, sternplanes.angle
    return state, SpatialSeen(navigation, water, True, u, v, w, math.nan, hull, angles[0], angles[1], current)


@pure
def step_ideally(
    config: SpatialPlant, state: SpatialAfloat, inputs: SpatialPlantInputs, dt: float
) -> tuple[SpatialAfloat, SpatialSeen]:
    """Advance by `dt` seconds under a held command and current, then measure."""
    state, _ = spatial_plant_step(config, state, inputs, dt)
    return measure_ideally(config, state, inputs, dt)
