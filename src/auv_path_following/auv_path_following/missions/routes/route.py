"""What a route of a mission file is made into."""

from __future__ import annotations

from typing import NamedTuple

from auv_msgs_py.settings.schema import Pair
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_segment import SpatialSegment


class Route(NamedTuple):
    """A route, once and forwards.

    Attributes:
        segments: its subpaths in the plane.
        waypoints: that they were made from, (north, east), m.
        area: that they survey: its corners, (north, east), m.
        profile: depth over its horizontal length, where the route itself has depths.
        subpaths: in three dimensions, where they have depths of their own.
        depth_key: the key of the mission file that gives these depths.
    """

    segments: list[Segment]
    waypoints: list[Pair]
    area: tuple[Pair, ...] = ()
    profile: DepthProfile | None = None
    subpaths: tuple[SpatialSegment, ...] = ()
    depth_key: str = ""
