"""One odometry out of ATTITUDE and LOCAL_POSITION_NED, each with its own rate and delay. ROS-free."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from typing import NamedTuple

from auv_msgs_py.values.attitude import quaternion_of
from auv_msgs_py.values.types import Navigation, SpatialNavigation
from auv_sim.vehicle.hulls.rigid_body import to_body

#: Largest time between attitude and position of a pair, ms.
APART = 200


class Attitude(NamedTuple):
    """An ATTITUDE; the rates are those of the body axes (FRD), as autopilots send them.

    Attributes:
        boot_ms: time since boot, ms.
        psi, r: heading (rad, from north, clockwise) and yaw rate (rad/s).
        phi, theta, p, q: roll, pitch (rad, bow up) and their rates (rad/s), of a vehicle that dives.
    """

    boot_ms: int
    psi: float
    r: float
    phi: float = 0.0
    theta: float = 0.0
    p: float = 0.0
    q: float = 0.0


class Position(NamedTuple):
    """A LOCAL_POSITION_NED.

    Attributes:
        boot_ms: time since boot, ms.
        x, y, vx, vy: position (m) and velocity over ground (m/s), north and east.
        z, vz: depth (m) and its rate (m/s), of a vehicle that dives.
    """

    boot_ms: int
    x: float
    y: float
    vx: float
    vy: float
    z: float = 0.0
    vz: float = 0.0


class Fused(NamedTuple):
    """An odometry.

    Attributes:
        boot_ms: time since boot, ms.
        navigation: pose and rates, NED.
        velocity: over ground in the body frame (FRD), m/s: two components, or three for a vehicle that dives.
        p: roll rate of a vehicle that dives, rad/s.
    """

    boot_ms: int
    navigation: Navigation | SpatialNavigation
    velocity: tuple[float, ...]
    p: float = 0.0


def fuse(attitude: Attitude, position: Position) -> Fused:
    """Return the odometry of a vehicle in the plane, at the attitude's instant."""
    dt = (attitude.boot_ms - position.boot_ms) * 1e-3
    _, x, y, vx, vy, _, _ = position
    cos_psi, sin_psi = math.cos(attitude.psi), math.sin(attitude.psi)
    return Fused(
        attitude.boot_ms,
        Navigation(x + vx * dt, y + vy * dt, attitude.psi, attitude.r),
        (vx * cos_psi + vy * sin_psi, -vx * sin_psi + vy * cos_psi),
    )


def fuse_in_space(attitude: Attitude, position: Position) -> Fused:
    """Return the odometry of a vehicle that dives, at the attitude's instant."""
    dt = (attitude.boot_ms - position.boot_ms) * 1e-3
    _, x, y, vx, vy, z, vz = position
    boot_ms, psi, r, phi, theta, p, q = attitude
    return Fused(
        boot_ms,
        SpatialNavigation(x + vx * dt, y + vy * dt, z + vz * dt, phi, theta, psi, q, r),
        to_body(*quaternion_of(phi, theta, psi), vx, vy, vz),
        p,
    )


class Assembly:
    """Pairs the newest attitude with the newest position.

    A position triggers. It is moved to the attitude's instant by its own velocity: the attitude comes more
    often and sooner, and an error of the stamp affects the heading most.

    Args:
        fused: makes one odometry of both.
    """

    def __init__(self, fused: Callable[[Attitude, Position], Fused] = fuse) -> None:
        self._fused = fused
        self.dropped: Counter[str] = Counter()
        self.reset()

    def reset(self) -> None:
        """Forget both: the vehicle was restarted."""
        self._attitude: Attitude | None = None
        self._position: Position | None = None
        self._used_ms: int | None = None

    def attitude(self, new: Attitude) -> None:
        """Keep an attitude."""
        if not math.isfinite(sum(new)):
            self.dropped["ATTITUDE that is no number"] += 1
        elif self._attitude is not None and new.boot_ms <= self._attitude.boot_ms:
            self.dropped["ATTITUDE out of order"] += 1
        else:
            self._attitude = new

    def position(self, new: Position) -> Fused | None:
        """Keep a position; return an odometry if there is an attitude for it that has not been used."""
        if not math.isfinite(sum(new)):
            self.dropped["LOCAL_POSITION_NED that is no number"] += 1
            return None
        if self._position is not None and new.boot_ms <= self._position.boot_ms:
            self.dropped["LOCAL_POSITION_NED out of order"] += 1
            return None
        self._position = new
        attitude = self._attitude
        if attitude is None or abs(attitude.boot_ms - new.boot_ms) > APART:
            self.dropped["LOCAL_POSITION_NED without ATTITUDE"] += 1
            return None
        if attitude.boot_ms == self._used_ms:
            return None
        self._used_ms = attitude.boot_ms
        return self._fused(attitude, new)
