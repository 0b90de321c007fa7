"""Angle and rate of the rudder as a controller respects them."""

from __future__ import annotations

from auv_path_following.vehicle import Rudder


class RudderLimiter:
    """Moves the command towards what is wanted, no faster and no farther than the rudder can.

    Args:
        rudder: limits of angle and rate.
    """

    def __init__(self, rudder: Rudder) -> None:
        self.rudder = rudder
        self.reset()

    def reset(self) -> None:
        """Neutral."""
        self.angle = 0.0

    def limit(self, wanted: float, dt: float) -> float:
        """The command after `dt` seconds, rad."""
        reach = self.rudder.max_rate * dt
        largest = self.rudder.max_angle
        wanted = min(max(wanted, -largest), largest)
        self.angle += min(max(wanted - self.angle, -reach), reach)
        return self.angle
