"""The rudder's servo: it saturates and it turns at a limited rate."""

from __future__ import annotations


class RudderServo:
    """Moves towards its target at the greatest rate, never past the stops.

    Args:
        max_angle: stops at +- this angle, rad.
        max_rate: rad/s.
    """

    def __init__(self, max_angle: float, max_rate: float) -> None:
        self.max_angle = max_angle
        self.max_rate = max_rate
        self.angle = 0.0
        self.target = 0.0

    def command(self, angle: float) -> None:
        """Set the target, rad; beyond the stops it is the stop."""
        self.target = min(max(angle, -self.max_angle), self.max_angle)

    def after(self, seconds: float) -> float:
        """The angle `seconds` from now, rad, if the target stays; changes nothing."""
        reach = self.max_rate * seconds
        return self.angle + min(max(self.target - self.angle, -reach), reach)

    def advance(self, seconds: float) -> None:
        """Let time pass."""
        self.angle = self.after(seconds)
