"""Round one corner: three shapes, each symmetric about the waypoint and of any size.

For a given course change all sizes are scaled copies of one curve, so its reach describes a shape: the
distance from its start to the waypoint, divided by its tightest radius.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from auv_path_following.curves.kinds.arc import Arc
from auv_path_following.curves.kinds.clothoid import Clothoid
from auv_path_following.curves.kinds.fermat import FermatSpiral, MirroredFermatSpiral
from auv_path_following.curves.segment import Segment

#: Where the curvature of Fermat's spiral peaks: theta = sqrt(sqrt(7)/2 - 5/4), rad.
FERMAT_PEAK = math.sqrt(0.5 * math.sqrt(7.0) - 1.25)


class WaypointCorner(NamedTuple):
    """A waypoint with the legs before and after it.

    Attributes:
        x, y: the waypoint (north, east), m.
        chi_in, chi_out: courses of the legs before and after it, rad.
        turn: course change, rad in (-pi, pi), positive to starboard.
    """

    x: float
    y: float
    chi_in: float
    chi_out: float
    turn: float

    @property
    def rho(self) -> int:
        """1 when it turns to starboard, -1 to port."""
        return 1 if self.turn > 0.0 else -1

    def start(self, distance: float) -> tuple[float, float]:
        """Return the point `distance` (m) before the waypoint."""
        return self.x - distance * math.cos(self.chi_in), self.y - distance * math.sin(self.chi_in)

    def end(self, distance: float) -> tuple[float, float]:
        """Return the point `distance` (m) behind the waypoint."""
        return self.x + distance * math.cos(self.chi_out), self.y + distance * math.sin(self.chi_out)


class CornerShape(NamedTuple):
    """A way to round a corner.

    Attributes:
        reach: of |course change| (rad): distance from the waypoint to the start, divided by the tightest
            radius.
        build: the segments for a corner and that distance (m).
    """

    reach: Callable[[float], float]
    build: Callable[[WaypointCorner, float], list[Segment]]


# --- circular: one arc, G1


def _circular_reach(turn: float) -> float:
    return math.tan(0.5 * turn)


def _circular(corner: WaypointCorner, distance: float) -> list[Segment]:
    radius = distance / _circular_reach(abs(corner.turn))
    x, y = corner.start(distance)
    cx = x - corner.rho * radius * math.sin(corner.chi_in)
    cy = y + corner.rho * radius * math.cos(corner.chi_in)
    a0 = corner.chi_in - corner.rho * 0.5 * math.pi
    return [Arc(cx, cy, radius, a0, a0 + corner.turn)]


# --- clothoid: two of them, in and out, G2


@lru_cache(maxsize=65536)
def _clothoid_reach(turn: float) -> float:
    # With the tightest radius as unit, each half is as long as the whole turn.
    end = Clothoid(0.0, 0.0, turn, 0.0, 0.0, 1.0).evaluate(1.0)
    return end.x + end.y * math.tan(0.5 * turn)


def _clothoid(corner: WaypointCorner, distance: float) -> list[Segment]:
    radius = distance / _clothoid_reach(abs(corner.turn))
    length, kappa = abs(corner.turn) * radius, corner.rho / radius
    first = Clothoid(*corner.start(distance), length, corner.chi_in, 0.0, kappa)
    middle = first.evaluate(1.0)
    return [first, Clothoid(middle.x, middle.y, length, corner.chi_in + 0.5 * corner.turn, kappa, 0.0)]


# --- Fermat's spiral and its mirror, G2, Eqs. (12), (13)


@lru_cache(maxsize=65536)
def fermat_theta_end(turn: float) -> float:
    """Return theta_end of each of two spirals that together change the course by `turn`, rad (Lekkas).

    Solves theta + atan(2 theta) = turn / 2 by Newton's method.
    """
    half = 0.5 * turn
    theta = half / 3.0
    for _ in range(50):
        slope = 1.0 + 2.0 / (1.0 + 4.0 * theta * theta)
        step = (theta + math.atan(2.0 * theta) - half) / slope
        theta -= step
        if abs(step) <= 1e-16 * (1.0 + theta):
            break
    return theta


def fermat_curvature(theta: float) -> float:
    """Return curvature times scale k of Fermat's spiral at polar angle theta (rad), Eq. (8) for Eq. (12)."""
    square = 4.0 * theta * theta
    return 2.0 * math.sqrt(theta) * (3.0 + square) / math.sqrt(1.0 + square) ** 3


def _fermat_unit_distance(turn: float) -> float:
    """Return the distance from the waypoint to the spiral's outer end, divided by the scale k."""
    theta = fermat_theta_end(turn)
    return math.sqrt(theta) * (math.cos(theta) + math.sin(theta) * math.tan(0.5 * turn))


def _fermat_reach(turn: float) -> float:
    # Above a course change of 87.6 degrees the tightest point lies inside the spiral.
    peak = fermat_curvature(min(fermat_theta_end(turn), FERMAT_PEAK))
    return _fermat_unit_distance(turn) * peak


def _fermat(corner: WaypointCorner, distance: float) -> list[Segment]:
    turn = abs(corner.turn)
    theta_end, k = fermat_theta_end(turn), distance / _fermat_unit_distance(turn)
    return [
        FermatSpiral(*corner.start(distance), k, theta_end, corner.chi_in, corner.rho),
        MirroredFermatSpiral(*corner.end(distance), k, theta_end, corner.chi_out, corner.rho),
    ]


SHAPES = {
    "circular": CornerShape(_circular_reach, _circular),
    "clothoid": CornerShape(_clothoid_reach, _clothoid),
    "fermat": CornerShape(_fermat_reach, _fermat),
}
