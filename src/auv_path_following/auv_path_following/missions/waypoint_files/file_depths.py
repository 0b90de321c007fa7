"""Depths of waypoints, positive down: which third coordinates are depths, and which are refused."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import DEEPEST
from auv_path_following.missions.waypoint_files.content import FileShape, Point, extent

#: Consecutive points within this distance are one point, m.
_SAME = 1e-3
_IGNORE = "`depths: ignore`"


def check_depths(depths: Sequence[float], place: Callable[[int], str]) -> None:
    """Refuse depths of some points only, above the surface, or below `DEEPEST`.

    Args:
        depths: m, positive down; NaN where a point has none.
        place: of a point by its index.

    Raises:
        ConfigurationError: names the point.
    """
    missing = [math.isnan(depth) for depth in depths]
    first = missing.index(False)
    for k, depth in enumerate(depths):
        if missing[k]:
            expected = f"one: {place(first)} has a depth (give all points one, or none)"
            raise ConfigurationError(place(k), "no depth", expected)
        if not 0.0 <= depth <= DEEPEST:
            expected = f"0 to {DEEPEST:g} m: depths are positive down ({_IGNORE} leaves them out)"
            raise ConfigurationError(place(k), f"a depth of {depth:g} m", expected)


def kept(
    points: Sequence[Point],
    depths: Sequence[float] | None,
    place: Callable[[int], str] = lambda k: f"point {k + 1}",
) -> list[int]:
    """Return the indices of the points that are not at the place of the one before.

    Args:
        points: (north, east), m.
        depths: of the points, m; None for a planar path.
        place: of a point by its index.

    Raises:
        ConfigurationError: a point is above or below the one before.
    """
    indices = []
    for k, at in enumerate(points):
        if k == 0 or math.dist(at, points[k - 1]) > _SAME:
            indices.append(k)
        elif depths is not None and abs(depths[k] - depths[k - 1]) > _SAME:
            found = f"a vertical leg, from {depths[k - 1]:g} to {depths[k]:g} m"
            raise ConfigurationError(place(k), found, "a point at another place, or a helix")
    return indices


def depths_of(shapes: Sequence[FileShape], ignored: str = "") -> tuple[list[float] | None, str]:
    """Return the depths of the points of shapes, and a notice of third coordinates that are not taken.

    An altitude below 0 is a depth. A file whose altitudes are all 0 or above is planar, as is a table whose
    depths are all 0.

    Args:
        shapes: whose points are taken.
        ignored: why third coordinates do not count, for the notice; empty where they do.

    Returns:
        A depth for each point (m, positive down), None for a planar path; and the notice, empty without one.

    Raises:
        ConfigurationError: some points only have a depth, or its reference is not the surface.
    """
    heights = [height for shape in shapes for height in shape.heights or (math.nan,) * len(shape.points)]
    span = extent(heights)
    if span is None:
        return None, ""
    is_depth = any(shape.is_down for shape in shapes)
    what = "depths" if is_depth else "altitudes"
    named = (
        f"{what} ({f'{span[0]:g} m' if span[0] == span[1] else f'{span[0]:g} to {span[1]:g} m'}) not taken"
    )
    if ignored:
        return None, f"{named}: {ignored}"
    if not is_depth and span[0] >= 0.0:
        return None, f"{named}: only those below 0 are depths"
    unclear = next((shape.reference for shape in shapes if shape.reference), "")
    if unclear:
        expected = f"altitudes above the sea, or {_IGNORE}"
        raise ConfigurationError("", f"altitudes below 0 {unclear}", expected)
    depths = heights if is_depth else [0.0 - height for height in heights]
    check_depths(depths, lambda k: f"point {k + 1}")
    return depths, ""
