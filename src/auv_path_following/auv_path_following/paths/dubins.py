"""The shortest way between two poses for a vehicle with a least turning radius (Dubins, 1957)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.angles import TWO_PI
from auv_path_following.paths.arc import Arc
from auv_path_following.paths.line import Line
from auv_path_following.paths.segment import Segment

#: Turns and legs below this are left out: no vehicle and no joint notices them. rad, or radii.
_NOTHING = 1e-11

_SIDE = {"L": -1.0, "S": 0.0, "R": 1.0}


class Pose(NamedTuple):
    """x, y (north, east, m) and course chi (rad)."""

    x: float
    y: float
    chi: float


class Word(NamedTuple):
    """One Dubins path: three letters (L port, R starboard, S straight) and the size of each part.

    Sizes are radians of turning, and for S metres divided by the radius.
    """

    letters: str
    sizes: tuple[float, float, float]

    @property
    def size(self) -> float:
        """Length divided by the radius."""
        return sum(self.sizes)


def words(start: Pose, end: Pose, radius: float) -> list[Word]:
    """Every one of the six words that joins the two poses."""
    dx, dy = (end.x - start.x) / radius, (end.y - start.y) / radius
    found = []
    for letters in ("LSL", "RSR", "LSR", "RSL", "RLR", "LRL"):
        first, middle, last = letters
        # From the centre of the first circle to that of the last one, with the radius as unit.
        s1, s2 = _SIDE[first], _SIDE[last]
        east = dy + s2 * math.cos(end.chi) - s1 * math.cos(start.chi)
        north = dx - s2 * math.sin(end.chi) + s1 * math.sin(start.chi)
        distance = math.hypot(north, east)
        # With both centres in one place every course will do: do not turn for the sake of rounding.
        bearing = math.atan2(east, north) if distance > _NOTHING else start.chi
        solution = _straight(s1, s2, distance, bearing) if middle == "S" else _curled(s1, distance, bearing)
        if solution is None:
            continue
        course, size, after = solution
        sizes = (_turn(s1, start.chi, course), size, _turn(s2, after, end.chi))
        found.append(Word(letters, sizes))
    return found


def shortest(start: Pose, end: Pose, radius: float) -> Word:
    """The shortest word; the first of several equally short ones in the order LSL RSR LSR RSL RLR LRL.

    Two poses always have one: of LSL and RSR both exist.
    """
    return min(words(start, end, radius), key=lambda word: word.size)


def follow(start: Pose, end: Pose, word: Word, radius: float) -> list[Segment]:
    """The word as segments: arcs and lines; parts of no length are left out.

    The first turn is laid from the start, the last one back from the end, so that both poses are met
    exactly whatever was rounded between.
    """
    first, _, last = (_SIDE[letter] for letter in word.letters)
    before, size, after = word.sizes
    chi = start.chi + first * before
    opening = _arc(start, first, before, radius)
    closing = _arc(Pose(end.x, end.y, end.chi), last, -after, radius)
    x, y = opening.evaluate(1.0)[:2]
    middle: Segment
    if word.letters[1] == "S":
        to_x, to_y = closing.evaluate(0.0)[:2]
        middle = Line(x, y, math.hypot(to_x - x, to_y - y), math.atan2(to_y - y, to_x - x))
    else:
        middle = _arc(Pose(x, y, chi), -first, size, radius)
    parts = zip((opening, middle, closing), word.sizes, strict=True)
    return [segment for segment, length in parts if length > _NOTHING]


def _arc(pose: Pose, side: float, size: float, radius: float) -> Arc:
    """A turn of `size` rad that starts at the pose; a negative size: one that ends there."""
    x, y, chi = pose
    cx, cy = x - side * radius * math.sin(chi), y + side * radius * math.cos(chi)
    a0 = chi - side * 0.5 * math.pi
    there = a0 + side * size
    return Arc(cx, cy, radius, a0, there) if size >= 0.0 else Arc(cx, cy, radius, there, a0)


def connect(start: Pose, end: Pose, radius: float) -> list[Segment]:
    """The shortest Dubins path as segments; empty when the poses are one.

    Args:
        start, end: poses, NED.
        radius: of both kinds of turn, m, greater than 0.
    """
    return follow(start, end, shortest(start, end, radius), radius)


def _turn(side: float, before: float, after: float) -> float:
    """How far to turn to that side from one course to another, in [0, 2 pi); just short of a circle is 0."""
    size = (side * (after - before)) % TWO_PI
    return 0.0 if size > TWO_PI - _NOTHING else size


def _straight(s1: float, s2: float, distance: float, bearing: float) -> tuple[float, float, float] | None:
    """Course of the straight part, its size, and its course again; None when the circles are in the way."""
    if s1 == s2:
        return bearing, distance, bearing
    if distance < 2.0:
        return None
    course = bearing + s1 * math.asin(2.0 / distance)
    return course, math.sqrt(max(distance * distance - 4.0, 0.0)), course


def _curled(side: float, distance: float, bearing: float) -> tuple[float, float, float] | None:
    """Course into the middle turn, its size (more than half a circle), and the course out of it."""
    if distance > 4.0:
        return None
    slant = math.acos(0.25 * distance)
    # The middle circle touches both others. Of its two places this is the one where it is followed for
    # more than half its way round: the other one never gives the shortest path.
    course = bearing + side * slant + side * 0.5 * math.pi
    size = math.pi + 2.0 * slant
    return course, size, course - side * size
