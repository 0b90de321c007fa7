"""Velocity over ground in the world, from one in the body."""

from __future__ import annotations

import math

from auv_msgs_py.values.types import SpatialNavigation


def over_ground(at: SpatialNavigation, velocity: tuple[float, float, float]) -> tuple[float, float]:
    """Return the velocity towards north and east, m/s.

    Args:
        at: attitude, NED.
        velocity: u, v, w over ground, FRD, m/s; a w that is not measured (NaN) counts as 0.
    """
    u, v, w = velocity
    w = 0.0 if math.isnan(w) else w
    sine_roll, cosine_roll = math.sin(at.phi), math.cos(at.phi)
    forward = u * math.cos(at.theta) + (v * sine_roll + w * cosine_roll) * math.sin(at.theta)
    starboard = v * cosine_roll - w * sine_roll
    sine, cosine = math.sin(at.psi), math.cos(at.psi)
    return forward * cosine - starboard * sine, forward * sine + starboard * cosine
