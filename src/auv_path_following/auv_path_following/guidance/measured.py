"""What guidance receives with each odometry."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.values.types import Navigation, SpatialNavigation, SpatialWater, WaterVelocity


class Measured(NamedTuple):
    """One measurement.

    Attributes:
        navigation: pose and yaw rate, NED.
        water: velocity through the water, FRD, m/s.
        has_water: whether `water` is valid.
        moved: whether the pose does not continue the last one.
        to_go: path from the virtual point to the end at the last step, m; only for limits.
        now: ROS time, s.
    """

    navigation: Navigation
    water: WaterVelocity
    has_water: bool
    moved: bool
    to_go: float
    now: float


class SpatialMeasured(NamedTuple):
    """One measurement of a vehicle that dives: the fields of `Measured` in three dimensions.

    Attributes:
        navigation: pose and rates, NED.
        water: velocity through the water, FRD, m/s.
        has_water, moved, to_go, now: as in `Measured`.
        altitude: range to the bottom along body z, m; infinite without an echo, NaN without an altimeter.
    """

    navigation: SpatialNavigation
    water: SpatialWater
    has_water: bool
    moved: bool
    to_go: float
    now: float
    altitude: float
