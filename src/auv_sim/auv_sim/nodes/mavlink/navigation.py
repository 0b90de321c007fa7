"""One odometry out of ATTITUDE and LOCAL_POSITION_NED, each with its own rate and delay. ROS-free."""

from __future__ import annotations

import math
from collections import Counter
from typing import NamedTuple

from auv_msgs_py.values.types import Navigation

#: Largest time between attitude and position of a pair, ms.
APART = 200


class Attitude(NamedTuple):
    """Time since boot (ms), heading (rad, from north, clockwise) and its rate (rad/s)."""

    boot_ms: int
    psi: float
    r: float


class Position(NamedTuple):
    """Time since boot (ms), position (m) and velocity over ground (m/s), north and east."""

    boot_ms: int
    x: float
    y: float
    vx: float
    vy: float


class Fused(NamedTuple):
    """An odometry: time since boot (ms), pose, and velocity over ground in the body frame (FRD), m/s."""

    boot_ms: int
    navigation: Navigation
    u: float
    v: float


class Assembly:
    """Pairs the newest attitude with the newest position.

    A position triggers. It is moved to the attitude's instant by its own velocity: the attitude comes more
    often and sooner, and an error of the stamp affects the heading most.
    """

    def __init__(self) -> None:
        self.dropped: Counter[str] = Counter()
        self.reset()

    def reset(self) -> None:
        """Forget both: the vehicle was restarted."""
        self._attitude: Attitude | None = None
        self._position: Position | None = None
        self._used_ms: int | None = None

    def attitude(self, new: Attitude) -> None:
        """Keep an attitude."""
        if not math.isfinite(new.psi + new.r):
            self.dropped["ATTITUDE that is no number"] += 1
        elif self._attitude is not None and new.boot_ms <= self._attitude.boot_ms:
            self.dropped["ATTITUDE out of order"] += 1
        else:
            self._attitude = new

    def position(self, new: Position) -> Fused | None:
        """Keep a position; return an odometry if there is an attitude for it that has not been used."""
        if not math.isfinite(new.x + new.y + new.vx + new.vy):
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
        dt = (attitude.boot_ms - new.boot_ms) * 1e-3
        cos_psi, sin_psi = math.cos(attitude.psi), math.sin(attitude.psi)
        return Fused(
            attitude.boot_ms,
            Navigation(new.x + new.vx * dt, new.y + new.vy * dt, attitude.psi, attitude.r),
            new.vx * cos_psi + new.vy * sin_psi,
            -new.vx * sin_psi + new.vy * cos_psi,
        )
