"""Courses of random legs, as long and as tight as a hull's turn needs; each seed has its own."""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_path_following.missions.routes.smoothing import Smoothing, smooth

#: Length of a leg (m), drawn evenly; on a hull that turns wider than `USUAL_TURN` (m) in proportion longer.
SHORTEST, LONGEST, USUAL_TURN = 80.0, 140.0, 7.0
#: Change of course at a corner, deg, drawn evenly, to either side.
SHALLOWEST, SHARPEST = 30.0, 120.0
#: The same on gentle courses. Their radii are drawn evenly from `WIDEST` up to what the legs allow.
STRAIGHTEST, GENTLE = 10.0, 60.0
#: Radius of rounded corners and of the turns of a survey over that of the steady turn, drawn evenly.
TIGHTEST, WIDEST = 1.15, 3.5

Kind = Literal["sharp", "rounded", "survey", "gentle"]
#: Kinds in words.
WORDS: dict[Kind, str] = {
    "sharp": "sharp corners",
    "rounded": "rounded corners",
    "survey": "surveys",
    "gentle": "gentle bends",
}


def water(is_flowing: bool, is_sea: bool) -> str:
    """Return the water of a flight in words."""
    return "in the sea" if is_sea else "in a current" if is_flowing else "in still water"


def drawn_course(
    kind: Kind, turn_radius: float, legs: int, random: np.random.Generator, tightest: float = TIGHTEST
) -> CompositePath:
    """Draw a course of legs.

    Args:
        kind: sharp corners; corners rounded by arcs; a survey of parallel legs; or gentle bends, which are
            rounded corners of up to `GENTLE` with wide arcs.
        turn_radius: of the hull's steady turn, m.
        legs: how many.
        random: where the numbers come from.
        tightest: least radius of rounded corners and turns of a survey over `turn_radius`.
    """
    if kind == "survey":
        return _survey(turn_radius, legs, random, tightest)
    scale = max(1.0, turn_radius / USUAL_TURN)
    shallowest, sharpest = (STRAIGHTEST, GENTLE) if kind == "gentle" else (SHALLOWEST, SHARPEST)
    point, course = (0.0, 0.0), random.uniform(-math.pi, math.pi)
    points = [point]
    for _ in range(legs):
        length = scale * random.uniform(SHORTEST, LONGEST)
        point = point[0] + length * math.cos(course), point[1] + length * math.sin(course)
        points.append(point)
        change = math.radians(random.uniform(shallowest, sharpest))
        course += math.copysign(change, random.uniform(-1.0, 1.0))
    if kind == "sharp":
        return CompositePath(smooth(points, Smoothing(kind="linear")))
    # An arc of radius R takes R tan(change/2) of a leg at most, at both of its ends: it must fit.
    most = 0.45 * SHORTEST * scale / math.tan(math.radians(0.5 * sharpest))
    if kind == "gentle":
        radius = random.uniform(WIDEST * turn_radius, most)
    else:
        radius = min(random.uniform(tightest, WIDEST) * turn_radius, most)
    return CompositePath(smooth(points, Smoothing(kind="circular", radius=radius)))


def _survey(turn_radius: float, legs: int, random: np.random.Generator, tightest: float) -> CompositePath:
    """Draw parallel legs, joined by two arcs of a quarter each."""
    scale = max(1.0, turn_radius / USUAL_TURN)
    radius = random.uniform(tightest, WIDEST) * turn_radius
    length = scale * random.uniform(SHORTEST, LONGEST)
    # Between the arcs a short straight is left.
    spacing, course = 2.2 * radius, random.uniform(-math.pi, math.pi)
    side = math.copysign(1.0, random.uniform(-1.0, 1.0))
    along, across = (math.cos(course), math.sin(course)), (-math.sin(course), math.cos(course))
    points: list[tuple[float, float]] = []
    for k in range(max(legs - 2, 2)):
        ends = (0.0, length + 2.0 * radius) if k % 2 == 0 else (length + 2.0 * radius, 0.0)
        beside = side * k * spacing
        points += [(along[0] * end + across[0] * beside, along[1] * end + across[1] * beside) for end in ends]
    return CompositePath(smooth(points, Smoothing(kind="circular", radius=radius)))
