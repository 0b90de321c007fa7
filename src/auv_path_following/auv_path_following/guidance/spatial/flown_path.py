"""The path that a vehicle with stern planes flies: within its range of depth, and fast enough."""

from __future__ import annotations

import math

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.vehicle import Vehicle


def flown_path(
    path: CompositePath, spatial: SpatialPath | None, vehicle: Vehicle, thrust: float
) -> SpatialPath:
    """Return the path in three dimensions; a planar one at the vehicle's surface depth.

    Args:
        path: the plan.
        spatial: the path, where it has depths.
        vehicle: with stern planes.
        thrust: of the mission, N.

    Raises:
        ConfigurationError: the path leaves the vehicle's range of depth, or the thrust is too low for it.
    """
    if spatial is None:
        length = math.fsum(segment.length for segment in path.segments)
        spatial = SpatialPath(path.segments, DepthProfile.constant(vehicle.depth.surface, length))
    check_range(spatial, vehicle, thrust)
    return spatial


def check_range(spatial: SpatialPath, vehicle: Vehicle, thrust: float) -> None:
    """Check that a vehicle can hold the depths of a path.

    Raises:
        ConfigurationError: the path leaves the vehicle's range of depth, or the thrust is too low for it.
    """
    allowed = vehicle.depth
    for number, (way, depth) in enumerate(spatial.knots):
        least = 0.0 if number in (0, len(spatial.knots) - 1) else allowed.surface
        if not least <= depth <= allowed.max:
            found, expected = f"{depth:g} m at {way:g} m of path", f"{least:g} to {allowed.max:g} m"
            raise ConfigurationError(f"{vehicle.name}: depth_profile.knots[{number}]", found, expected)
    speed = vehicle.speed_at(thrust)
    if speed < allowed.minimum_speed:
        found = f"{thrust:g} N, {speed:.2f} m/s"
        expected = f"at least {allowed.minimum_speed:g} m/s, below which the planes hold no depth"
        raise ConfigurationError(f"{vehicle.name}: thrust", found, expected)
