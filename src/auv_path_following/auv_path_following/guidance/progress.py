"""How far a mission has come: along an approach to the path's start, then from subpath to subpath."""

from __future__ import annotations

import math

from auv_msgs_py.types import Current, Navigation
from auv_path_following.guidance.approach import NEAR, Agility, ApproachConfig, approach_to, turn_radius
from auv_path_following.guidance.rejoin import closest_ahead
from auv_path_following.guidance.switching import CircleOfAcceptance
from auv_path_following.guidance.virtual_point import VirtualPoint
from auv_path_following.paths.composite import CompositePath


class Progress:
    """Moves the virtual point: on the path never past what the vehicle has not passed.

    A mission begins at the path's start: a vehicle that is elsewhere is led there first, by a point on a
    Dubins path of its own. The circle of acceptance at the end of a subpath counts only once the vehicle has
    been within `NEAR` of P on that subpath.

    Args:
        path: the path.
        agility: of the hull; None: no approach, P waits at the path's start.
    """

    def __init__(self, path: CompositePath, agility: Agility | None) -> None:
        self.path = path
        self.circle = CircleOfAcceptance(path, cornering=None if agility is None else agility.cornering)
        self.approach_config = ApproachConfig()
        self._agility = agility
        self._on_path = VirtualPoint(path)
        self.reset()

    def reset(self) -> None:
        """Return to the beginning of the path."""
        self._on_path.reset()
        self._approach: VirtualPoint | None = None
        self._is_planned = self._has_joined = False
        self._at: tuple[float, float] | None = None

    @property
    def point(self) -> VirtualPoint:
        """P: on the approach while there is one, then on the path."""
        return self._approach or self._on_path

    @property
    def on_path(self) -> VirtualPoint:
        """P on the path; it waits at the start during an approach."""
        return self._on_path

    @property
    def approach_to_go(self) -> float:
        """What is left of the approach, m; 0 when there is none."""
        P = self._approach
        return 0.0 if P is None else P.path.distance_to_go(P.i, P.t)

    @property
    def distance_to_go(self) -> float:
        """From P to the end of the path, m."""
        return self.approach_to_go + self.path.distance_to_go(self._on_path.i, self._on_path.t)

    def move(self, navigation: Navigation, Ur: float, current: Current, dt: float) -> bool:
        """Move P for `dt` seconds; return whether it has come to another subpath, or to the path's end.

        Args:
            navigation: measured pose, NED.
            Ur: speed through the water, m/s.
            current: the observer's estimate, m/s, NED.
            dt: seconds since the last call.
        """
        P, approach = self._on_path, self._approach
        self._at = navigation[:2]
        if not self._is_planned:
            self._plan(navigation)
            return False
        if approach is not None:
            approach.move(dt)
            if approach.finished:
                self._plan(navigation)
            if self._approach is None:
                P.advance(approach.beyond)
            return False
        switched = P.move(dt)
        x, y = self._at
        if not P.finished and self._has_joined and self.circle.reached(x, y, P.i, P.t, Ur, current):
            P.go_on()
            switched = True
        self._has_joined = self._has_joined and not switched
        return switched

    def judge(self, off: float) -> None:
        """Note from the distance to P, m, whether the vehicle has joined the subpath or lost the approach."""
        if self._approach is None:
            self._has_joined = self._has_joined or off <= NEAR
        else:
            self._is_planned = off <= self._radius

    def rejoin(self, navigation: Navigation, longest_reach: float) -> None:
        """After a hold: P goes ahead to the closest point of as much path as the vehicle may have come along.

        It is looked for no farther ahead than the vehicle was carried, with half as much again for the
        path's turns, and never behind: a leg that lies beside this one is not mistaken for it. An approach is
        planned anew instead.
        """
        if self._approach is not None or not self._is_planned:
            self._is_planned = False
            return
        P, (x, y) = self._on_path, self._at or navigation[:2]
        carried = math.hypot(navigation.x - x, navigation.y - y)
        reach = min(1.5 * carried + 1.0, longest_reach)
        before = P.i
        P.advance_to(*closest_ahead(self.path, P.i, P.t, navigation.x, navigation.y, reach))
        self._has_joined = self._has_joined and P.i == before

    def _plan(self, navigation: Navigation) -> None:
        """Plan the approach from here; none where the vehicle is at the path's start."""
        self._is_planned, self._approach = True, None
        if self._agility is None or not self.approach_config.enabled:
            return
        self._radius = turn_radius(self.approach_config, self._agility, self.circle.lookahead)
        way = approach_to(self.path.start_pose, navigation, self._radius)
        self._approach = None if way is None else VirtualPoint(way)
