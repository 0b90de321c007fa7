"""The rudder's servo: it saturates and turns at a limited rate; a real one also has play and comes late."""

from __future__ import annotations

import math
from collections import deque

from auv_msgs_py.settings import setting, settings


@settings
class RudderFlaws:
    """What an ideal servo does not have; each is off by default."""

    dead_band_deg: float = setting(
        0.0, "a servo at rest does not start for a smaller difference", unit="deg", ge=0.0, le=20.0
    )
    backlash_deg: float = setting(
        0.0, "play between servo and rudder, from stop to stop", unit="deg", ge=0.0, le=20.0
    )
    dead_time: float = setting(0.0, "from a command to the servo's start", unit="s", ge=0.0, le=5.0)


class RudderServo:
    """Moves towards its target at the greatest rate, never past the stops.

    Args:
        max_angle: stops at +- this angle, rad.
        max_rate: rad/s.
        flaws: dead band, backlash, dead time; none if None.
    """

    def __init__(self, max_angle: float, max_rate: float, flaws: RudderFlaws | None = None) -> None:
        self.max_angle = max_angle
        self.max_rate = max_rate
        flaws = flaws or RudderFlaws()
        self._band, self._play = math.radians(flaws.dead_band_deg), math.radians(0.5 * flaws.backlash_deg)
        self._dead_time = flaws.dead_time
        self._clock = 0.0
        self._on_their_way: deque[tuple[float, float]] = deque()
        self._fin = 0.0
        #: The servo's angle, rad: what it measures.
        self.angle = 0.0
        self.target = 0.0

    def command(self, angle: float) -> None:
        """Set the target, rad; beyond the stops it is the stop."""
        angle = min(max(angle, -self.max_angle), self.max_angle)
        if self._dead_time:
            self._on_their_way.append((self._clock + self._dead_time, angle))
            self._take_what_has_come()
        else:
            self._aim(angle)

    @property
    def fin(self) -> float:
        """The rudder's own angle, rad: the servo's, but for the play between them."""
        return self.fin_after(0.0) if self._play else self.angle

    def after(self, seconds: float) -> float:
        """The servo's angle `seconds` from now, rad, if the target stays; changes nothing."""
        reach = self.max_rate * seconds
        return self.angle + min(max(self.target - self.angle, -reach), reach)

    def fin_after(self, seconds: float) -> float:
        """The rudder's own angle `seconds` from now, rad; changes nothing."""
        angle = self.after(seconds)
        if not self._play:
            return angle
        # It is taken along at the end of the play, and else stays where it is.
        return min(max(self._fin, angle - self._play), angle + self._play)

    def advance(self, seconds: float) -> None:
        """Let time pass. A command that comes out of its dead time meanwhile counts from the end on."""
        self._fin, self.angle = self.fin_after(seconds), self.after(seconds)
        if self._dead_time:
            self._clock += seconds
            self._take_what_has_come()

    def _take_what_has_come(self) -> None:
        while self._on_their_way and self._on_their_way[0][0] <= self._clock + 1e-9:
            self._aim(self._on_their_way.popleft()[1])

    def _aim(self, angle: float) -> None:
        at_rest = abs(self.target - self.angle) < 1e-12
        if not at_rest or abs(angle - self.angle) > self._band or not self._band:
            self.target = angle
