"""A program on a vehicle: its steps, and the bounds that end it. ROS-free."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import SPATIAL_STOP, SpatialCommand, SpatialNavigation
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.manoeuvres.legs import SUBMERGE, manoeuvres_of
from auv_sim.own_vehicle.manoeuvres.manoeuvring import Flown, is_at_depth, manoeuvre, manoeuvring_begins
from auv_sim.own_vehicle.manoeuvres.program_file import Program

#: Depth that a vehicle which dives holds, m.
DEPTH = 10.0
#: Speed over ground beyond that of full thrust and this current counts as lost navigation, m/s.
_CURRENT = 1.5
#: Time over which the speed over ground is taken, s.
_SPEED_OVER = 1.0


@settings
class ManoeuvreBounds:
    """Bounds of a program; when one is left, rudder and planes go to neutral and thrust to 0."""

    box: float = setting(
        200.0, "largest distance from the start, to north and to east", unit="m", gt=0.0, le=5000.0
    )
    dive: float = setting(
        8.0, "largest distance from the held depth once it was reached", unit="m", gt=0.0, le=100.0
    )
    altitude: float = setting(3.0, "least height above the bottom, where measured", unit="m", ge=0.0)
    pitch_deg: float = setting(45.0, "largest pitch", unit="deg", gt=0.0, lt=85.0)
    spare_time: float = setting(30.0, "longest time beyond the program's duration", unit="s", ge=0.0)


class ManoeuvreRow(NamedTuple):
    """One step: time since the start (s), number of the leg, navigation (NED) and commands."""

    t: float
    leg: int
    navigation: SpatialNavigation
    command: SpatialCommand


class ManoeuvreRun:
    """One flight of a program.

    Args:
        vehicle: that flies.
        program: what it flies.
        bounds: that it keeps.
        depth: to be held, m; of a vehicle in the plane 0.

    Attributes:
        rows: every step.
        over: why it ended; empty while it goes on.
        complete: whether it ended because all legs were flown.
        sounded: whether an altitude was ever measured; from then on its loss ends the program.

    Raises:
        ConfigurationError: the vehicle cannot fly the program, or a held depth is beyond its own.
    """

    def __init__(self, vehicle: Vehicle, program: Program, bounds: ManoeuvreBounds, depth: float) -> None:
        self._vehicle, self._bounds, self._depth = vehicle, bounds, depth
        self._config = manoeuvres_of(program, vehicle)
        if vehicle.dives:
            self._check_depths()
        self._state: Flown | None = None
        self._time = 0.0
        self._reached = not vehicle.dives
        self.rows: list[ManoeuvreRow] = []
        self.over = ""
        self.complete = self.sounded = False

    def _check_depths(self) -> None:
        largest, held = self._vehicle.depth.max, self._depth
        for leg in self._config.legs:
            held += leg.depth_step
            if not 0.0 <= held <= largest:
                stepped = "" if held == self._depth else f", stepped to {held:g} m"
                expected = f"depths from 0 to depth.max, {largest:g} m"
                raise ConfigurationError("depth", f"{self._depth:g} m{stepped}", expected)

    @property
    def begun(self) -> bool:
        """Whether a first navigation has come."""
        return self._state is not None

    @property
    def duration(self) -> float:
        """Longest duration of the program, s."""
        return self._config.duration

    @property
    def progress(self) -> float:
        """Share of the program that is over, 0 to 1."""
        if self._state is None:
            return 0.0
        before = sum(leg.seconds for leg in self._config.legs[: self._state.leg])
        return min((before + self._state.time) / self._config.duration, 1.0)

    def stop(self, reason: str) -> None:
        """End the program; the first reason stays."""
        self.over = self.over or reason

    def step(self, navigation: Any, dt: float, altitude: float = math.nan) -> SpatialCommand:
        """Return the commands for a navigation.

        Args:
            navigation: `Navigation` or `SpatialNavigation`, NED.
            dt: since the last one, s.
            altitude: range to the bottom, m; infinite without an echo; NaN where it is not measured.
        """
        n = in_space(navigation)
        if self._state is None:
            self._state, dt = manoeuvring_begins(n, self._depth), 0.0
        self._time += dt
        self.sounded = self.sounded or not math.isnan(altitude)
        if not self.over:
            self.stop(self._left(n, dt, altitude))
        command = SPATIAL_STOP
        if not self.over:
            self._state, command = manoeuvre(self._config, self._state, n, dt)
            if self._state.leg >= len(self._config.legs):
                self.complete = True
                self.stop("all manoeuvres are flown")
        self.rows.append(ManoeuvreRow(self._time, self._state.leg, n, command))
        return command

    def _left(self, n: SpatialNavigation, dt: float, altitude: float) -> str:
        """Return which bound is left; empty: none."""
        assert self._state is not None
        b, home = self._bounds, self._state
        if not all(map(math.isfinite, n)):
            return "a navigation that is no number"
        away = max(abs(n.x - home.home_x), abs(n.y - home.home_y))
        if away > b.box:
            return f"{away:.0f} m away from the start, beyond the box of {b.box:g} m"
        if self._time > self._config.duration + b.spare_time:
            return f"{self._time:.0f} s, longer than the program"
        if (speed := self._speed(n)) > (fastest := self._vehicle.top_speed + _CURRENT):
            return f"a speed over ground of {speed:.1f} m/s, above {fastest:.1f} m/s"
        return self._left_below(n, dt, altitude) if self._vehicle.dives else ""

    def _left_below(self, n: SpatialNavigation, dt: float, altitude: float) -> str:
        assert self._state is not None
        b, held, leg = self._bounds, self._state.depth, self._config.legs[self._state.leg]
        submerges = leg.kind == SUBMERGE
        self._reached = self._reached or not submerges or abs(n.z - held) < b.dive
        if submerges and self._state.time + dt >= leg.seconds - 1e-9 and not is_at_depth(self._state, n):
            return f"not level at the depth of {held:g} m within {leg.seconds:g} s, but {n.z:.1f} m deep"
        if n.z > self._vehicle.depth.max:
            return f"{n.z:.1f} m deep, deeper than depth.max, {self._vehicle.depth.max:g} m"
        if self._reached and abs(n.z - held) > b.dive:
            return f"{n.z:.1f} m deep, more than {b.dive:g} m from the held depth of {held:g} m"
        if self.sounded and math.isnan(altitude):
            return "no altitude any more, which had been measured"
        if altitude < b.altitude:
            return f"{altitude:.1f} m above the bottom, below {b.altitude:g} m"
        if abs(n.theta) > math.radians(b.pitch_deg):
            return f"a pitch of {math.degrees(n.theta):.0f} deg, beyond {b.pitch_deg:g} deg"
        return ""

    def _speed(self, n: SpatialNavigation) -> float:
        """Return the speed over ground, m/s, over the last second."""
        for row in reversed(self.rows):
            if self._time - row.t >= _SPEED_OVER:
                before = row.navigation
                return math.hypot(n.x - before.x, n.y - before.y) / (self._time - row.t)
        return 0.0


def in_space(navigation: Any) -> SpatialNavigation:
    """Return navigation in three dimensions; that of a vehicle in the plane is level at depth 0."""
    if isinstance(navigation, SpatialNavigation):
        return navigation
    x, y, psi, r = navigation
    return SpatialNavigation(x, y, 0.0, 0.0, 0.0, psi, 0.0, r)
