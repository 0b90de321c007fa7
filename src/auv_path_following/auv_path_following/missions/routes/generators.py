"""Ready-made paths: spiral, figure of eight, loiter circle, helix."""

from __future__ import annotations

import itertools
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


def helix(
    centre: Point, radius: float, bearing: float, sweep: float, run_in: float, run_out: float
) -> list[Segment]:
    """Return a circle as seen from above, one subpath for each turn, between two lines that touch it.

    Args:
        centre: north, east, m.
        radius: m.
        bearing: of the circle's start as seen from the centre, rad.
        sweep: angle around the centre, rad, positive to starboard; not 0.
        run_in, run_out: lengths of the lines before and after it, m; 0 for none.
    """
    side = math.copysign(0.5 * math.pi, sweep)
    turns, full = max(1, math.ceil(abs(sweep) / TWO_PI - 1e-9)), math.copysign(TWO_PI, sweep)
    bearings = [bearing + full * k for k in range(turns)] + [bearing + sweep]
    segments: list[Segment] = [Arc(*centre, radius, a0, a1) for a0, a1 in itertools.pairwise(bearings)]
    if run_in > TOLERANCE:
        start, chi = segments[0].evaluate(0.0), bearing + side
        x, y = start.x - run_in * math.cos(chi), start.y - run_in * math.sin(chi)
        segments.insert(0, Line(x, y, run_in, chi))
    if run_out > TOLERANCE:
        end = segments[-1].evaluate(1.0)
        segments.append(Line(end.x, end.y, run_out, bearing + sweep + side))
    return segments
