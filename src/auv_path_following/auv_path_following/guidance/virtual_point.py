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
    """Table 4's k, and how far from P it counts in full."""

    k: float = setting(
        1.0, "gain that draws P along the path towards the vehicle", unit="1/s", gt=0.0, le=10.0, live=True
    )
    saturation: float = setting(
        6.0, "k xe of Eq. (22) grows no further beyond this |xe|", unit="m", ge=1.0, le=1000.0, live=True
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


def saturated(xe: float, limit: float) -> float:
    """Return xe (m) held within +-limit, for Eq. (22): up to the limit it is xe itself.

    Without a bound a vehicle far from P would drive it at any speed, and r_d = kappa U_P with it. Theorem 1
    still holds: with psi = psi_d, Eq. (32) becomes xe' = -k sat(xe) + r_p ye. The terms with r_p cancel in
    V1' as before, and -k xe sat(xe) is negative for every xe other than 0.
    """
    return min(max(xe, -limit), limit)


def tangential_speed(
    k: float, xe: float, psi: float, water: WaterVelocity, chi_p: float, current: Current
) -> float:
    """Return U_P, Eq. (22), m/s.

    Ur cos(psi + beta_r - chi_p) is written as ur cos(psi - chi_p) - vr sin(psi - chi_p): the same value
    without the drift angle, so it is valid at rest as well.
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
        """Return to the beginning of the path."""
        self.i = 0
        self.t = 0.0
        self.finished = False
        #: How far the last `move` led beyond the end of the path, m.
        self.beyond = 0.0
        self.rest()

    @property
    def s(self) -> float:
        """The global parameter of Eq. (1), in [0, n]."""
        return self.i + self.t

    def move(self, dt: float) -> bool:
        """Move by Eq. (43) with the speed set last; return whether P has left its subpath.

        Departs from Eq. (43), which sets P to the start of the next subpath: the rest of the step's way is
        carried over as length, over as many subpaths as it takes. The time is linear in the subpaths passed.
        """
        self.t = max(self.t + self._t_rate * dt, 0.0)
        if self.t < 1.0 or self.finished:
            return False
        way = (self.t - 1.0) * self._metres_per_t
        self.go_on()
        self.advance(way)
        return True

    def advance(self, way: float) -> None:
        """Move on by `way` metres from the start of a subpath."""
        while not self.finished:
            segment = self.path.segments[self.i]
            self.t = way / segment.evaluate(0.0).speed
            if self.t < 1.0:
                return
            way = max(way - segment.length, 0.0)
            self.go_on()
        self.beyond = way

    def go_on(self) -> None:
        """Move to the start of the next subpath, or to the end of the path."""
        self.rest()
        if self.i + 1 >= self.path.n:
            self.t = 1.0
            self.finished = True
        else:
            self.i += 1
            self.t = 0.0

    def advance_to(self, i: int, t: float) -> None:
        """Move to a place ahead (one behind is ignored), and stay there until the next `set_speed`."""
        self.rest()
        if not self.finished and (i, t) > (self.i, self.t):
            self.i, self.t = i, t

    def rest(self) -> None:
        """Stay until the next `set_speed`, however long that takes."""
        self._t_rate = self._metres_per_t = 0.0

    def point(self) -> PathPoint:
        """P and the path's derivatives there."""
        return self.path.evaluate(self.i, self.t)

    def set_speed(self, U_P: float, point: PathPoint) -> float:
        """Set the speed U_P (m/s) until the next update, Eq. (42).

        Returns:
            The speed of P: 0 where it waits at the start of a subpath for a vehicle that is still behind
            it, and at the end of the path.
        """
        if self.finished or (self.t <= 0.0 and U_P < 0.0):
            self.rest()
            return 0.0
        self._metres_per_t = point.speed
        self._t_rate = U_P / self._metres_per_t
        return U_P
