"""A lawnmower survey: parallel legs that together cover a polygon."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.curves import dubins
from auv_path_following.curves.dubins import PlanarPose
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.segment import Segment
from auv_path_following.missions.routes.smoothing import Smoothed, Smoothing, smooth, smoothed

Point = tuple[float, float]
Leg = tuple[Point, Point]

MOST_LEGS = 20_000


def legs(polygon: Sequence[Point], spacing: float, chi: float, run_out: float = 0.0) -> list[Leg]:
    """Return the legs of a survey, from port to starboard of the course `chi`, in alternating directions.

    The polygon is cut into strips along `chi`, all of one width and not wider than `spacing`. Each leg runs
    along the middle of its strip and covers the strip's whole part of the polygon, bays included.

    Args:
        polygon: its corners in order (north, east), m.
        spacing: largest distance between neighbouring legs, m.
        chi: course of the first leg, rad.
        run_out: length of each leg beyond the polygon, at both ends, m.

    Raises:
        ConfigurationError: fewer than three corners, no area, or too many legs.
    """
    if len(polygon) < 3:
        raise ConfigurationError("polygon", f"{len(polygon)} corners", "at least 3")
    corners = np.asarray(polygon, float)
    along_axis, across_axis = (
        np.array([math.cos(chi), math.sin(chi)]),
        np.array([-math.sin(chi), math.cos(chi)]),
    )
    along, across = corners @ along_axis, corners @ across_axis
    low, width = float(across.min()), float(np.ptp(across))
    if min(width, float(np.ptp(along))) <= 1e-6 or _area(along, across) <= 1e-6:
        raise ConfigurationError("polygon", "corners on one line", "a polygon with an area")
    count = max(1, math.ceil(width / spacing - 1e-9))
    if count > MOST_LEGS:
        raise ConfigurationError(
            "spacing", f"{spacing:g} m, which gives {count} legs", f"at most {MOST_LEGS} legs"
        )
    strip = width / count
    start, end = _extents(along, across, low, strip, count)
    found: list[Leg] = []
    for k in range(count):
        middle = low + (k + 0.5) * strip
        ends = [along_axis * a + across_axis * middle for a in (start[k] - run_out, end[k] + run_out)]
        first, last = ((float(x), float(y)) for x, y in (ends if k % 2 == 0 else ends[::-1]))
        found.append((first, last))
    return found


def _area(along: np.ndarray, across: np.ndarray) -> float:
    return 0.5 * abs(float(along @ np.roll(across, -1) - across @ np.roll(along, -1)))


def _extents(
    along: np.ndarray, across: np.ndarray, low: float, strip: float, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return where the polygon begins and ends along each strip, by its corners and its edges' crossings."""
    start, end = np.full(count, np.inf), np.full(count, -np.inf)

    def take(strips: np.ndarray, at: np.ndarray) -> None:
        strips = np.clip(strips, 0, count - 1)
        np.minimum.at(start, strips, at)
        np.maximum.at(end, strips, at)

    take(((across - low) / strip).astype(int), along)
    boundaries = low + strip * np.arange(1, count)
    for a0, c0, a1, c1 in zip(along, across, np.roll(along, -1), np.roll(across, -1), strict=True):
        # A corner on a boundary belongs to both strips.
        inside = np.flatnonzero((boundaries >= min(c0, c1)) & (boundaries <= max(c0, c1)))
        if inside.size and c0 != c1:
            crossing = a0 + (a1 - a0) * (boundaries[inside] - c0) / (c1 - c0)
            take(inside, crossing)
            take(inside + 1, crossing)
    return start, end


def path(way: Sequence[Leg], turns: Smoothing) -> list[Segment]:
    """Return the legs, joined by turns: the segments of `joined`."""
    return joined(way, turns).segments


def joined(way: Sequence[Leg], turns: Smoothing) -> Smoothed:
    """Return the legs, joined by turns, and the lengths of path at which each leg begins and ends.

    With dubins every leg is flown to its end, straight, and the turn lies outside; the other kinds round
    the corners of the way from leg to leg.

    Args:
        way: the legs.
        turns: kind of the turns.

    Raises:
        ConfigurationError: a turn does not fit, or keys that do not belong to a survey.
    """
    if turns.kind != "dubins":
        return smoothed([point for leg in way for point in leg], turns)
    smooth(way[0], turns)  # for the check of its keys
    if turns.start_course_deg is not None or turns.end_course_deg is not None:
        found = "start_course_deg or end_course_deg"
        raise ConfigurationError("smoothing", found, "neither: with dubins the legs' courses count")
    radius = turns.radius or math.nan
    segments: list[Segment] = []
    ways: list[float] = []
    done = 0.0
    before: PlanarPose | None = None
    for (x0, y0), (x1, y1) in way:
        length, chi = math.hypot(x1 - x0, y1 - y0), math.atan2(y1 - y0, x1 - x0)
        if before is not None:
            turn = dubins.connect(before, PlanarPose(x0, y0, chi), radius)
            segments += turn
            done += math.fsum(part.length for part in turn)
        segments.append(Line(x0, y0, length, chi))
        ways += [done, done + length]
        done += length
        before = PlanarPose(x1, y1, chi)
    return Smoothed(segments, ways)
