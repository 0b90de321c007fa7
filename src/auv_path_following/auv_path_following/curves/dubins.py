"""The shortest path between two poses for a vehicle with a least turning radius (Dubins, 1957)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.angles import TWO_PI
from auv_msgs_py.values.pure import pure
from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.line import Line
from auv_path_following.curves.segment import Segment

#: Turns (rad) and legs (radii) below this are left out: they are far below any tolerance.
NOTHING = 1e-11

#: Sides of the parts of a word: to port, straight on, to starboard.
PORT, STRAIGHT, STARBOARD = -1.0, 0.0, 1.0
_LETTERS = {PORT: "L", STRAIGHT: "S", STARBOARD: "R"}
#: LSL RSR LSR RSL RLR LRL: of equally short words the first one is taken.
_WORDS = (
    (PORT, STRAIGHT, PORT),
    (STARBOARD, STRAIGHT, STARBOARD),
    (PORT, STRAIGHT, STARBOARD),
    (STARBOARD, STRAIGHT, PORT),
    (STARBOARD, PORT, STARBOARD),
    (PORT, STARBOARD, PORT),
)

#: cx, cy, radius, a0, a1 of an `Arc`; or x0, y0, length, chi of a `Line`, and 0.
Part = tuple[float, float, float, float, float]


class PlanarPose(NamedTuple):
    """x, y (north, east, m) and course chi (rad)."""

    x: float
    y: float
    chi: float


class Word(NamedTuple):
    """One Dubins path: the sides of its three parts, and their sizes.

    Sizes are radians of turning, and of a straight part metres divided by the radius. The middle one of a
    word that does not join its poses is infinite.
    """

    first: float
    middle: float
    last: float
    before: float
    between: float
    after: float

    @property
    def letters(self) -> str:
        """Its three parts as letters: L port, R starboard, S straight."""
        return "".join(_LETTERS[side] for side in self[:3])

    @property
    def size(self) -> float:
        """Length divided by the radius."""
        return _size(self)


@pure
def _size(word: Word) -> float:
    return word.before + word.between + word.after


def words(start: PlanarPose, end: PlanarPose, radius: float) -> list[Word]:
    """Return all of the six words that join the two poses."""
    found = [_word(start, end, radius, sides) for sides in _WORDS]
    return [word for word in found if math.isfinite(word.between)]


@pure
def shortest(start: PlanarPose, end: PlanarPose, radius: float) -> Word:
    """Return the shortest word; of several equally short ones the first in the order of `_WORDS`.

    Two poses always have one: of LSL and RSR both exist.
    """
    best = Word(STRAIGHT, STRAIGHT, STRAIGHT, 0.0, math.inf, 0.0)
    for sides in _WORDS:
        word = _word(start, end, radius, sides)
        if _size(word) < _size(best):
            best = word
    return best


@pure
def _word(start: PlanarPose, end: PlanarPose, radius: float, sides: tuple[float, float, float]) -> Word:
    first, middle, last = sides
    dx, dy = (end.x - start.x) / radius, (end.y - start.y) / radius
    # From the centre of the first circle to that of the last one, with the radius as unit.
    east = dy + last * math.cos(end.chi) - first * math.cos(start.chi)
    north = dx - last * math.sin(end.chi) + first * math.sin(start.chi)
    distance = math.hypot(north, east)
    # With equal centres any course fits: keep the present one rather than a rounding error.
    bearing = math.atan2(east, north) if distance > NOTHING else start.chi
    if middle == STRAIGHT:
        course, size, after = _straight(first, last, distance, bearing)
    else:
        course, size, after = _curled(first, distance, bearing)
    return Word(first, middle, last, _turn(first, start.chi, course), size, _turn(last, after, end.chi))


@pure
def parts(start: PlanarPose, end: PlanarPose, word: Word, radius: float) -> tuple[Part, Part, Part]:
    """Return the three parts of a word: its arcs, and between them its line or arc.

    The first turn is computed from the start, the last one back from the end, so that both poses are exact in
    spite of rounding between.
    """
    chi = start.chi + word.first * word.before
    opening = _arc(start, word.first, word.before, radius)
    closing = _arc(end, word.last, -word.after, radius)
    cx, cy, _, a0, a1 = opening
    a = a0 + (a1 - a0)
    x, y = cx + radius * math.cos(a), cy + radius * math.sin(a)
    if word.middle == STRAIGHT:
        cx, cy, _, a, _ = closing
        north, east = cx + radius * math.cos(a) - x, cy + radius * math.sin(a) - y
        return opening, (x, y, math.hypot(north, east), math.atan2(east, north), 0.0), closing
    return opening, _arc(PlanarPose(x, y, chi), -word.first, word.between, radius), closing


@pure
def _arc(pose: PlanarPose, side: float, size: float, radius: float) -> Part:
    """Return a turn of `size` rad that starts at the pose, or ends there if `size` is negative."""
    x, y, chi = pose
    cx, cy = x - side * radius * math.sin(chi), y + side * radius * math.cos(chi)
    a0 = chi - side * 0.5 * math.pi
    there = a0 + side * size
    return (cx, cy, radius, a0, there) if size >= 0.0 else (cx, cy, radius, there, a0)


def follow(start: PlanarPose, end: PlanarPose, word: Word, radius: float) -> list[Segment]:
    """Return the word as segments: arcs and lines; parts of no length are left out."""
    opening, middle, closing = parts(start, end, word, radius)
    between: Segment = Line(*middle[:4]) if word.middle == STRAIGHT else Arc(*middle)
    sizes = zip((Arc(*opening), between, Arc(*closing)), word[3:], strict=True)
    return [segment for segment, size in sizes if size > NOTHING]


def connect(start: PlanarPose, end: PlanarPose, radius: float) -> list[Segment]:
    """Return the shortest Dubins path as segments; empty when the poses are one.

    Args:
        start, end: poses, NED.
        radius: of both kinds of turn, m, greater than 0.
    """
    return follow(start, end, shortest(start, end, radius), radius)


@pure
def _turn(side: float, before: float, after: float) -> float:
    """Return the turn to that side between two courses, in [0, 2 pi); almost a full circle counts as 0."""
    size = (side * (after - before)) % TWO_PI
    return 0.0 if size > TWO_PI - NOTHING else size


@pure
def _straight(first: float, last: float, distance: float, bearing: float) -> tuple[float, float, float]:
    """Return course, size and course of the straight part; the size is infinite where the circles overlap."""
    if first == last:
        return bearing, distance, bearing
    if distance < 2.0:
        return bearing, math.inf, bearing
    course = bearing + first * math.asin(2.0 / distance)
    return course, math.sqrt(max(distance * distance - 4.0, 0.0)), course


@pure
def _curled(side: float, distance: float, bearing: float) -> tuple[float, float, float]:
    """Return the course into the middle turn, its size (more than half a circle), and the course out."""
    if distance > 4.0:
        return bearing, math.inf, bearing
    slant = math.acos(0.25 * distance)
    # The middle circle touches both others. Of its two places this is the one where it is followed for
    # more than half its way round: the other one never gives the shortest path.
    course = bearing + side * slant + side * 0.5 * math.pi
    size = math.pi + 2.0 * slant
    return course, size, course - side * size
