"""The virtual point P: its errors, its speed, its way along the path. Eqs. (20), (22), (42), (43)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings import setting, settings
from auv_msgs_py.types import Current, Navigation, WaterVelocity
from auv_path_following.paths.composite import CompositePath
from auv_path_following.paths.segment import PathPoint


@settings
class VirtualPointConfig:
    """Table 4's k."""

    k: float = setting(
        1.0, "gain that draws P along the path towards the vehicle", unit="1/s", gt=0.0, le=10.0, live=True
    )


class PathErrors(NamedTuple):
    """Eq. (20): xe along the tangent (m, vehicle ahead positive), ye across it (m, starboard positive)."""

    xe: float
    ye: float


def path_errors(navigation: Navigation, point: PathPoint, chi_p: float) -> PathErrors:
    """The vehicle's place as seen from P, Eq. (20)."""
    dx, dy = navigation.x - point.x, navigation.y - point.y
    cos_chi, sin_chi = math.cos(chi_p), math.sin(chi_p)
    return PathErrors(dx * cos_chi + dy * sin_chi, -dx * sin_chi + dy * cos_chi)


def tangential_speed(
    k: float, xe: float, psi: float, water: WaterVelocity, chi_p: float, current: Current
) -> float:
    """U_P, Eq. (22), m/s.

    Ur cos(psi + beta_r - chi_p) is written out as ur cos(psi - chi_p) - vr sin(psi - chi_p), which is the
    same and needs no angle of drift, so it is also right at rest.
    """
    off = psi - chi_p
    through_water = water.ur * math.cos(off) - water.vr * math.sin(off)
    return through_water + k * xe + math.cos(chi_p) * current.Vx + math.sin(chi_p) * current.Vy


class VirtualPoint:
    """Where P is: the subpath's index i (from 0), which never decreases, and t in [0, 1] on it."""

    def __init__(self, path: CompositePath) -> None:
        self.path = path
        self.reset()

    def reset(self) -> None:
        """Back to the beginning of the path."""
        self.i = 0
        self.t = 0.0
        self._t_rate = 0.0
        self.finished = False

    @property
    def s(self) -> float:
        """The global parameter of Eq. (1), in [0, n]."""
        return self.i + self.t

    def move(self, dt: float) -> bool:
        """Eq. (43) with the speed set last; True when P has just come to a new subpath or to the end.

        Reaching the end of a subpath sets P to the start of the next one: how far it would have
        overshot has no meaning there, since every subpath has its own length per unit of s.
        """
        self.t += self._t_rate * dt
        if self.t < 0.0:
            self.t = 0.0
        if self.t < 1.0 or self.finished:
            return False
        return self.go_on()

    def go_on(self) -> bool:
        """To the start of the next subpath, or to the end of the path."""
        self._t_rate = 0.0
        if self.i + 1 >= self.path.n:
            self.t = 1.0
            self.finished = True
        else:
            self.i += 1
            self.t = 0.0
        return True

    def advance_to(self, i: int, t: float) -> None:
        """To a place ahead (one behind is ignored), and stay there until the next `set_speed`."""
        self._t_rate = 0.0
        if not self.finished and (i, t) > (self.i, self.t):
            self.i, self.t = i, t

    def rest(self) -> None:
        """Stay until the next `set_speed`, however long that takes."""
        self._t_rate = 0.0

    def point(self) -> PathPoint:
        """P and the path's derivatives there."""
        return self.path.evaluate(self.i, self.t)

    def set_speed(self, U_P: float, point: PathPoint) -> float:
        """Take U_P (m/s) for the way to the next update, Eq. (42).

        Returns:
            The speed P really moves with: 0 where it waits at the start of a subpath for a vehicle
            that is still behind it, and at the end of the path.
        """
        if self.finished or (self.t <= 0.0 and U_P < 0.0):
            self._t_rate = 0.0
            return 0.0
        self._t_rate = U_P / point.speed
        return U_P
