"""Degrees to metres and back: the plane that touches the WGS 84 ellipsoid at an origin."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pymap3d

from auv_msgs_py.settings.schema import setting, settings

Array = npt.NDArray[np.float64]

#: Largest distance of a point from the origin, m; there the plane is 4 m off along 100 km.
FARTHEST = 100e3


@settings
class Origin:
    """Position of north 0, east 0; the vehicle's navigation has to use the same one."""

    latitude_deg: float = setting(doc="latitude, WGS 84, north positive", unit="deg", gt=-89.9, lt=89.9)
    longitude_deg: float = setting(doc="longitude, WGS 84, east positive", unit="deg", ge=-180.0, le=180.0)


def to_ned(origin: Origin, latitude: Any, longitude: Any) -> tuple[Array, Array]:
    """Return north and east (m) of points at sea level.

    Args:
        origin: of the plane.
        latitude, longitude: shape (n,), deg.
    """
    at = origin.latitude_deg, origin.longitude_deg
    north, east, _ = pymap3d.geodetic2ned(
        np.asarray(latitude, float), np.asarray(longitude, float), 0.0, *at, 0.0
    )
    return north, east


def to_geodetic(origin: Origin, north: Any, east: Any) -> tuple[Array, Array]:
    """Return latitude and longitude (deg) of the points at sea level at north, east; inverse of `to_ned`.

    Args:
        origin: of the plane.
        north, east: shape (n,), m.
    """
    at = origin.latitude_deg, origin.longitude_deg
    north, east = np.asarray(north, float), np.asarray(east, float)
    down = np.zeros_like(north)
    for _ in range(4):  # the plane is above the sea: go down until the height is 0
        latitude, longitude, height = pymap3d.ned2geodetic(north, east, down, *at, 0.0)
        down = down + height
    return latitude, longitude
