"""Points of a path in three dimensions: course, elevation, curvature, and depth over horizontal length.

NED: z is depth, m. An elevation gamma is positive upwards.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure
from auv_path_following.curves.rows import Point


class SpatialPoint(NamedTuple):
    """A point of a path with its first and second derivatives with respect to t: NED, m."""

    x: float
    y: float
    z: float
    dx: float
    dy: float
    dz: float
    ddx: float
    ddy: float
    ddz: float


class Tangent(NamedTuple):
    """Direction of a path.

    Attributes:
        chi: course chi_p, rad clockwise from north.
        gamma: elevation gamma_p, rad, up positive.
        horizontal: h, length of the horizontal part of the first derivative, m.
        speed: |p'|, m per unit of t.
    """

    chi: float
    gamma: float
    horizontal: float
    speed: float


@pure
def tangent_of(point: SpatialPoint) -> Tangent:
    """Return course and elevation, Eq. (3D-6). The path must not be vertical."""
    horizontal = math.sqrt(point.dx * point.dx + point.dy * point.dy)
    return Tangent(
        math.atan2(point.dy, point.dx),
        math.atan2(-point.dz, horizontal),
        horizontal,
        math.sqrt(horizontal * horizontal + point.dz * point.dz),
    )


@pure
def turning_of(point: SpatialPoint) -> tuple[float, float]:
    """Return d chi_p/dt and d gamma_p/dt, rad per unit of t: Eqs. (3D-7), (3D-8)."""
    _, _, _, dx, dy, dz, ddx, ddy, ddz = point
    squared = dx * dx + dy * dy
    course = (dx * ddy - dy * ddx) / squared
    elevation = (dz * (dx * ddx + dy * ddy) - ddz * squared) / (math.sqrt(squared) * (squared + dz * dz))
    return course, elevation


@pure
def curvatures_of(point: SpatialPoint) -> tuple[float, float, float]:
    """Return total, horizontal and vertical curvature, 1/m: Eq. (3D-9).

    The total one is positive; the horizontal one is positive to starboard, the vertical one upwards.
    """
    _, _, _, dx, dy, dz, ddx, ddy, ddz = point
    a, b, c = dy * ddz - dz * ddy, dz * ddx - dx * ddz, dx * ddy - dy * ddx
    squared = dx * dx + dy * dy
    speed = math.sqrt(squared + dz * dz)
    _, elevation = turning_of(point)
    return (
        math.sqrt(a * a + b * b + c * c) / (speed * speed * speed),
        c / (squared * math.sqrt(squared)),
        elevation / speed,
    )


#: Depth, m; its slope, and the rate of the slope (1/m), over horizontal length.
Profile = tuple[float, float, float]


@pure
def linear_ramp(begin: float, end: float, length: float, way: float) -> Profile:
    """Return the depth between two knots that a straight line joins.

    Args:
        begin, end: depths at the knots, m.
        length: horizontal length between them, m.
        way: horizontal length behind the first, m.
    """
    slope = (end - begin) / length
    return begin + slope * way, slope, 0.0


@pure
def smooth_ramp(begin: float, end: float, length: float, way: float) -> Profile:
    """Return the depth between two knots at which slope and curvature are 0: Eq. (3D-11).

    The steepest slope is 1.875 (end - begin)/length, in the middle. Arguments as in `linear_ramp`.
    """
    e, D = way / length, end - begin
    one = e * e * e * (10.0 - 15.0 * e + 6.0 * e * e)
    slope = 30.0 * e * e * (1.0 - e) * (1.0 - e)
    bend = 60.0 * e * (1.0 - e) * (1.0 - 2.0 * e)
    return begin + D * one, D / length * slope, D / (length * length) * bend


@pure
def lifted(point: Point, profile: Profile) -> SpatialPoint:
    """Return a point of a planar path at the depth that a profile has there: Eq. (3D-10)."""
    x, y, dx, dy, ddx, ddy = point
    z, slope, bend = profile
    squared = dx * dx + dy * dy
    horizontal = math.sqrt(squared)
    return SpatialPoint(
        x,
        y,
        z,
        dx,
        dy,
        slope * horizontal,
        ddx,
        ddy,
        bend * squared + slope * (dx * ddx + dy * ddy) / horizontal,
    )
