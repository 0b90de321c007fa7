"""Ready-made paths: spiral, figure of eight, loiter circle."""

from __future__ import annotations

import math

from auv_msgs_py.values.angles import TWO_PI
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.archimedean import ArchimedeanSpiral
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.segment import Segment
from auv_path_following.missions.routes.smoothing import TOLERANCE

Point = tuple[float, float]


def spiral(
    centre: Point, inner_radius: float, spacing: float, turns: float, bearing: float, turn: int
) -> list[Segment]:
    """Return a spiral outwards around a point, one subpath for each turn.

    Args:
        centre: north, east, m.
        inner_radius: distance from the centre at which it starts, m, not negative.
        spacing: distance between neighbouring turns, m.
        turns: number of turns, not necessarily whole.
        bearing: of the start as seen from the centre, rad.
        turn: 1 to starboard, -1 to port.
    """
    segments: list[Segment] = []
    done = 0.0
    while done < turns - 1e-9:
        until = min(done + 1.0, turns)
        radii = (inner_radius + spacing * done, inner_radius + spacing * until)
        bearings = (bearing + turn * TWO_PI * done, bearing + turn * TWO_PI * until)
        segments.append(ArchimedeanSpiral(*centre, *radii, *bearings))
        done = until
    return segments


def figure_of_eight(centre: Point, radius: float, separation: float, chi: float) -> list[Segment]:
    """Return two loops and the crossing lines between them, closed; the first loop is first, to starboard.

    Args:
        centre: of the crossing (north, east), m.
        radius: of both loops, m.
        separation: distance between the loops' centres, m, at least 2 radius.
        chi: bearing of the first loop's centre from the crossing, rad.
    """
    half = 0.5 * separation
    # Seen from the crossing, a tangent touches its loop `away` off the axis.
    away = math.asin(min(radius / half, 1.0))
    straight = math.sqrt(max(separation * separation - 4.0 * radius * radius, 0.0))
    loops = []
    for axis, side in ((chi, 1.0), (chi + math.pi, -1.0)):
        cx, cy = centre[0] + half * math.cos(axis), centre[1] + half * math.sin(axis)
        a0 = axis - side * (away + 0.5 * math.pi)
        loops.append(Arc(cx, cy, radius, a0, a0 + side * (math.pi + 2.0 * away)))
    segments: list[Segment] = []
    for loop, course in zip(loops, (chi + math.pi + away, chi - away), strict=True):
        segments.append(loop)
        if straight > TOLERANCE:
            leave = loop.evaluate(1.0)
            segments.append(Line(leave.x, leave.y, straight, course))
    return segments


def loiter(centre: Point, radius: float, turns: int, bearing: float, turn: int) -> list[Segment]:
    """Return a circle, one subpath for each turn.

    Args:
        centre: north, east, m.
        radius: m.
        turns: number of turns.
        bearing: of the start as seen from the centre, rad.
        turn: 1 to starboard, -1 to port.
    """
    return [Arc(*centre, radius, bearing, bearing + turn * TWO_PI)] * turns
