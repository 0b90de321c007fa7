"""Transforms of a vehicle for /tf: from `map` (ENU) to `base_link` (FLU), whatever its odometry uses."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import Odometry

from auv_msgs_py.contract.frames import Convention, FrameTable, swap_axes
from auv_msgs_py.contract.topics import ODOM
from auv_msgs_py.values.attitude import turned_over
from auv_path_following.vehicle import Vehicle
from auv_sim.nodes.display.markers import Place
from auv_sim.nodes.display.robot_model import fins_of, hinge_of


def pose_of(message: Odometry, frames: FrameTable) -> tuple[Place, Quaternion]:
    """Return place (ENU, m) and attitude (FLU in ENU) of an odometry.

    Raises:
        MessageRefused: unknown frames.
    """
    convention = frames.of_pose(ODOM.name, message.header.frame_id, message.child_frame_id)
    place, q = message.pose.pose.position, message.pose.pose.orientation
    if convention is Convention.ENU_FLU:
        return (place.x, place.y, place.z), q
    w, x, y, z = turned_over(q.w, q.x, q.y, q.z)
    east, north = swap_axes(place.x, place.y)
    return (east, north, -place.z), Quaternion(w=w, x=x, y=y, z=z)


def transform(parent: str, child: str, stamp: Any, place: Place, attitude: Quaternion) -> TransformStamped:
    """Return a transform."""
    made = TransformStamped(child_frame_id=child)
    made.header.frame_id = parent
    if stamp is not None:
        made.header.stamp = stamp
    shift = made.transform.translation
    shift.x, shift.y, shift.z = place
    made.transform.rotation = attitude
    return made


def fixed_transforms(prefix: str) -> list[TransformStamped]:
    """Return base_link -> base_link_frd: half a turn about x.

    Args:
        prefix: of the vehicle's frames, such as ``auv1/``.
    """
    half_turn = Quaternion(w=0.0, x=1.0, y=0.0, z=0.0)
    return [transform(f"{prefix}base_link", f"{prefix}base_link_frd", None, (0.0, 0.0, 0.0), half_turn)]


def moving_transforms(
    stamp: Any, place: Place, attitude: Quaternion, vehicle: Vehicle, angles: Mapping[str, float], prefix: str
) -> list[TransformStamped]:
    """Return map -> base_link and those of the fins.

    Args:
        stamp: of the odometry.
        place, attitude: of the vehicle, as `pose_of` returns them.
        vehicle: with its fins.
        angles: joint -> angle, rad.
        prefix: of the vehicle's frames.
    """
    made = [transform("map", f"{prefix}base_link", stamp, place, attitude)]
    for fin in fins_of(vehicle):
        half = 0.5 * angles.get(fin.joint, 0.0)
        x, y, z = (math.sin(half) * component for component in fin.axis)
        turn = Quaternion(w=math.cos(half), x=x, y=y, z=z)
        hinge = (hinge_of(vehicle), 0.0, 0.0)
        made.append(transform(f"{prefix}base_link", prefix + fin.link, stamp, hinge, turn))
    return made
