"""The commands of the small test of rudder and thrust over time. ROS-free."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.values.types import STOP, Command
from auv_path_following.vehicle import Vehicle

#: Thrust, as a share of the largest.
THRUST_SHARE = 0.6
#: (until, rudder in degrees): a rest and the run-up, both sides, twice as much, neutral.
_RUDDER = ((7.0, 0.0), (10.0, 10.0), (15.0, -10.0), (18.0, 20.0), (20.0, 0.0))
_THRUST_FROM, END = 1.0, 21.0
#: Zeros are sent for this long after the end, s.
FAREWELL = 1.0


class Wiggle(NamedTuple):
    """The sequence for one vehicle; it needs a circle of some 40 m radius."""

    thrust: float
    largest: float

    @classmethod
    def of(cls, vehicle: Vehicle) -> Wiggle:
        """Return the sequence within the vehicle's limits."""
        return cls(THRUST_SHARE * vehicle.thrust_max, vehicle.rudder.max_angle)

    def at(self, seconds: float) -> Command:
        """Return the command at a time after the beginning, s."""
        if not 0.0 <= seconds < END:
            return STOP
        degrees = next((angle for until, angle in _RUDDER if seconds < until), 0.0)
        rudder = math.copysign(min(abs(math.radians(degrees)), self.largest), degrees)
        return Command(rudder, self.thrust if seconds >= _THRUST_FROM and seconds < END - 1.0 else 0.0)
