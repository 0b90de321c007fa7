"""Water that moves: a mean current that varies in time, sheared and jet-like in space, turned by the tide."""

from __future__ import annotations

import math

from auv_msgs_py.settings import Pair, setting, settings
from auv_msgs_py.types import Current
from auv_sim.plant.noise import GaussMarkov, Seed


@settings
class Variation:
    """First-order Gauss-Markov deviation from the mean, north and east alike (Fossen)."""

    deviation: float = setting(0.0, "standard deviation of each component", unit="m/s", ge=0.0, le=2.0)
    time: float = setting(120.0, "time in which it forgets itself", unit="s", gt=0.0)
    limit: float = setting(1.0, "largest deviation of each component", unit="m/s", ge=0.0, le=5.0)


@settings
class Shear:
    """A current that grows linearly across its course: to starboard of the line through `point`."""

    gradient: float = setting(0.0, "growth for each metre to starboard", unit="1/s", ge=-0.1, le=0.1)
    course_deg: float = setting(0.0, "where it flows to", unit="deg")
    point: Pair = setting((0.0, 0.0), "north and east of a point without this current", unit="m")
    limit: float = setting(1.0, "it grows no further than to this", unit="m/s", ge=0.0, le=5.0)


@settings
class Jet:
    """A sheared jet (Bickley): fastest on its axis, falling off as sech^2 to both sides."""

    speed: float = setting(0.0, "on the axis", unit="m/s", ge=0.0, le=5.0)
    width: float = setting(50.0, "where it has fallen to 42 %", unit="m", gt=0.0)
    course_deg: float = setting(0.0, "where it flows to", unit="deg")
    point: Pair = setting((0.0, 0.0), "north and east of a point of the axis", unit="m")


@settings
class Tide:
    """A tidal ellipse: the tip of the current's arrow runs round it once in a period."""

    major: float = setting(0.0, "half of the long axis", unit="m/s", ge=0.0, le=5.0)
    minor: float = setting(
        0.0, "half of the short axis; negative turns counter-clockwise", unit="m/s", ge=-5.0, le=5.0
    )
    course_deg: float = setting(0.0, "course of the long axis", unit="deg")
    period: float = setting(44714.16, "12.42 h: the principal lunar tide", unit="s", gt=0.0)
    phase_deg: float = setting(0.0, "at the start; 0 is full flow along the course", unit="deg")


@settings
class CurrentConfig:
    """All parts add up; each is off by default."""

    mean: Pair = setting((0.0, 0.0), "towards north and east", unit="m/s")
    variation: Variation = setting(factory=Variation, doc="in time")
    shear: Shear = setting(factory=Shear, doc="in space: growing across")
    jet: Jet = setting(factory=Jet, doc="in space: a jet")
    tide: Tide = setting(factory=Tide, doc="in time: a tidal ellipse")


class WaterCurrent:
    """The velocity of the water where the vehicle is.

    The plant takes it as constant over a step and the hull's inertia against its changes as nothing, which
    holds while the water changes slowly against the hull's own second or two.

    Args:
        config: the parts.
        seed: of its generators.
    """

    def __init__(self, config: CurrentConfig, seed: Seed) -> None:
        self.config = config
        v = config.variation
        self._north = GaussMarkov(v.deviation, v.time, (*seed, 0), v.limit)
        self._east = GaussMarkov(v.deviation, v.time, (*seed, 1), v.limit)
        self.reset()

    def reset(self) -> None:
        """Begin the same run again."""
        self._north.reset()
        self._east.reset()
        self._time = 0.0

    def update(self, x: float, y: float, dt: float) -> Current:
        """The current at (x, y) (m, NED) `dt` seconds later, m/s, NED."""
        self._time += dt
        self._north.update(dt)
        self._east.update(dt)
        return self.at(x, y)

    def at(self, x: float, y: float) -> Current:
        """The present current at a place (m, NED), m/s, NED."""
        c = self.config
        Vx, Vy = c.mean[0] + self._north.value, c.mean[1] + self._east.value
        if c.shear.gradient:
            s = c.shear
            speed = s.gradient * _across(x, y, s.point, s.course_deg)
            Vx, Vy = _along(Vx, Vy, min(max(speed, -s.limit), s.limit), s.course_deg)
        if c.jet.speed:
            j = c.jet
            far = min(abs(_across(x, y, j.point, j.course_deg)) / j.width, 300.0)
            Vx, Vy = _along(Vx, Vy, j.speed / math.cosh(far) ** 2, j.course_deg)
        if c.tide.major or c.tide.minor:
            t = c.tide
            turn = 2.0 * math.pi * self._time / t.period + math.radians(t.phase_deg)
            Vx, Vy = _along(Vx, Vy, t.major * math.cos(turn), t.course_deg)
            Vx, Vy = _along(Vx, Vy, t.minor * math.sin(turn), t.course_deg + 90.0)
        return Current(Vx, Vy)


def _across(x: float, y: float, point: Pair, course_deg: float) -> float:
    """Metres to starboard of the line through `point`."""
    course = math.radians(course_deg)
    return -(x - point[0]) * math.sin(course) + (y - point[1]) * math.cos(course)


def _along(Vx: float, Vy: float, speed: float, course_deg: float) -> tuple[float, float]:
    course = math.radians(course_deg)
    return Vx + speed * math.cos(course), Vy + speed * math.sin(course)
