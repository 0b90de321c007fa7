"""How a node reads its vehicle: as one in the plane, or as one with stern planes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from auv_msgs_py.contract import conversions, spatial_conversions
from auv_msgs_py.values.attitude import level_of
from auv_msgs_py.values.types import (
    NO_CURRENT,
    NO_SPATIAL_CURRENT,
    NO_SPATIAL_WATER,
    NO_WATER,
    Navigation,
)
from auv_path_following.vehicle import Vehicle


class Readings(NamedTuple):
    """Conversions of one kind of vehicle.

    Attributes:
        navigation, water: (message, frame table, topic) -> value.
        current: (message, topic) -> value.
        level: navigation -> place and heading, NED, for checks that are planar.
        no_water, no_current: placeholders for values that are not known.
    """

    navigation: Callable[..., Any]
    water: Callable[..., Any]
    current: Callable[..., Any]
    level: Callable[[Any], Navigation]
    no_water: Any
    no_current: Any


def _itself(navigation: Navigation) -> Navigation:
    return navigation


PLANAR = Readings(
    conversions.navigation_from,
    conversions.water_velocity_from,
    conversions.current_from,
    _itself,
    NO_WATER,
    NO_CURRENT,
)
SPATIAL = Readings(
    spatial_conversions.spatial_navigation_from,
    spatial_conversions.spatial_water_from,
    spatial_conversions.spatial_current_from,
    level_of,
    NO_SPATIAL_WATER,
    NO_SPATIAL_CURRENT,
)


def readings_of(vehicle: Vehicle) -> Readings:
    """Return how to read a vehicle."""
    return SPATIAL if vehicle.dives else PLANAR
