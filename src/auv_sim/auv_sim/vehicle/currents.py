"""Currents: a mean that varies in time, a schedule, shear and jet in space, and a tidal ellipse."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import pydantic

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import increasing
from auv_msgs_py.values.pure import pure, squared
from auv_msgs_py.values.types import Current
from auv_sim.vehicle.draws import Draws, Lookup, RunMemory, Seed, looked_up
from auv_sim.vehicle.noise import GaussMarkov, gauss_markov, gauss_markov_of

#: Rows of [time, north, east, down].
Schedule = Annotated[tuple[tuple[float, float, float, float], ...], pydantic.AfterValidator(increasing)]
#: Rows of two numbers, the first of which increases.
Profile = Annotated[tuple[Pair, ...], pydantic.AfterValidator(increasing)]


@settings
class Variation:
    """First-order Gauss-Markov deviation from the mean, north and east alike (Fossen)."""

    deviation: float = setting(0.0, "standard deviation of each component", unit="m/s", ge=0.0, le=2.0)
    time: float = setting(120.0, "time constant", unit="s", gt=0.0)
    limit: float = setting(1.0, "largest deviation of each component", unit="m/s", ge=0.0, le=5.0)


@settings
class Shear:
    """A current that grows linearly across its course, to starboard of the line through `point`."""

    gradient: float = setting(0.0, "growth for each metre to starboard", unit="1/s", ge=-0.1, le=0.1)
    course_deg: float = setting(0.0, "course of the flow", unit="deg")
    point: Pair = setting((0.0, 0.0), "north and east of a point without this current", unit="m")
    limit: float = setting(1.0, "largest speed", unit="m/s", ge=0.0, le=5.0)


@settings
class Jet:
    """A sheared jet (Bickley): fastest on its axis, falling off as sech^2 to both sides."""

    speed: float = setting(0.0, "on the axis", unit="m/s", ge=0.0, le=5.0)
    width: float = setting(50.0, "distance at which it has fallen to 42 %", unit="m", gt=0.0)
    course_deg: float = setting(0.0, "course of the flow", unit="deg")
    point: Pair = setting((0.0, 0.0), "north and east of a point of the axis", unit="m")


@settings
class Tide:
    """A tidal ellipse, traversed by the current vector once in a period."""

    major: float = setting(0.0, "semi-major axis", unit="m/s", ge=0.0, le=5.0)
    minor: float = setting(
        0.0, "semi-minor axis; negative turns counter-clockwise", unit="m/s", ge=-5.0, le=5.0
    )
    course_deg: float = setting(0.0, "course of the long axis", unit="deg")
    period: float = setting(44714.16, "12.42 h: the principal lunar tide", unit="s", gt=0.0)
    phase_deg: float = setting(0.0, "at the start; 0 is full flow along the course", unit="deg")


@settings
class Upwelling:
    """A vertical current, positive upwards; only a vehicle that dives is in it."""

    mean: float = setting(0.0, "mean speed; negative is downwards", unit="m/s", ge=-1.0, le=1.0)
    deviation: float = setting(0.0, "standard deviation of its variation", unit="m/s", ge=0.0, le=1.0)
    time: float = setting(120.0, "time constant of its variation", unit="s", gt=0.0)
    limit: float = setting(0.3, "largest deviation from the mean", unit="m/s", ge=0.0, le=1.0)


@settings
class CurrentConfig:
    """All parts add up; each is off by default."""

    mean: Pair = setting((0.0, 0.0), "towards north and east", unit="m/s")
    variation: Variation = setting(factory=Variation, doc="in time")
    shear: Shear = setting(factory=Shear, doc="in space: growing across")
    jet: Jet = setting(factory=Jet, doc="in space: a jet")
    tide: Tide = setting(factory=Tide, doc="in time: a tidal ellipse")
    schedule: Schedule = setting(
        (),
        "in time: rows of time (s) and speeds north, east, down (m/s), linear between and held outside; "
        "down is for a vehicle that dives",
    )
    upwelling: Upwelling = setting(factory=Upwelling, doc="vertical current")
    over_depth: Profile = setting(
        (),
        "for a vehicle that dives: rows of depth (m) and the factor of the sea's horizontal current there, "
        "linear between and held outside; none: 1 everywhere",
    )


class Heading(NamedTuple):
    """Cosine and sine of a course."""

    cos: float
    sin: float


class ShearFlow(NamedTuple):
    """Numbers of a `Shear`: 1/s, m/s, m north and east."""

    gradient: float
    limit: float
    x: float
    y: float
    course: Heading


class JetFlow(NamedTuple):
    """Numbers of a `Jet`: m/s, m, m north and east."""

    speed: float
    width: float
    x: float
    y: float
    course: Heading


class TideFlow(NamedTuple):
    """Numbers of a `Tide`: m/s, s, rad; the courses of both axes."""

    major: float
    minor: float
    period: float
    phase: float
    course: Heading
    across: Heading


class Water(NamedTuple):
    """Configuration of the sea's own current; mean and variation are north and east."""

    mean: Current
    north: GaussMarkov
    east: GaussMarkov
    shear: ShearFlow
    jet: JetFlow
    tide: TideFlow
    schedule: Lookup


def water_of(config: CurrentConfig, seed: Seed, draws: Draws) -> tuple[Water, float, float]:
    """Return the configuration of the water, and north and east of the first deviation from its mean, m/s.

    Args:
        config: the parts.
        seed: of its generators.
        draws: of the run.
    """
    v, s, j, t = config.variation, config.shear, config.jet, config.tide
    north, Vx = gauss_markov_of(v.deviation, v.time, (*seed, 0), draws, v.limit)
    east, Vy = gauss_markov_of(v.deviation, v.time, (*seed, 1), draws, v.limit)
    tide = TideFlow(
        t.major,
        t.minor,
        t.period,
        math.radians(t.phase_deg),
        _heading(t.course_deg),
        _heading(t.course_deg + 90.0),
    )
    shear = ShearFlow(s.gradient, s.limit, *s.point, _heading(s.course_deg))
    jet = JetFlow(j.speed, j.width, *j.point, _heading(j.course_deg))
    schedule = draws.lookup(config.schedule)
    return Water(Current(*config.mean), north, east, shear, jet, tide, schedule), Vx, Vy


def _heading(course_deg: float) -> Heading:
    course = math.radians(course_deg)
    return Heading(math.cos(course), math.sin(course))


@pure
def vary(config: Water, north: float, east: float, memory: RunMemory, dt: float) -> tuple[float, float]:
    """Return north and east of the deviation from the mean `dt` seconds later, m/s."""
    return gauss_markov(config.north, north, memory, dt), gauss_markov(config.east, east, memory, dt)


@pure
def flow(config: Water, north: float, east: float, x: float, y: float, time: float) -> Current:
    """Return the velocity of the water at a place, m/s, NED.

    The plant holds it constant over a step and neglects the hull's inertia against its changes, which is
    valid while the water changes slowly relative to the hull's time constant of one or two seconds.

    Args:
        config: the parts.
        north, east: deviation from the mean, m/s.
        x, y: NED, m.
        time: since the start, s.
    """
    Vx, Vy = config.mean.Vx + north, config.mean.Vy + east
    shear, jet, tide = config.shear, config.jet, config.tide
    if shear.gradient != 0.0:
        speed = shear.gradient * _across(x, y, shear.x, shear.y, shear.course)
        speed = min(max(speed, -shear.limit), shear.limit)
        Vx, Vy = Vx + speed * shear.course.cos, Vy + speed * shear.course.sin
    if jet.speed > 0.0:
        far = min(abs(_across(x, y, jet.x, jet.y, jet.course)) / jet.width, 300.0)
        speed = jet.speed / squared(math.cosh(far))
        Vx, Vy = Vx + speed * jet.course.cos, Vy + speed * jet.course.sin
    if tide.major > 0.0 or tide.minor != 0.0:
        turn = 2.0 * math.pi * time / tide.period + tide.phase
        major, minor = tide.major * math.cos(turn), tide.minor * math.sin(turn)
        Vx, Vy = Vx + major * tide.course.cos, Vy + major * tide.course.sin
        Vx, Vy = Vx + minor * tide.across.cos, Vy + minor * tide.across.sin
    if config.schedule.rows > 0:
        Vx += looked_up(config.schedule, 1, time)
        Vy += looked_up(config.schedule, 2, time)
    return Current(Vx, Vy)


@pure
def _across(x: float, y: float, x0: float, y0: float, course: Heading) -> float:
    """Return the distance of (x, y) to starboard of the line through (x0, y0), m."""
    return -(x - x0) * course.sin + (y - y0) * course.cos
