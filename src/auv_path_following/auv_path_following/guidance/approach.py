"""The way to a path's start for a vehicle that begins elsewhere: a Dubins path, flown by the same law."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.angles import wrap
from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Navigation
from auv_path_following.control.hull_model import tightest_turn
from auv_path_following.guidance.acceptance import Cornering, cornering_of
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.dubins import Pose, connect
from auv_path_following.paths.line import Line
from auv_path_following.vehicle import Vehicle

#: A vehicle this near to a pose (m) and to its course (rad) is there: it needs no approach.
NEAR = 3.0
NEAR_COURSE = math.radians(60.0)
#: Share of the hull's steady turn rate that an approach's turns take, in a following current of CURRENT, m/s.
TURN_SHARE = 0.6
CURRENT = 0.4
#: Turns are no tighter than this many look-ahead distances: line of sight cuts tighter ones.
LOOKAHEADS = 2.0


@settings
class ApproachConfig:
    """Whether and how a vehicle is led to the start of its path."""

    enabled: bool = setting(
        True, "a mission that begins away from its path's start flies there first", live=True
    )
    radius: float = setting(
        0.0, "radius of the turns; 0: from hull and look-ahead", unit="m", ge=0.0, le=1e5, live=True
    )
    overdue: float = setting(600.0, "an approach longer than this is reported", unit="s", gt=0.0, live=True)


class Agility(NamedTuple):
    """What guidance has to know of the hull, at the mission's thrust.

    Attributes:
        speed: through the water, straight ahead, m/s.
        turn_rate: of a steady turn with full rudder, rad/s.
        cornering: how its heading is turned at a corner.
    """

    speed: float
    turn_rate: float
    cornering: Cornering


def agility_of(vehicle: Vehicle, thrust: float) -> Agility:
    """Return what a vehicle's file says of its agility at a thrust in N.

    Raises:
        ConfigurationError: no turn of the hull is steady, and none was measured.
    """
    thrust = min(thrust, vehicle.thrust_max)
    return Agility(vehicle.speed_at(thrust), tightest_turn(vehicle, thrust).rate, cornering_of(vehicle))


def turn_radius(config: ApproachConfig, agility: Agility, lookahead: float) -> float:
    """Return the radius of an approach's turns, m: one that the hull can fly in any current of up to CURRENT.

    Args:
        config: a radius greater than 0 is taken as it is.
        agility: of the hull.
        lookahead: Delta, m.
    """
    turn = (agility.speed + CURRENT) / (TURN_SHARE * agility.turn_rate)
    return config.radius or max(turn, LOOKAHEADS * lookahead)


def is_at(x: float, y: float, psi: float, at_x: float, at_y: float, chi: float) -> bool:
    """Return whether a vehicle at (x, y, psi) is near enough to the pose (at_x, at_y, chi): m, rad, NED."""
    return math.hypot(x - at_x, y - at_y) <= NEAR and abs(wrap(psi - chi)) <= NEAR_COURSE


def approach_to(
    goal: tuple[float, float, float], navigation: Navigation, radius: float
) -> CompositePath | None:
    """Return a short path from the vehicle's pose to another one.

    It is the shortest with turns of one radius (Dubins) to a point one radius before the goal, and a straight
    leg from there, on which the vehicle settles. Where the leg costs more than twice its length, because the
    vehicle is close behind the goal, the shortest path leads to the goal itself.

    Args:
        goal: x, y (m) and course (rad), NED.
        navigation: the vehicle's pose, NED.
        radius: of the turns, m.

    Returns:
        The path; None where the vehicle is at the goal already.
    """
    x, y, psi, _ = navigation
    if is_at(x, y, psi, *goal):
        return None
    here, there = Pose(x, y, psi), Pose(*goal)
    before = Pose(there.x - radius * math.cos(there.chi), there.y - radius * math.sin(there.chi), there.chi)
    direct = CompositePath(connect(here, there, radius))
    settled = CompositePath([*connect(here, before, radius), Line(*before[:2], radius, there.chi)])
    return settled if settled.length <= direct.length + 2.0 * radius else direct


class ApproachWatch:
    """The phase of a mission: how far it is to the path's start, and whether that takes too long."""

    def __init__(self) -> None:
        self._left = self._time = 0.0

    def update(self, left: float, dt: float) -> str:
        """Take what is left of the approach, m, after `dt` seconds; return a line for the log, or nothing."""
        before, self._left = self._left, left
        if left > 0.0:
            begins, self._time = self._time == before == 0.0, self._time + dt
            return self.phase if begins else ""
        return "the path's start is reached" if before > 0.0 else ""

    @property
    def phase(self) -> str:
        """Where the mission is."""
        return f"approaching: {self._left:.0f} m to the path's start" if self._left > 0.0 else "on the path"

    def complaint(self, overdue: float) -> str:
        """Return a line about an approach that has taken more than `overdue` seconds, else an empty text."""
        late = self._left > 0.0 and self._time > overdue
        return f"the approach to the path's start takes more than {overdue:g} s" if late else ""
