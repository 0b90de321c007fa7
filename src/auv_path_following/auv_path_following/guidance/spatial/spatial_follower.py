"""Configuration of guidance in three dimensions, from settings and vehicle."""

from __future__ import annotations

from typing import Any, NamedTuple

from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.guidance import path_follower
from auv_path_following.guidance.approach import agility_of
from auv_path_following.guidance.follow import FollowerConfig
from auv_path_following.guidance.path_follower import PathFollowerConfig
from auv_path_following.guidance.progress import ProgressConfig
from auv_path_following.guidance.spatial.spatial_laws import VerticalLaw
from auv_path_following.guidance.spatial.spatial_limits import Steepness, steepest_of
from auv_path_following.guidance.spatial.vertical_modes import FOLLOW_PATH, AltitudeHold
from auv_path_following.missions.limits import LimitsConfig
from auv_path_following.missions.mission_file import Mission
from auv_path_following.vehicle import Vehicle

#: Bound of |theta_b|: the share of the speed that a current across the path may have.
CURRENT_SHARE = 0.95


class SpatialFollower(NamedTuple):
    """Configuration.

    Attributes:
        plane: of the horizontal plane: law, virtual point, switching.
        vertical: of the law in the vertical plane.
        mode: of `vertical_step`: what that plane follows.
        steepness: theta_max(u).
        pitch_rate: bound of q_d, rad/s.
    """

    plane: FollowerConfig
    vertical: VerticalLaw
    mode: Any
    steepness: Steepness
    pitch_rate: float

    @property
    def progress(self) -> ProgressConfig:
        """Configuration of P's motion, as a planar follower has it."""
        return self.plane.progress


def prepare(
    config: PathFollowerConfig, vehicle: Vehicle, thrust: float, mode: Any, begins_at: float = 0.0
) -> SpatialFollower:
    """Return the configuration of guidance.

    Args:
        config: laws and gains of both planes.
        vehicle: hull and fins.
        thrust: of the mission, N.
        mode: of `vertical_step`.
        begins_at: path parameter s at which a mission begins, in [0, n).

    Raises:
        ConfigurationError: the vehicle's file lacks what the pitch autopilot needs.
    """
    plane = path_follower.prepare(config, agility_of(vehicle, thrust), begins_at)
    law = VerticalLaw(float(config.vertical.lookahead), CURRENT_SHARE, plane.minimum_speed)
    rate = agility_of(pitch_plane_of(vehicle), thrust).turn_rate
    return SpatialFollower(plane, law, mode, steepest_of(vehicle, thrust), rate)


def altitude_hold(
    config: PathFollowerConfig, vehicle: Vehicle, above: float, least: float, deepest: float = 0.0
) -> AltitudeHold:
    """Return the mode that holds an altitude.

    Args:
        config: filter of the bottom, and the response to a lost echo.
        vehicle: for its range of depth.
        above, least: requested and least altitude, m.
        deepest: of the mission, m; 0 for the vehicle's own largest depth.
    """
    c, depth = config.vertical.altitude, vehicle.depth
    bound = min(deepest, depth.max) if deepest > 0.0 else depth.max
    tracker = (c.bandwidth, c.damping, c.patience, c.largest_drop)
    values = (above, least, depth.surface, bound, *tracker)
    return AltitudeHold(*map(float, values))


def mode_of(mission: Mission, config: PathFollowerConfig, limits: LimitsConfig, vehicle: Vehicle) -> Any:
    """Return what the vertical plane follows in a mission.

    Args:
        mission: with or without an altitude.
        config: of guidance.
        limits: of the parameters, for the largest depth.
        vehicle: for its range of depth.
    """
    altitude = mission.altitude
    if altitude is None:
        return FOLLOW_PATH
    bounds = limits.stricter(mission.limits)
    least = max(altitude.min, bounds.min_altitude)
    return altitude_hold(config, vehicle, altitude.above_bottom, least, bounds.max_depth)
