"""DISTANCE_SENSOR to and from a range to the bottom, as REP-117 has it. ROS-free."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

#: `signal_quality` of a sensor that received no usable echo.
_NO_ECHO = 1
#: `covariance` of a sensor with an unknown variance.
_UNKNOWN = 255
#: Nearest and farthest bottom of the emulated altimeter, m.
NEAREST, FARTHEST = 0.3, 50.0


class Sounding(NamedTuple):
    """A range to the bottom along body z, m, and the least and largest range that the sensor measures.

    The range is infinite without an echo, and minus infinite where the bottom is too close.
    """

    range: float
    nearest: float
    farthest: float


def sounding_of(message: Any) -> Sounding | None:
    """Return the range of a DISTANCE_SENSOR; None for a sensor that does not look down."""
    if message.orientation != mavlink.MAV_SENSOR_ROTATION_PITCH_270:
        return None
    found, nearest, farthest = (
        0.01 * value for value in (message.current_distance, message.min_distance, message.max_distance)
    )
    if message.signal_quality == _NO_ECHO or found >= farthest > 0.0:
        return Sounding(math.inf, nearest, farthest)
    return Sounding(-math.inf if found < nearest else found, nearest, farthest)


def distance_sensor(boot_ms: int, distance: float) -> Any:
    """Return the DISTANCE_SENSOR of an echo sounder that looks down.

    Args:
        boot_ms: time since boot, ms.
        distance: to the bottom, m.
    """
    nearest, farthest = round(100.0 * NEAREST), round(100.0 * FARTHEST)
    found = round(100.0 * min(max(distance, 0.0), FARTHEST))
    return mavlink.MAVLink_distance_sensor_message(
        boot_ms, nearest, farthest, found, mavlink.MAV_DISTANCE_SENSOR_ULTRASOUND, 0,
        mavlink.MAV_SENSOR_ROTATION_PITCH_270, _UNKNOWN,
    )  # fmt: skip
