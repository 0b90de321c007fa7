"""What a study can vary, by dotted names: start, water, hull, every gain, every flaw of the sea.

initial.along                           place on the path, 0 (start) to 1 (end); the others are relative to it
initial.distance, initial.bearing_deg   how far from that place, and where; clockwise from the path's course
initial.ahead, initial.starboard        the same along the course and across it, m; all of them add up
initial.heading_deg, initial.surge      off the path's course, deg; speed through the water, m/s
current.speed, current.course_deg       m/s, and where it flows to, clockwise from north
current.north, current.east             m/s; all of them add up
vehicle.NAME, sea.NAME                  a key of the vehicle's or the sea's file: vehicle.hull.Nuud
guidance.NAME, observer.NAME, autopilot.NAME        a parameter: autopilot.nism.k1
mission, vehicle, params                a file, or the name of a shipped one
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from auv_msgs_py.values.errors import ConfigurationError
from auv_msgs_py.values.types import Current
from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.segment import PathPoint
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.vehicle import Vehicle
from auv_sim.sim_parameters import CRUISE
from auv_sim.vehicle.hulls.rigid_body import BodyState, body_at
from auv_sim.vehicle.remus import PlantState

#: Steps of the search for a place on a path.
_HALVINGS = 60

START = ("along", "distance", "bearing_deg", "ahead", "starboard", "heading_deg", "surge")
CURRENT = ("speed", "course_deg", "north", "east")
#: Groups whose names are those of a settings class.
CONFIGURED = ("vehicle", "sea", "guidance", "observer", "autopilot")
WORDS = ("mission", "vehicle", "params")


def group_of(name: str, where: str) -> tuple[str, str]:
    """Split a name: `autopilot.nism.k1` -> ``("autopilot", "nism.k1")``.

    Raises:
        ConfigurationError: nothing of this name can be varied.
    """
    group, _, rest = name.partition(".")
    known = {"initial": START, "current": CURRENT}.get(group)
    if (known and rest in known) or (group in CONFIGURED and rest) or name in WORDS:
        return group, rest
    names = [f"initial.({'|'.join(START)})", f"current.({'|'.join(CURRENT)})"]
    names += [f"{other}.NAME" for other in CONFIGURED] + list(WORDS)
    raise ConfigurationError(f"{where}: vary.{name}", "an unknown name", f"one of {', '.join(names)}")


def start(path: CompositePath, given: Mapping[str, float]) -> PlantState:
    """Return the plant's first state.

    Args:
        path: everything is relative to one of its points, by default the first, and to the course there.
        given: values by the names of `START`.
    """
    place = _point_along(path, given.get("along", 0.0))
    x, y, chi = place.x, place.y, place.chi
    away, bearing = given.get("distance", 0.0), math.radians(given.get("bearing_deg", 0.0))
    ahead = given.get("ahead", 0.0) + away * math.cos(bearing)
    starboard = given.get("starboard", 0.0) + away * math.sin(bearing)
    cos_chi, sin_chi = math.cos(chi), math.sin(chi)
    return PlantState(
        x + ahead * cos_chi - starboard * sin_chi,
        y + ahead * sin_chi + starboard * cos_chi,
        chi + math.radians(given.get("heading_deg", 0.0)),
        given.get("surge", CRUISE),
        0.0,
        0.0,
    )


def diving_start(start: PlantState, path: SpatialPath | None, vehicle: Vehicle) -> BodyState:
    """Return the first state of a vehicle that dives.

    Args:
        start: its place, heading and speed.
        path: that it starts on; None for a planar one, which is flown at the surface depth.
        vehicle: for its surface depth, and the depth at which it floats.
    """
    surface, floating = vehicle.depth.surface, vehicle.shallowest
    depth, gamma = (surface, 0.0) if path is None else (path.start_pose.z, path.start_pose.gamma)
    if depth < floating:
        depth, gamma = floating, 0.0
    return body_at(start.x, start.y, depth, 0.0, gamma, start.psi, start.ur)


def _point_along(path: CompositePath, share: float) -> PathPoint:
    """Return the point behind `share` (0 to 1) of a path's length."""
    to_go = (1.0 - share) * path.length
    low, high = 0.0, float(path.n)
    for _ in range(_HALVINGS if share > 0.0 else 0):
        middle = 0.5 * (low + high)
        i = min(int(middle), path.n - 1)
        low, high = (middle, high) if path.distance_to_go(i, middle - i) > to_go else (low, middle)
    return path.at(low)


def current(given: Mapping[str, float]) -> Current:
    """Return the constant current from values by the names of `CURRENT`."""
    speed, course = given.get("speed", 0.0), math.radians(given.get("course_deg", 0.0))
    return Current(
        given.get("north", 0.0) + speed * math.cos(course), given.get("east", 0.0) + speed * math.sin(course)
    )
