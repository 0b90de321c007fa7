"""The only place where an angle is wrapped."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure

TWO_PI = 2.0 * math.pi


@pure
def wrap(angle: float) -> float:
    """The same angle in [-pi, pi), rad. Works on NumPy arrays as well."""
    return (angle + math.pi) % TWO_PI - math.pi
