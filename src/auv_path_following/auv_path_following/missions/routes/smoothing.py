"""Waypoints to subpaths: the five kinds of composite path of Table 1, and a spline."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from typing import Literal, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves import dubins
from auv_path_following.curves.dubins import PlanarPose
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.kinds.spline import Spline
from auv_path_following.curves.segment import Segment
from auv_path_following.missions.routes.corner_shapes import SHAPES, WaypointCorner

Point = tuple[float, float]

#: Gap allowed at the joints of what is built here, m.
TOLERANCE = 1e-9
#: Smallest change of course that is a corner, rad.
_STRAIGHT = 1e-9
#: Largest change of course that a curve can round, rad.
_BACK = math.pi - 1e-3

Kind = Literal["linear", "circular", "dubins", "clothoid", "fermat", "spline"]


@settings
class Smoothing:
    """How corners are rounded.

    circular, clothoid and fermat need a radius or a distance, dubins a radius, the others neither.
    """

    kind: Kind = setting(
        doc="linear G0, circular G1, dubins G1, clothoid G2, fermat G2, spline (through all points)"
    )
    radius: float | None = setting(None, "tightest radius of every corner", unit="m", gt=0.0)
    distance: float | None = setting(
        None, "instead of a radius: distance from a waypoint at which the legs end", unit="m", gt=0.0
    )
    start_course_deg: float | None = setting(
        None, "course at the first waypoint (dubins, spline)", unit="deg"
    )
    end_course_deg: float | None = setting(None, "course at the last waypoint (dubins, spline)", unit="deg")


class Smoothed(NamedTuple):
    """Subpaths along waypoints.

    Attributes:
        segments: that meet within `TOLERANCE`.
        ways: length of path (m) at which each waypoint is passed: of a rounded corner its middle. A closed
            path ends with its first waypoint again. Empty for a spline.
    """

    segments: list[Segment]
    ways: list[float]


def smooth(points: Sequence[Point], smoothing: Smoothing, closed: bool = False) -> list[Segment]:
    """Return the subpaths along waypoints: the segments of `smoothed`."""
    return smoothed(points, smoothing, closed).segments


def smoothed(points: Sequence[Point], smoothing: Smoothing, closed: bool = False) -> Smoothed:
    """Return the subpaths along waypoints, and the lengths of path at which these are passed.

    Args:
        points: waypoints (north, east), m.
        smoothing: shape of the corners.
        closed: whether to return from the last waypoint to the first, rounding every corner.

    Returns:
        The segments. Closed and rounded, they begin where the first waypoint's corner has been rounded
        (dubins and linear: at the first waypoint); that place counts as the waypoint's.

    Raises:
        ConfigurationError: too few points, two in one place, a corner that does not fit (which waypoint,
            and by how many metres), or keys that do not belong together.
    """
    _check_keys(smoothing, closed)
    way = [(float(x), float(y)) for x, y in points]
    if closed and len(way) > 1 and way[0] == way[-1]:
        way.pop()
    least = 3 if closed else 2
    if len(way) < least:
        raise ConfigurationError(
            "points", f"{len(way)} point(s)", f"at least {least}{' for a closed path' if closed else ''}"
        )
    legs = [_leg(way, i) for i in range(len(way) if closed else len(way) - 1)]
    if smoothing.kind == "spline":
        courses = end_courses(smoothing)
        return Smoothed([Spline(way, *courses)], [])
    if smoothing.kind == "dubins":
        return _dubins(way, legs, smoothing, closed)
    if smoothing.kind == "linear":
        lines: list[Segment] = [Line(*way[i], length, chi) for i, (length, chi) in enumerate(legs)]
        return Smoothed(lines, _added(length for length, _ in legs))
    return _rounded(way, legs, smoothing, closed)


def _check_keys(smoothing: Smoothing, closed: bool) -> None:
    kind, radius, distance = smoothing.kind, smoothing.radius, smoothing.distance
    if kind in SHAPES and (radius is None) == (distance is None):
        found = "neither radius nor distance" if radius is None else "both radius and distance"
        raise ConfigurationError("smoothing", found, f"one of them for {kind}")
    if kind == "dubins" and (radius is None or distance is not None):
        raise ConfigurationError(
            "smoothing", "no radius" if radius is None else "a distance", "a radius for dubins"
        )
    if kind in ("linear", "spline") and (radius is not None or distance is not None):
        raise ConfigurationError("smoothing", "a radius or distance", f"neither for {kind}")
    if kind == "spline" and closed:
        raise ConfigurationError("closed", "true", "false for spline, which has two ends")
    if any(course is not None for course in end_courses(smoothing)):
        if kind not in ("dubins", "spline"):
            found = "start_course_deg or end_course_deg"
            raise ConfigurationError("smoothing", found, "neither, they are for dubins and spline")
        if closed:
            raise ConfigurationError(
                "smoothing", "start_course_deg or end_course_deg", "neither for a closed path"
            )


def end_courses(smoothing: Smoothing) -> tuple[float | None, float | None]:
    """Return the courses at the first and the last waypoint, rad; None where none is given."""
    degrees = (smoothing.start_course_deg, smoothing.end_course_deg)
    first, last = (None if course is None else math.radians(course) for course in degrees)
    return first, last


def _leg(way: list[Point], i: int) -> tuple[float, float]:
    """Return length (m) and course (rad) of the leg from waypoint i to the next one."""
    j = (i + 1) % len(way)
    north, east = way[j][0] - way[i][0], way[j][1] - way[i][1]
    length = math.hypot(north, east)
    if length <= 1e-6:
        raise ConfigurationError(
            f"points[{j}]", f"the same place as points[{i}]", "a waypoint at another place"
        )
    return length, math.atan2(east, north)


def _corner(way: list[Point], legs: list[tuple[float, float]], i: int) -> WaypointCorner | None:
    """Return waypoint i with the legs before and after it; None when they are in line."""
    chi_in, chi_out = legs[i - 1][1], legs[i][1]
    turn = wrap(chi_out - chi_in)
    if abs(turn) < _STRAIGHT:
        return None
    if abs(turn) > _BACK:
        raise ConfigurationError(f"points[{i}]", "a turn straight back", "less than a half turn, or dubins")
    return WaypointCorner(*way[i], chi_in, chi_out, turn)


def _added(lengths: Iterable[float]) -> list[float]:
    """Return 0 and the sums of the first lengths, the first two and so on."""
    return list(itertools.accumulate(lengths, initial=0.0))


def _rounded(
    way: list[Point], legs: list[tuple[float, float]], smoothing: Smoothing, closed: bool
) -> Smoothed:
    shape, n = SHAPES[smoothing.kind], len(way)
    corners = {i: _corner(way, legs, i) for i in (range(n) if closed else range(1, n - 1))}
    distance = [0.0] * n
    for i, corner in corners.items():
        if corner is not None:
            radius = smoothing.radius
            distance[i] = (
                smoothing.distance if radius is None else radius * shape.reach(abs(corner.turn))
            ) or 0.0
    for i, (length, _) in enumerate(legs):
        _check_room(i, (i + 1) % n, length, distance, smoothing)
    segments: list[Segment] = []
    ways = [0.0]
    opening, done = 0, 0.0
    for i, (length, chi) in enumerate(legs):
        corner = corners.get(i)
        curve = shape.build(corner, distance[i]) if corner is not None else []
        segments += curve
        if i == 0:  # a closed path begins behind its first waypoint's corner, not inside it
            opening = len(segments)
        else:
            turning = math.fsum(part.length for part in curve)
            ways.append(done + 0.5 * turning)
            done += turning
        straight = length - distance[i] - distance[(i + 1) % n]
        if straight > TOLERANCE:
            x, y = way[i][0] + distance[i] * math.cos(chi), way[i][1] + distance[i] * math.sin(chi)
            segments.append(Line(x, y, straight, chi))
            done += straight
    ways.append(done + math.fsum(part.length for part in segments[:opening]))
    return Smoothed(segments[opening:] + segments[:opening], ways)


def _check_room(i: int, j: int, length: float, distance: list[float], smoothing: Smoothing) -> None:
    missing = distance[i] + distance[j] - length
    if missing <= TOLERANCE:
        return
    tight = i if distance[i] > distance[j] else j
    size = (
        f"radius of {smoothing.radius:g} m"
        if smoothing.radius is not None
        else f"distance of {smoothing.distance:g} m"
    )
    rounded = [f"{distance[k]:.3f} m at points[{k}]" for k in (i, j) if distance[k] > 0.0]
    raise ConfigurationError(
        f"points[{tight}]",
        f"a corner that does not fit: the {smoothing.kind} {size} takes {' and '.join(rounded)} of a leg of"
        f" {length:.3f} m, {missing:.3f} m too much",
        "a smaller one, or waypoints further apart",
    )


def _dubins(
    way: list[Point], legs: list[tuple[float, float]], smoothing: Smoothing, closed: bool
) -> Smoothed:
    """Return Dubins paths through all waypoints, with the mean of both legs' courses at each."""
    radius = smoothing.radius or math.nan
    courses = []
    for i in range(len(way)):
        if closed or 0 < i < len(way) - 1:
            chi_in = legs[i - 1][1]
            courses.append(chi_in + 0.5 * wrap(legs[i][1] - chi_in))
        else:
            courses.append(legs[0][1] if i == 0 else legs[-1][1])
    for i, course in zip((0, -1), end_courses(smoothing), strict=True):
        if course is not None:
            courses[i] = course
    poses = [PlanarPose(x, y, chi) for (x, y), chi in zip(way, courses, strict=True)]
    connections = [dubins.connect(poses[i], poses[(i + 1) % len(poses)], radius) for i in range(len(legs))]
    lengths = (math.fsum(part.length for part in leg) for leg in connections)
    return Smoothed([part for leg in connections for part in leg], _added(lengths))
