"""Faults of the content of one message: numbers, stamp, frame, and the depth of an odometry."""

from __future__ import annotations

import math
from typing import Any

from auv_sim.sim_parameters import Fault

#: Share of a number that the fault weak leaves.
WEAK = 0.1
#: Depth that the fault depth_jump adds, m.
DEPTH_JUMP = 30.0
#: Roll that the fault rolled adds, rad.
ROLL = math.radians(75.0)
#: Faults of an odometry with depth; any other message passes unchanged.
DEPTH_FAULTS: tuple[Fault, ...] = (
    "depth_nan", "depth_freeze", "depth_jump", "depth_turn", "planar", "rolled",
)  # fmt: skip


def changed(fault: Fault, message: Any, last: Any | None, jump: float) -> Any:
    """Return what a fault makes of a message; the message is changed.

    Args:
        fault: of the content; any other changes nothing.
        message: the message.
        last: the last good one; None where there is none.
        jump: of the fault jump, in the unit of the topic.
    """
    match fault:
        case "freeze" if last is not None:
            if hasattr(last, "header"):
                last.header.stamp = message.header.stamp
            return last
        case "frameless" if hasattr(message, "header"):
            message.header.frame_id = ""
        case "timeless" if hasattr(message, "header"):
            message.header.stamp.nanosec = 2**32 - 1
        case "nan":
            _set_first_number(message, lambda _: math.nan)
        case "jump":
            _set_first_number(message, lambda value: value + jump)
        case "weak":
            _set_first_number(message, lambda value: WEAK * value)
        case _ if fault in DEPTH_FAULTS and hasattr(message, "child_frame_id"):
            _change_depth(fault, message.pose.pose, last)
    return message


def _change_depth(fault: Fault, pose: Any, last: Any | None) -> None:
    """Apply a fault of the depth to the pose of an odometry."""
    place = pose.position
    match fault:
        case "depth_nan":
            place.z = math.nan
        case "depth_freeze" if last is not None:
            place.z = last.pose.pose.position.z
        case "depth_jump":
            place.z -= DEPTH_JUMP
        case "depth_turn":
            place.z = -place.z
        case "planar":
            place.z = 0.0
            _levelled(pose.orientation)
        case "rolled":
            _rolled(pose.orientation)


def _rolled(q: Any) -> None:
    """Turn an orientation about the body's x axis."""
    c, s = math.cos(0.5 * ROLL), math.sin(0.5 * ROLL)
    q.w, q.x, q.y, q.z = c * q.w - s * q.x, c * q.x + s * q.w, c * q.y + s * q.z, c * q.z - s * q.y


def _levelled(q: Any) -> None:
    """Leave only the heading of an orientation."""
    size = math.hypot(q.w, q.z)
    q.w, q.x, q.y, q.z = q.w / size, 0.0, 0.0, q.z / size


def _set_first_number(message: Any, change: Any) -> None:
    """Change x of a position or velocity, or the number of a Float64; replace a text."""
    place = message
    for name in ("pose", "pose", "position"):
        place = getattr(place, name, place)
    for name in ("twist", "twist", "linear") if place is message else ():
        place = getattr(place, name, place)
    place = getattr(place, "vector", place)
    if hasattr(place, "radiation_type"):
        place.range = change(place.range)
    elif hasattr(place, "data"):
        place.data = "nan" if isinstance(place.data, str) else change(place.data)
    else:
        place.x = change(place.x)
