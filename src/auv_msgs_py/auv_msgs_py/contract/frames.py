"""The only place where frames are converted and frame ids interpreted. ROS-free.

On the wire: ENU world and FLU body (REP-103), or NED and FRD if the message's frame ids say so.
Inside the suite: NED and FRD, psi clockwise from north. The functions work on numbers and arrays.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Sequence
from typing import Any

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.elementary import functions_of
from auv_msgs_py.values.errors import MessageRefused
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Navigation


def swap_axes(x: Any, y: Any) -> tuple[Any, Any]:
    """(east, north) -> (north, east) and back: positions and velocities of the world frame."""
    return y, x


@pure
def flip_yaw(yaw: Any) -> Any:
    """yaw_enu (0 at east, counter-clockwise) -> psi (0 at north, clockwise) and back, rad."""
    return math.pi / 2.0 - yaw


def yaw_of_quaternion(x: Any, y: Any, z: Any, w: Any) -> Any:
    """Rotation about the world's z axis, rad, of a unit quaternion (any roll and pitch)."""
    return functions_of(w).atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


@pure
def quaternion_of_yaw(yaw: float) -> tuple[float, float]:
    """(z, w) of the unit quaternion that turns about z by `yaw`; x and y are 0."""
    return math.sin(0.5 * yaw), math.cos(0.5 * yaw)


@pure
def heading_over_the_wire(psi: float) -> float:
    """Return a heading as an odometry carries it: equal but for its last bits."""
    z, w = quaternion_of_yaw(flip_yaw(psi))
    # As `yaw_of_quaternion`, which serves arrays too and therefore does not compile.
    yaw: float = flip_yaw(math.atan2(2.0 * (w * z), 1.0 - 2.0 * (z * z)))
    return yaw


@pure
def navigation_over_the_wire(navigation: Navigation) -> Navigation:
    """Return a navigation as an odometry carries it; see `heading_over_the_wire`."""
    x, y, psi, r = navigation
    return Navigation(x, y, heading_over_the_wire(psi), r)


#: Signs of (x, y, z, roll, pitch, yaw) of a pose, and of a twist in the body, between NED/FRD and ENU/FLU.
_POSE_SIGNS, _TWIST_SIGNS = (1.0, 1.0, -1.0, 1.0, -1.0, -1.0), (1.0, -1.0, -1.0, 1.0, -1.0, -1.0)
#: Order of the parameters of a pose in the other convention: x and y change places.
_POSE_ORDER = (1, 0, 2, 3, 4, 5)


def turn_pose_covariance(covariance: Sequence[float]) -> tuple[float, ...]:
    """Return a row-major 6 x 6 covariance of a pose in NED/FRD as one in ENU/FLU, or the other way round."""
    places = tuple(zip(_POSE_ORDER, _POSE_SIGNS, strict=True))
    return tuple(a * b * covariance[6 * i + j] for i, a in places for j, b in places)


def turn_twist_covariance(covariance: Sequence[float]) -> tuple[float, ...]:
    """Return a row-major 6 x 6 covariance of a twist in FRD as one in FLU, or the other way round."""
    signs = [a * b for a in _TWIST_SIGNS for b in _TWIST_SIGNS]
    return tuple(sign * value for sign, value in zip(signs, covariance, strict=True))


class Convention(enum.Enum):
    """Direction of the axes of a pair of world and body frames."""

    ENU_FLU = "ENU/FLU"
    NED_FRD = "NED/FRD"


@settings
class FrameIds:
    """Accepted frame ids; the name alone decides on the convention."""

    enu_world: list[str] = setting(factory=lambda: ["map", "odom"], doc="world frames that are ENU")
    ned_world: list[str] = setting(factory=lambda: ["map_ned", "odom_ned"], doc="world frames that are NED")
    flu_body: list[str] = setting(factory=lambda: ["base_link"], doc="body frames that are FLU")
    frd_body: list[str] = setting(
        factory=lambda: ["base_link_frd", "base_link_fsd"], doc="body frames that are FRD, or FSD by REP-156"
    )


def is_ned(world_frame: str) -> bool:
    """Return whether a world frame of the simulator is NED, by its name."""
    return world_frame.endswith("_ned")


def is_frd(body_frame: str) -> bool:
    """Return whether a body frame of the simulator is FRD (FSD in REP-156), by its name."""
    return body_frame.endswith(("_frd", "_fsd"))


#: Most cached ids: a publisher with a new prefix in each message must not fill the memory.
_CACHED = 64


class FrameTable:
    """Resolve frame ids; accepted ids are cached, so that a lookup is one dictionary access.

    Args:
        ids: the accepted names.
    """

    def __init__(self, ids: FrameIds) -> None:
        self._world = dict.fromkeys(ids.enu_world, Convention.ENU_FLU)
        self._world |= dict.fromkeys(ids.ned_world, Convention.NED_FRD)
        self._body = dict.fromkeys(ids.flu_body, Convention.ENU_FLU)
        self._body |= dict.fromkeys(ids.frd_body, Convention.NED_FRD)
        self._known: dict[tuple[str, str], Convention] = {}
        self._known_body: dict[str, Convention] = {}

    def of_pose(self, topic: str, world: str, body: str) -> Convention:
        """Return the convention of an odometry.

        Raises:
            MessageRefused: an unknown frame id, or a pair of different conventions; names both.
        """
        known = self._known.get((world, body))
        if known is not None:
            return known
        of_world, of_body = self._world.get(_bare(world)), self._body.get(_bare(body))
        if of_world is None or of_body is None or of_world is not of_body:
            raise MessageRefused(
                topic,
                f"frame_id '{world}' with child_frame_id '{body}'",
                f"a pair of {_names(self._world, self._body, Convention.ENU_FLU)} (ENU/FLU)"
                f" or of {_names(self._world, self._body, Convention.NED_FRD)} (NED/FRD)",
            )
        if len(self._known) < _CACHED:
            self._known[world, body] = of_world
        return of_world

    def of_body(self, topic: str, body: str) -> Convention:
        """Return the convention of a body-frame message.

        Raises:
            MessageRefused: an unknown frame id.
        """
        known = self._known_body.get(body)
        if known is not None:
            return known
        convention = self._body.get(_bare(body))
        if convention is None:
            raise MessageRefused(topic, f"frame_id '{body}'", f"one of {', '.join(self._body)}")
        if len(self._known_body) < _CACHED:
            self._known_body[body] = convention
        return convention


def _bare(name: str) -> str:
    """`/auv1/base_link` -> ``base_link``."""
    return name.rsplit("/", 1)[-1]


def _names(world: dict[str, Convention], body: dict[str, Convention], which: Convention) -> str:
    return " and ".join(
        "/".join(name for name, convention in table.items() if convention is which) for table in (world, body)
    )
