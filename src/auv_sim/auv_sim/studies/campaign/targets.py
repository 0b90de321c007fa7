"""What a study can vary, by dotted names: start, water, hull, every gain, every flaw of the sea.

initial.along                           place on the path, 0 (start) to 1 (end); the others are relative to it
initial.distance, initial.bearing_deg   how far from that place, and where; clockwise from the path's course
initial.ahead, initial.starboard        the same along the course and across it, m; all of them add up
initial.heading_deg, initial.surge      off the path's course, deg; speed through the water, m/s
initial.below, initial.pitch_deg        of a vehicle that dives: m below the path there; bow up positive, deg
current.speed, current.course_deg       m/s, and where it flows to, clockwise from north
current.north, current.east             m/s; all of them add up
current.down                            of the water around a vehicle that dives, m/s
vehicle.NAME, sea.NAME                  a key of the vehicle's or the sea's file: vehicle.hull.Nuud
guidance.NAME, observer.NAME            a parameter: guidance.ailos.lookahead
autopilot.NAME, pitch.NAME              a parameter of the heading or the pitch autopilot: autopilot.nism.k1
mission, vehicle, params                a file, or the name of a shipped one
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current, SpatialCurrent
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.segment import PathPoint
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.curves.spatial.spatial_point import tangent_of
from auv_sim.sim_parameters import CRUISE
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState

#: Steps of the search for a place on a path.
_HALVINGS = 60

START = ("along", "distance", "bearing_deg", "ahead", "starboard", "heading_deg", "surge")
CURRENT = ("speed", "course_deg", "north", "east")
#: Names of `initial` and `current` for vehicles that dive only.
DIVING_START, DIVING_CURRENT = ("below", "pitch_deg"), ("down",)
#: Groups whose names are those of a settings class.
CONFIGURED = ("vehicle", "sea", "guidance", "observer", "autopilot", "pitch")
WORDS = ("mission", "vehicle", "params")


def group_of(name: str, where: str) -> tuple[str, str]:
    """Split a name: `autopilot.nism.k1` -> ``("autopilot", "nism.k1")``.

    Raises:
        ConfigurationError: nothing of this name can be varied.
    """
    group, _, rest = name.partition(".")
    known = {"initial": START + DIVING_START, "current": CURRENT + DIVING_CURRENT}.get(group)
    if (known and rest in known) or (group in CONFIGURED and rest) or name in WORDS:
        return group, rest
    names = [f"initial.({'|'.join(START + DIVING_START)})", f"current.({'|'.join(CURRENT + DIVING_CURRENT)})"]
    names += [f"{other}.NAME" for other in CONFIGURED] + list(WORDS)
    raise ConfigurationError(f"{where}: vary.{name}", "an unknown name", f"one of {', '.join(names)}")


def start(path: CompositePath, given: Mapping[str, float]) -> PlantState:
    """Return the plant's first state.

    Args:
        path: everything is relative to one of its points, by default the first, and to the course there.
        given: values by the names of `START`.
    """
    place = _point_along(path, given.get("along", 0.0))
    x, y = _beside(place, given)
    heading = place.chi + math.radians(given.get("heading_deg", 0.0))
    return PlantState(x, y, heading, given.get("surge", CRUISE), 0.0, 0.0)


def spatial_start(path: SpatialPath, given: Mapping[str, float], shallowest: float, where: str) -> BodyState:
    """Return the first state of a vehicle that dives: level in roll, by default on the path and along it.

    A path that begins above `shallowest` is begun at that depth, level.

    Args:
        path: everything is relative to one of its points, by default the first, and to the direction there.
        given: values by the names of `START` and `DIVING_START`.
        shallowest: depth at which the vehicle floats, m.
        where: what an error names as its place.

    Raises:
        ConfigurationError: `below` leads above that depth.
    """
    i, t = _place_along(path, given.get("along", 0.0))
    point = path.evaluate(i, t)
    x, y = _beside(path.plan.evaluate(i, t), given)
    along = tangent_of(point)
    z, pitch = point.z + given.get("below", 0.0), along.gamma
    if z < shallowest:
        if "below" in given:
            found = f"a start at a depth of {z:g} m"
            raise ConfigurationError(f"{where}: initial.below", found, f"one of at least {shallowest:g} m")
        z, pitch = shallowest, 0.0
    if "pitch_deg" in given:
        pitch = math.radians(given["pitch_deg"])
    heading = along.chi + math.radians(given.get("heading_deg", 0.0))
    return body_at(x, y, z, 0.0, pitch, heading, given.get("surge", CRUISE))


def _beside(place: PathPoint, given: Mapping[str, float]) -> tuple[float, float]:
    """Return north and east of a start relative to a point of the path, m."""
    away, bearing = given.get("distance", 0.0), math.radians(given.get("bearing_deg", 0.0))
    ahead = given.get("ahead", 0.0) + away * math.cos(bearing)
    starboard = given.get("starboard", 0.0) + away * math.sin(bearing)
    cos_chi, sin_chi = math.cos(place.chi), math.sin(place.chi)
    x, y = place.x + ahead * cos_chi, place.y + ahead * sin_chi
    return x - starboard * sin_chi, y + starboard * cos_chi


def _point_along(path: CompositePath, share: float) -> PathPoint:
    """Return the point behind `share` (0 to 1) of a path's length."""
    return path.evaluate(*_place_along(path, share))


def _place_along(path: CompositePath | SpatialPath, share: float) -> tuple[int, float]:
    """Return the subpath (from 0) and the t on it behind `share` (0 to 1) of a path's length."""
    to_go = (1.0 - share) * path.length
    low, high = 0.0, float(path.n)
    for _ in range(_HALVINGS if share > 0.0 else 0):
        middle = 0.5 * (low + high)
        i = min(int(middle), path.n - 1)
        low, high = (middle, high) if path.distance_to_go(i, middle - i) > to_go else (low, middle)
    i = min(int(low), path.n - 1)
    return i, low - i


def current(given: Mapping[str, float]) -> Current:
    """Return the constant current from values by the names of `CURRENT`."""
    speed, course = given.get("speed", 0.0), math.radians(given.get("course_deg", 0.0))
    return Current(
        given.get("north", 0.0) + speed * math.cos(course), given.get("east", 0.0) + speed * math.sin(course)
    )


def spatial_current(given: Mapping[str, float]) -> SpatialCurrent:
    """Return the same in three dimensions, by the names of `CURRENT` and `DIVING_CURRENT`."""
    return SpatialCurrent(*current(given), given.get("down", 0.0))
