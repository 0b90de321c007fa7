"""The propeller of `mss_remus100`, by its open-water data."""

from __future__ import annotations

import math

from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.hulls.mss_particulars import RHO

PROPELLER = 0.14  # m, diameter


@pure
def propeller_loads(revolutions: float, speed: float) -> tuple[float, float]:
    """Return thrust (N) and roll moment (N m), as the published model scales them.

    Args:
        revolutions: 1/s, ahead.
        speed: over ground, m/s; 0.944 of it arrives at the propeller.
    """
    advance = 0.944 * speed / PROPELLER
    n = abs(revolutions)
    thrust = RHO * PROPELLER**4 * (0.4566 * n * revolutions + (0.1798 - 0.4566) / 0.6632 * advance * n)
    moment = RHO * PROPELLER**5 * (0.0700 * n * revolutions + (0.0312 - 0.0700) / 0.6632 * advance * n)
    return 0.9 * thrust, moment / 10.0


@pure
def revolutions_for(thrust: float, speed: float) -> float:
    """Return the revolutions, 1/s, that give a thrust (N, at least 0) at a speed over ground (m/s)."""
    square = 0.9 * RHO * PROPELLER**4 * 0.4566
    linear = 0.9 * RHO * PROPELLER**3 * (0.1798 - 0.4566) / 0.6632 * 0.944 * speed
    return (-linear + math.sqrt(linear * linear + 4.0 * square * max(thrust, 0.0))) / (2.0 * square)
