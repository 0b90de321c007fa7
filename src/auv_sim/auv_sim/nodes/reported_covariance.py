"""The covariances of what a simulated vehicle reports at sea, from the errors of its instruments. ROS-free.

An element is 0 where the quantity is measured without an error, or not at all. All but the position's are
diagonal, and therefore equal in NED/FRD and ENU/FLU.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from auv_sim.vehicle.diving.diver_navigator import SpatialNavigatorState
from auv_sim.vehicle.noise import NoiseConfig
from auv_sim.vehicle.sensors import AngleConfig, SensorsConfig
from auv_sim.vehicle.velocity_log import VelocityConfig

#: A 6 x 6 covariance, row-major: x, y, z, then the rotations about them.
Covariance = tuple[float, ...]


class ReportedCovariances:
    """Computes the covariances of odometry and of the velocity through the water.

    Args:
        sensors: the instruments of the sea.
        dives: whether the vehicle has depth, roll and pitch.
        is_ned: whether the odometry's world frame is NED rather than ENU.
    """

    def __init__(self, sensors: SensorsConfig, dives: bool, is_ned: bool) -> None:
        self._sensors, self._dives, self._is_ned = sensors, dives, is_ned
        tilt = [_angle(sensors.roll), _angle(sensors.pitch)] if dives else [0.0, 0.0]
        self._attitude = [*tilt, _angle(sensors.heading)]
        pitch_rate = _angle(sensors.pitch_rate) if dives else 0.0
        self._rates = [0.0, pitch_rate, _angle(sensors.yaw_rate)]

    def pose(self, vehicle: Any) -> Covariance:
        """Return the covariance of the pose, m^2 and rad^2; that of the position is the navigator's own.

        The reported position approaches the estimated one gradually; what it still lacks counts as an error.
        """
        state = vehicle.state.navigator
        plane = state.plane if isinstance(state, SpatialNavigatorState) else state
        x, y = plane.shown.real, plane.shown.imag
        if not self._is_ned:
            x, y = y, x
        depth = 0.0
        if self._dives:
            config = self._sensors.depth
            depth = _variance(config.noise) + (config.scale * vehicle.navigation.z) ** 2
        found = _diagonal([plane.P_z + x * x, plane.P_z + y * y, depth, *self._attitude])
        found[1] = found[6] = x * y
        return tuple(found)

    def twist(self, velocity: Sequence[float]) -> Covariance:
        """Return the covariance of a twist with this velocity over ground, (m/s)^2 and (rad/s)^2."""
        linear = self._velocity(self._sensors.bottom_track, velocity)
        return tuple(_diagonal([*linear, *self._rates]))

    def water(self, velocity: Sequence[float]) -> Covariance:
        """Return the covariance of a velocity through the water, (m/s)^2."""
        return tuple(_diagonal([*self._velocity(self._sensors.water_track, velocity), 0.0, 0.0, 0.0]))

    def _velocity(self, log: VelocityConfig, velocity: Sequence[float]) -> list[float]:
        """Return the variances of a Doppler log's components; 0 for one that was not measured."""
        error = _variance(log.noise)
        found = [0.0 if math.isnan(value) else error + (log.scale * value) ** 2 for value in velocity]
        return [*found, 0.0][:3]


def _variance(noise: NoiseConfig) -> float:
    return noise.white**2 + noise.bias**2 + noise.drift**2


def _angle(config: AngleConfig) -> float:
    return _variance(config.noise_deg) * math.radians(1.0) ** 2


def _diagonal(values: Sequence[float]) -> list[float]:
    found = [0.0] * 36
    found[::7] = values
    return found
