"""Markers of a mission, in frame `map` (ENU)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

from geometry_msgs.msg import Point, Quaternion
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

#: A point in `map`: east, north, up, m.
Place = tuple[float, float, float]
#: Length of the current's arrow, s of drift.
_DRIFT = 20.0
_COLOURS = {
    "path": (0.1, 0.4, 0.9), "joints": (0.1, 0.4, 0.9), "geofence": (0.85, 0.1, 0.1),
    "vehicle": (0.95, 0.75, 0.1), "current": (0.1, 0.7, 0.6), "virtual_point": (0.9, 0.5, 0.1),
    "errors": (0.2, 0.2, 0.2),
}  # fmt: skip


def marker(name: str, kind: int, size: Sequence[float], stamp: Any = None) -> Marker:
    """Return a marker without a shape yet.

    Args:
        name: its namespace, which RViz lists and switches.
        kind: `Marker.LINE_STRIP` and so on.
        size: its scale, m; missing components are 0.
        stamp: of the data; None for what does not move.
    """
    made = Marker(ns=name, type=kind, action=Marker.ADD)
    made.header.frame_id = "map"
    if stamp is not None:
        made.header.stamp = stamp
    made.pose.orientation.w = 1.0
    made.scale.x, made.scale.y, made.scale.z = (*size, 0.0, 0.0)[:3]
    red, green, blue = _COLOURS[name]
    made.color = ColorRGBA(r=red, g=green, b=blue, a=1.0)
    return made


def points(places: Iterable[Place]) -> list[Point]:
    """Return places as messages."""
    return [Point(x=x, y=y, z=z) for x, y, z in places]


def mission_markers(path: Sequence[Place], joints: Sequence[Place], fence: Sequence[Place]) -> list[Marker]:
    """Return the markers that do not move; those without content are deleted.

    Args:
        path: its points.
        joints: ends of its subpaths.
        fence: corners of the geofence; drawn at the surface and at the path's greatest depth.
    """
    line = marker("path", Marker.LINE_STRIP, (0.3,))
    line.points = points(path)
    balls = marker("joints", Marker.SPHERE_LIST, (1.5, 1.5, 1.5))
    balls.points = points(joints)
    border = marker("geofence", Marker.LINE_LIST, (0.4,))
    deepest = min((up for _, _, up in path), default=0.0)
    for level in sorted({0.0, deepest}):
        for (x0, y0, _), (x1, y1, _) in zip(fence, [*fence[1:], *fence[:1]], strict=True):
            border.points += points([(x0, y0, level), (x1, y1, level)])
    for each in (line, balls, border):
        if not each.points:
            each.action = Marker.DELETE
    return [line, balls, border]


def vehicle_marker(place: Place, attitude: Quaternion, length: float, diameter: float, stamp: Any) -> Marker:
    """Return the hull as a cylinder along the vehicle's x axis.

    Args:
        place: of the vehicle.
        attitude: of FLU in ENU.
        length, diameter: of the hull, m.
        stamp: of the odometry.
    """
    made = marker("vehicle", Marker.CYLINDER, (diameter, diameter, length), stamp)
    made.pose.position = points([place])[0]
    # A cylinder stands along z: turn it a quarter about y first.
    h, q = math.sqrt(0.5), attitude
    made.pose.orientation = Quaternion(
        w=h * (q.w - q.y), x=h * (q.x - q.z), y=h * (q.y + q.w), z=h * (q.z + q.x)
    )
    return made


def current_marker(place: Place, current: Place, stamp: Any) -> Marker:
    """Return an arrow from the vehicle to where the current (m/s, ENU) carries it in 20 s."""
    made = marker("current", Marker.ARROW, (0.4, 1.2, 1.5), stamp)
    end = tuple(a + _DRIFT * v for a, v in zip(place, current, strict=True))
    made.points = points([place, (end[0], end[1], end[2])])
    return made


def virtual_point_marker(place: Place, virtual: Place, stamp: Any) -> Marker:
    """Return the line from the vehicle to the virtual point."""
    made = marker("virtual_point", Marker.LINE_LIST, (0.2,), stamp)
    made.points = points([place, virtual])
    return made


def error_marker(place: Place, state: str, errors: Sequence[float], stamp: Any) -> Marker:
    """Return the state and the errors as text above the vehicle.

    Args:
        place: of the vehicle.
        state: of the mission.
        errors: ye, and ze of a vehicle that dives, m; ze is positive below the path.
        stamp: of the odometry.
    """
    made = marker("errors", Marker.TEXT_VIEW_FACING, (0.0, 0.0, 2.0), stamp)
    made.pose.position = points([(place[0], place[1], place[2] + 4.0)])[0]
    parts = [f"{name} {value:+.2f} m" for name, value in zip(("ye", "ze"), errors, strict=False)]
    made.text = "  ".join(part for part in (state, *parts) if part)
    return made
