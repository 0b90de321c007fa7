"""The path of a mission in three dimensions: its route with a depth, a profile, or depths of its own."""

from __future__ import annotations

import math
from collections.abc import Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves.kinds.reverse import reversed_path
from auv_path_following.curves.segment import Segment
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import LENGTH_TOLERANCE, SpatialPath
from auv_path_following.curves.spatial.spatial_segment import Lifted, SpatialSegment
from auv_path_following.curves.spatial.spatial_spline import SpatialSpline
from auv_path_following.missions.depth_keys import DepthProfileSpec
from auv_path_following.missions.routes.route import Route
from auv_path_following.missions.site import within

#: Largest difference of the depths at which a repeated path starts and ends, m.
_SAME_DEPTH = 1e-3
#: Keys of which a mission may have one.
ONE_DEPTH = "one of depth, depth_profile, altitude, points with a depth, leg_depths and helix"


def spatial_path(
    route: Route, depth: float | None, profile: DepthProfileSpec | None, reverse: bool, repeat: int
) -> SpatialPath | None:
    """Return the path of a mission in three dimensions; None for a planar one.

    Args:
        route: once and forwards.
        depth: constant depth, m.
        profile: depth over the horizontal length of the route.
        reverse: whether the route is followed from its end to its start.
        repeat: number of times.

    Raises:
        ConfigurationError: several depths are given, or the profile does not fit the route.
    """
    given = _given(route, depth, profile)
    if given is not None:
        fitting = _fitting(given, route.segments)
        if reverse:
            once = SpatialPath(reversed_path(route.segments), fitting.reversed())
        else:
            once = SpatialPath(route.segments, fitting)
    elif route.subpaths:
        once = SpatialPath(
            [one.reversed() for one in reversed(route.subpaths)] if reverse else route.subpaths
        )
    else:
        return None
    if repeat == 1:
        return once
    start, end = once.evaluate(0, 0.0).z, once.evaluate(once.n - 1, 1.0).z
    if abs(start - end) > _SAME_DEPTH:
        found = f"{repeat} for a path that starts at a depth of {start:g} m and ends at {end:g} m"
        raise ConfigurationError("repeat", found, "1, or a path that ends at the depth of its start")
    return SpatialPath(once.subpaths * repeat)


def _given(route: Route, depth: float | None, profile: DepthProfileSpec | None) -> DepthProfile | None:
    """Return the one profile that is given; None without one.

    Raises:
        ConfigurationError: several depths are given.
    """
    sources = {
        "depth": depth is not None,
        "depth_profile": profile is not None,
        route.depth_key: route.profile is not None or bool(route.subpaths),
    }
    names = [name for name, is_given in sources.items() if is_given]
    if len(names) > 1:
        raise ConfigurationError(names[0], " and ".join(names), ONE_DEPTH)
    if depth is not None:
        return DepthProfile.constant(depth, math.fsum(segment.length for segment in route.segments))
    if profile is not None:
        with within("depth_profile"):
            return profile.build()
    return route.profile


def _fitting(profile: DepthProfile, segments: Sequence[Segment]) -> DepthProfile:
    """Return a profile that ends exactly where the route does.

    A last knot within `LENGTH_TOLERANCE` of the end is moved there; `SpatialPath` refuses any other.
    """
    length = math.fsum(segment.length for segment in segments)
    *knots, last = profile.knots
    if abs(last.way - length) <= LENGTH_TOLERANCE and length > knots[-1].way:
        return DepthProfile([*knots, (length, last.depth)], profile.kind)
    return profile


def with_depths(segments: Sequence[Segment | SpatialSpline]) -> tuple[SpatialSegment, ...]:
    """Return the subpaths of a list of segments that has splines with depth; empty if it has none.

    Every other segment is level: at the depth where the spline before it ends, or the first one begins.
    """
    splines = [segment for segment in segments if isinstance(segment, SpatialSpline)]
    if not splines:
        return ()
    depth = splines[0].points[0][2]
    subpaths: list[SpatialSegment] = []
    for segment in segments:
        if isinstance(segment, SpatialSpline):
            subpaths.append(segment)
            depth = segment.points[-1][2]
        else:
            subpaths.append(Lifted(segment, DepthProfile.constant(depth, segment.length), 0, 0.0))
    return tuple(subpaths)
