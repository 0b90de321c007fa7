"""A vehicle on the wire, planar or with stern planes: how its messages are read, and what it is sent."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from auv_msgs_py.contract import conversions, spatial_conversions, topics
from auv_msgs_py.contract.frames import flip_yaw
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.values.types import (
    NO_CURRENT,
    NO_SPATIAL_CURRENT,
)
from auv_path_following.vehicle import Vehicle


class Inputs(NamedTuple):
    """Input of one step. `water` is None where no fresh value is known; `dt` in s, `stamp` in ns.

    `water_age`, `current_age`: s; before the first message, time since the first odometry.
    `moved`: whether this navigation does not continue the last one.
    `altitude`: range to the bottom along body z, m; NaN where no fresh one is known.
    """

    navigation: Any
    water: Any | None
    water_age: float
    current: Any
    current_age: float
    dt: float
    stamp: int
    moved: bool
    altitude: float = math.nan


class Readings(NamedTuple):
    """Conversions of one kind of vehicle.

    Attributes:
        navigation, water: (message, frame table, topic) -> value.
        current: (message, topic) -> value.
        no_current: placeholder for a current that is not known.
        commands: topics, in the order of a command's fields.
        references: topics of guidance's results.
        sent: (result of guidance, desired thrust in N) -> values on the wire, in the order of `references`.
    """

    navigation: Callable[..., Any]
    water: Callable[..., Any]
    current: Callable[..., Any]
    no_current: Any
    commands: tuple[Topic, ...]
    references: tuple[Topic, ...]
    sent: Callable[[Any, float], tuple[float, ...]]


def _sent(output: Any, thrust: float) -> tuple[float, ...]:
    return flip_yaw(output.psi_d), -output.r_d, thrust, output.s


def _spatially_sent(output: Any, thrust: float) -> tuple[float, ...]:
    return (
        flip_yaw(output.psi_d), -output.r_d, -output.theta_d, -output.q_d, output.depth, thrust, output.s,
    )  # fmt: skip


PLANAR = Readings(
    conversions.navigation_from,
    conversions.water_velocity_from,
    conversions.current_from,
    NO_CURRENT,
    (topics.RUDDER_CMD, topics.THRUST_CMD),
    (topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_THRUST, topics.PATH_PARAMETER),
    _sent,
)
SPATIAL = Readings(
    spatial_conversions.spatial_navigation_from,
    spatial_conversions.spatial_water_from,
    spatial_conversions.spatial_current_from,
    NO_SPATIAL_CURRENT,
    (topics.RUDDER_CMD, topics.STERNPLANE_CMD, topics.THRUST_CMD),
    (
        topics.DESIRED_YAW, topics.DESIRED_YAW_RATE, topics.DESIRED_PITCH, topics.DESIRED_PITCH_RATE,
        topics.DESIRED_DEPTH, topics.DESIRED_THRUST, topics.PATH_PARAMETER,
    ),
    _spatially_sent,
)  # fmt: skip


def readings_of(vehicle: Vehicle) -> Readings:
    """Return how to read a vehicle."""
    return SPATIAL if vehicle.dives else PLANAR
