"""The approach to a path's start from elsewhere: a Dubins path, flown by the same law."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.angles import wrap
from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Navigation
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.curves.dubins import NOTHING, STRAIGHT, Part, PlanarPose, parts, shortest
from auv_path_following.curves.rows import AFTER, ARC, COLUMNS, KIND, LENGTH, LINE, SPEED, A, B, C, D, E
from auv_path_following.guidance.acceptance import Cornering, cornering_of
from auv_path_following.vehicle import Vehicle

#: A vehicle within this distance (m) of a pose and of its course (rad) needs no approach.
NEAR = 3.0
NEAR_COURSE = math.radians(60.0)
#: Share of the hull's steady turn rate used in an approach's turns, in a following current of CURRENT, m/s.
TURN_SHARE = 0.6
CURRENT = 0.4
#: Least radius of turns in look-ahead distances: line of sight cuts tighter ones.
LOOKAHEADS = 2.0
#: Most subpaths of an approach: three of Dubins' and a straight leg.
LEGS = 4


@settings
class ApproachConfig:
    """Approach to the start of the path."""

    enabled: bool = setting(True, "a vehicle away from the path's start flies there first", live=True)
    radius: float = setting(
        0.0, "radius of the turns; 0: from hull and look-ahead", unit="m", ge=0.0, le=1e5, live=True
    )
    overdue: float = setting(600.0, "an approach longer than this is reported", unit="s", gt=0.0, live=True)


class Agility(NamedTuple):
    """Properties of the hull that guidance needs, at the mission's thrust.

    Attributes:
        speed: through the water, straight ahead, m/s.
        turn_rate: of a steady turn with full rudder, rad/s.
        cornering: turning ability at a corner.
    """

    speed: float
    turn_rate: float
    cornering: Cornering


def agility_of(vehicle: Vehicle, thrust: float) -> Agility:
    """Return the agility of a vehicle at a thrust in N.

    Raises:
        ConfigurationError: no turn of the hull is steady, and none was measured.
    """
    thrust = min(thrust, vehicle.thrust_max)
    return Agility(vehicle.speed_at(thrust), tightest_turn(vehicle, thrust).rate, cornering_of(vehicle))


def turn_radius(config: ApproachConfig, agility: Agility, lookahead: float) -> float:
    """Return the radius of an approach's turns, m: one that the hull can fly in any current of up to CURRENT.

    Args:
        config: a radius greater than 0 is used unchanged.
        agility: of the hull.
        lookahead: Delta, m.
    """
    turn = (agility.speed + CURRENT) / (TURN_SHARE * agility.turn_rate)
    return config.radius or max(turn, LOOKAHEADS * lookahead)


@pure
def is_at(x: float, y: float, psi: float, at_x: float, at_y: float, chi: float) -> bool:
    """Return whether a vehicle at (x, y, psi) is at the pose (at_x, at_y, chi): m, rad, NED."""
    return math.hypot(x - at_x, y - at_y) <= NEAR and abs(wrap(psi - chi)) <= NEAR_COURSE


def empty_approach() -> list[list[float]]:
    """Return the rows that `plan` writes into; compiled code has an array of shape (LEGS, COLUMNS)."""
    return [[0.0] * COLUMNS for _ in range(LEGS)]


@pure
def plan(approach: Any, goal: PlanarPose, navigation: Navigation, radius: float) -> int:
    """Write a short path from the vehicle's pose to another one.

    It is the shortest with turns of one radius (Dubins) to a point one radius before the goal, and a straight
    leg from there, on which the vehicle settles. Where the leg costs more than twice its length, because the
    vehicle is close behind the goal, the shortest path leads to the goal itself.

    Args:
        approach: of `empty_approach`; written.
        goal: NED.
        navigation: the vehicle's pose, NED.
        radius: of the turns, m.

    Returns:
        The number of rows written; 0 where the vehicle is at the goal already.
    """
    x, y, psi, _ = navigation
    if is_at(x, y, psi, goal.x, goal.y, goal.chi):
        return 0
    chi = goal.chi
    before = PlanarPose(goal.x - radius * math.cos(chi), goal.y - radius * math.sin(chi), chi)
    legs, direct = 0, 0.0
    for there in (goal, before, goal):
        legs, length = _lay(approach, PlanarPose(x, y, psi), there, radius)
        if there != before:
            direct = length
        elif length + radius <= direct + 2.0 * radius:
            _write_line(approach[legs], before.x, before.y, radius, chi)
            legs += 1
            break
    after = 0.0
    for k in range(legs - 1, -1, -1):
        approach[k][AFTER] = after
        after += approach[k][LENGTH]
    return legs


@pure
def _lay(approach: Any, here: PlanarPose, there: PlanarPose, radius: float) -> tuple[int, float]:
    """Write the shortest Dubins path; return the number of its rows and its length, m."""
    word = shortest(here, there, radius)
    opening, middle, closing = parts(here, there, word, radius)
    legs, length = 0, 0.0
    if word.before > NOTHING:
        length += _write_arc(approach[legs], opening)
        legs += 1
    if word.between > NOTHING:
        if word.middle == STRAIGHT:
            x, y, size, chi, _ = middle
            length += _write_line(approach[legs], x, y, size, chi)
        else:
            length += _write_arc(approach[legs], middle)
        legs += 1
    if word.after > NOTHING:
        length += _write_arc(approach[legs], closing)
        legs += 1
    return legs, length


@pure
def _write_line(row: Any, x: float, y: float, length: float, chi: float) -> float:
    row[KIND], row[A], row[B], row[LENGTH] = LINE, x, y, length
    row[C], row[D], row[E] = length * math.cos(chi), length * math.sin(chi), 0.0
    row[SPEED] = math.hypot(row[C], row[D])
    return length


@pure
def _write_arc(row: Any, arc: Part) -> float:
    cx, cy, radius, a0, a1 = arc
    length = radius * abs(a1 - a0)
    sweep = a1 - a0
    row[KIND], row[A], row[B], row[C], row[D], row[E], row[LENGTH] = ARC, cx, cy, radius, a0, sweep, length
    row[SPEED] = math.hypot(-sweep * (radius * math.sin(a0)), sweep * (radius * math.cos(a0)))
    return length


class ApproachWatch:
    """The approach as a phase of the mission: distance to the path's start, and whether it is overdue."""

    def __init__(self) -> None:
        self._left = self._time = 0.0

    def update(self, left: float, dt: float) -> str:
        """Take the rest of the approach, m, after `dt` s; return a line for the log, or an empty text."""
        before, self._left = self._left, left
        if left > 0.0:
            begins, self._time = self._time == before == 0.0, self._time + dt
            return self.phase if begins else ""
        return "the path's start is reached" if before > 0.0 else ""

    @property
    def phase(self) -> str:
        """Phase of the mission, as a text."""
        return f"approaching: {self._left:.0f} m to the path's start" if self._left > 0.0 else "on the path"

    def complaint(self, overdue: float) -> str:
        """Return a line about an approach longer than `overdue` s, else an empty text."""
        late = self._left > 0.0 and self._time > overdue
        return f"the approach to the path's start takes more than {overdue:g} s" if late else ""
