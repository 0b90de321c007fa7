"""The virtual point P: errors, speed and motion along the path. Eqs. (20), (22), (42), (43)."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import bounded, pure
from auv_msgs_py.values.types import Current, Navigation, WaterVelocity
from auv_path_following.curves.rows import LENGTH, SPEED, PathRows


@settings
class VirtualPointConfig:
    """k of Table 4, and its saturation."""

    k: float = setting(
        1.0, "gain that draws P along the path towards the vehicle", unit="1/s", gt=0.0, le=10.0, live=True
    )
    saturation: float = setting(
        6.0, "k xe of Eq. (22) grows no further beyond this |xe|", unit="m", ge=1.0, le=1000.0, live=True
    )


@pure
def path_errors(navigation: Navigation, x_p: float, y_p: float, chi_p: float) -> tuple[float, float]:
    """Return the vehicle's position relative to P, Eq. (20), m.

    xe is along the tangent, positive where the vehicle is ahead; ye is across it, positive to starboard.

    Args:
        navigation: the vehicle's pose, NED.
        x_p, y_p, chi_p: P (m) and the path's course there (rad), NED.
    """
    x, y, _, _ = navigation
    dx, dy = x - x_p, y - y_p
    cos_chi, sin_chi = math.cos(chi_p), math.sin(chi_p)
    return dx * cos_chi + dy * sin_chi, -dx * sin_chi + dy * cos_chi


@pure
def saturated(value: float, limit: float) -> float:
    """Return a value bounded to +-limit.

    Eq. (22) uses the bounded xe: without a bound a vehicle far from P would drive it at any speed, and
    r_d = kappa U_P with it. Theorem 1 still holds: with psi = psi_d, Eq. (32) becomes
    xe' = -k sat(xe) + r_p ye. The terms with r_p cancel in V1' as before, and -k xe sat(xe) is negative for
    every xe other than 0.
    """
    return bounded(value, limit)


@pure
def tangential_speed(
    k: float, xe: float, psi: float, water: WaterVelocity, chi_p: float, current: Current
) -> float:
    """Return U_P, Eq. (22), m/s.

    Ur cos(psi + beta_r - chi_p) is written as ur cos(psi - chi_p) - vr sin(psi - chi_p): the same value
    without the drift angle, so it is valid at rest as well.
    """
    (ur, vr), (Vx, Vy), off = water, current, psi - chi_p
    through_water = ur * math.cos(off) - vr * math.sin(off)
    return through_water + k * xe + math.cos(chi_p) * Vx + math.sin(chi_p) * Vy


class VirtualPoint(NamedTuple):
    """Place of P, and its speed until the next step.

    Attributes:
        i: subpath, from 0; it never decreases.
        t: place on the subpath, in [0, 1].
        t_rate: dt/d(time), 1/s; 0: P rests.
        metres_per_t: |dp/dt| where the speed was set, m.
        finished: whether P is at the end of the path.
    """

    i: int = 0
    t: float = 0.0
    t_rate: float = 0.0
    metres_per_t: float = 0.0
    finished: bool = False

    @property
    def s(self) -> float:
        """The global parameter of Eq. (1), in [0, n]."""
        return self.i + self.t


#: i, t, whether P is at the end of the path, and the length of the step beyond it, m.
Place = tuple[int, float, bool, float]


@pure
def moved(path: PathRows, P: VirtualPoint, dt: float) -> Place:
    """Return where P is after `dt` seconds, Eq. (43).

    Departs from Eq. (43), which sets P to the start of the next subpath: the rest of the step is carried over
    as length, over any number of subpaths. The time is linear in the subpaths passed.
    """
    i, t, t_rate, metres_per_t, finished = P
    t += t_rate * dt
    if t < 0.0:
        t = 0.0
    if t < 1.0 or finished:
        return i, t, finished, 0.0
    return passed_on(path, i, (t - 1.0) * metres_per_t)


@pure
def passed_on(path: PathRows, i: int, way: float) -> Place:
    """Return the place `way` metres beyond the end of subpath `i`: on a later one, or the end of the path."""
    if i + 1 >= path.n:
        return i, 1.0, True, way
    return advanced(path, i + 1, way)


@pure
def advanced(path: PathRows, i: int, way: float) -> Place:
    """Return the place `way` metres from the start of subpath `i`."""
    while True:
        row = path.subpath[i]
        t = way / row[SPEED] if way > 0.0 else 0.0
        if t < 1.0:
            return i, t, False, 0.0
        way = max(way - row[LENGTH], 0.0)
        if i + 1 >= path.n:
            return i, 1.0, True, way
        i += 1


@pure
def driven(i: int, t: float, finished: bool, U_P: float, metres_per_t: float) -> tuple[VirtualPoint, float]:
    """Return P with the speed U_P (m/s) until the next step, Eq. (42), and that speed.

    The speed is 0 where P waits at the start of a subpath for a vehicle that is still behind it, and at the
    end of the path.

    Args:
        i, t, finished: place of P.
        U_P: of Eq. (22), m/s.
        metres_per_t: |dp/dt| there, m.
    """
    if finished or (t <= 0.0 and U_P < 0.0):
        return VirtualPoint(i, t, 0.0, 0.0, finished), 0.0
    return VirtualPoint(i, t, U_P / metres_per_t, metres_per_t, finished), U_P
