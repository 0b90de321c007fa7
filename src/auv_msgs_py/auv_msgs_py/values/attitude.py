"""Attitude: quaternions, Euler angles, and the rates of those; NED and FRD, rad."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure
from auv_msgs_py.values.types import Navigation, SpatialNavigation

#: w, x, y, z of a unit quaternion.
Quaternion = tuple[float, float, float, float]


@pure
def quaternion_of(phi: float, theta: float, psi: float) -> Quaternion:
    """Return the unit quaternion of Rz(psi) Ry(theta) Rx(phi)."""
    cx, sx = math.cos(0.5 * phi), math.sin(0.5 * phi)
    cy, sy = math.cos(0.5 * theta), math.sin(0.5 * theta)
    cz, sz = math.cos(0.5 * psi), math.sin(0.5 * psi)
    return (
        cz * cy * cx + sz * sy * sx,
        cz * cy * sx - sz * sy * cx,
        cz * sy * cx + sz * cy * sx,
        sz * cy * cx - cz * sy * sx,
    )


@pure
def angles_of_quaternion(w: float, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return phi, theta, psi of a unit quaternion, each in (-pi, pi]: Eq. (3D-2)."""
    sine = 2.0 * (w * y - z * x)
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        math.asin(1.0 if sine > 1.0 else -1.0 if sine < -1.0 else sine),
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )


@pure
def turned_over(w: float, x: float, y: float, z: float) -> Quaternion:
    """Return an attitude of FRD in NED as one of FLU in ENU, or the other way round: its own inverse."""
    h = math.sqrt(0.5)
    return h * (w + z), h * (x + y), h * (x - y), h * (w - z)


@pure
def attitude_over_the_wire(phi: float, theta: float, psi: float) -> tuple[float, float, float]:
    """Return an attitude as an odometry in ENU and FLU carries it: equal but for its last bits."""
    w, x, y, z = quaternion_of(phi, theta, psi)
    w, x, y, z = turned_over(w, x, y, z)
    w, x, y, z = turned_over(w, x, y, z)
    return angles_of_quaternion(w, x, y, z)


@pure
def euler_rates(phi: float, theta: float, q: float, r: float) -> tuple[float, float]:
    """Return psi' and theta', rad/s: Eq. (3D-27). cos(theta) counts as 0.1 at least.

    Args:
        phi, theta: roll and pitch, rad.
        q, r: pitch and yaw rate in body axes, rad/s.
    """
    level = math.cos(theta)
    if level < 0.1:
        level = 0.1
    return (q * math.sin(phi) + r * math.cos(phi)) / level, q * math.cos(phi) - r * math.sin(phi)


@pure
def level_of(navigation: SpatialNavigation) -> Navigation:
    """Return place and heading, with the rate of the heading: Eq. (3D-27)."""
    rate, _ = euler_rates(navigation.phi, navigation.theta, navigation.q, navigation.r)
    return Navigation(navigation.x, navigation.y, navigation.psi, rate)
