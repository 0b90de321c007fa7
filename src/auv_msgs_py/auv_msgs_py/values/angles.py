"""The only place where an angle is wrapped."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure

TWO_PI = 2.0 * math.pi


@pure
def wrap(angle: float) -> float:
    """Return an angle (rad) wrapped to [-pi, pi); NumPy arrays too."""
    return (angle + math.pi) % TWO_PI - math.pi
