"""The velocity through the water in level axes, as observer and guidance need it."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.pure import pure


class Levelled(NamedTuple):
    """Velocity through the water in level axes that turn with the heading, m/s: Eqs. (3D-14), (3D-15).

    Attributes:
        ahead, starboard, down: a, b, c_.
        Uh: its horizontal part.
        Ur: all of it.
        beta_h: crab angle, rad.
        gamma_w: elevation of the way through the water, rad, up positive.
    """

    ahead: float
    starboard: float
    down: float
    Uh: float
    Ur: float
    beta_h: float
    gamma_w: float


@pure
def levelled(water: tuple[float, float, float], phi: float, theta: float) -> Levelled:
    """Return the velocity through the water without roll and pitch.

    Args:
        water: ur, vr, wr, m/s, FRD.
        phi, theta: roll and pitch, rad; a positive pitch is bow up.
    """
    ur, vr, wr = water
    cos_phi, sin_phi = math.cos(phi), math.sin(phi)
    w1 = sin_phi * vr + cos_phi * wr
    a = math.cos(theta) * ur + math.sin(theta) * w1
    b = cos_phi * vr - sin_phi * wr
    c = -math.sin(theta) * ur + math.cos(theta) * w1
    Uh = math.hypot(a, b)
    return Levelled(a, b, c, Uh, math.hypot(Uh, c), math.atan2(b, a), math.atan2(-c, Uh))
