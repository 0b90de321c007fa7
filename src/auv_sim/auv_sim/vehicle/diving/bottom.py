"""The bottom of the sea: constant, sloping, in waves, or from a table, all along one course."""

from __future__ import annotations

import math
from typing import NamedTuple

from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.values.pure import pure
from auv_sim.vehicle.currents import Profile
from auv_sim.vehicle.draws import Draws, Lookup, looked_up


@settings
class BottomWaves:
    """Sine waves of the bottom."""

    amplitude: float = setting(0.0, "half of their height", unit="m", ge=0.0)
    length: float = setting(150.0, "from crest to crest", unit="m", gt=0.0)
    phase_deg: float = setting(0.0, "at `point`; 90 is a trough, where it is deepest", unit="deg")


@settings
class BottomConfig:
    """Depth of the bottom; slope, waves and table extend along a course and add up."""

    depth: float = setting(0.0, "at `point`; 0: no bottom within reach of any instrument", unit="m", ge=0.0)
    course_deg: float = setting(0.0, "course along which it changes", unit="deg")
    point: Pair = setting((0.0, 0.0), "north and east of the point where distances begin", unit="m")
    slope: float = setting(0.0, "how much deeper for each metre along the course", ge=-1.0, le=1.0)
    waves: BottomWaves = setting(factory=BottomWaves, doc="waves")
    table: Profile = setting(
        (), "rows of distance along the course (m) and added depth (m), linear between and held outside"
    )


class Bottom(NamedTuple):
    """Numbers of a `BottomConfig`: m, rad; a depth of 0 is none."""

    depth: float
    x: float
    y: float
    cos: float
    sin: float
    slope: float
    amplitude: float
    length: float
    phase: float
    table: Lookup


def bottom_of(config: BottomConfig, draws: Draws) -> Bottom:
    """Return the numbers of a bottom."""
    course, waves = math.radians(config.course_deg), config.waves
    return Bottom(
        config.depth,
        *config.point,
        math.cos(course),
        math.sin(course),
        config.slope,
        waves.amplitude,
        waves.length,
        math.radians(waves.phase_deg),
        draws.lookup(config.table),
    )


@pure
def bottom_at(config: Bottom, x: float, y: float) -> float:
    """Return the depth of the bottom below a place, m; infinite if there is none.

    Args:
        config: the bottom.
        x, y: NED, m.
    """
    if not config.depth > 0.0:
        return math.inf
    along = (x - config.x) * config.cos + (y - config.y) * config.sin
    depth = config.depth + config.slope * along
    if config.amplitude > 0.0:
        depth += config.amplitude * math.sin(2.0 * math.pi * along / config.length + config.phase)
    return depth + looked_up(config.table, 1, along)
