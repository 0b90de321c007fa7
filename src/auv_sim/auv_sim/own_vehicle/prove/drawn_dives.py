"""Depths of a drawn course, for a vehicle with stern planes: levels and ramps between them."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from auv_path_following.curves.composite import CompositePath
from auv_path_following.curves.spatial.depth_profile import DepthProfile
from auv_path_following.curves.spatial.spatial_path import SpatialPath
from auv_path_following.vehicle import Vehicle
from auv_sim.own_vehicle.tune.trial_flights import Flight
from auv_sim.vehicle.hulls.rigid_body import body_at

#: Horizontal length of a level or a ramp over the length of the hull, drawn evenly.
SHORTEST, LONGEST = 25.0, 75.0
#: Largest mean slope of a ramp over that of the largest pitch; a smooth ramp is up to 1.9 times as steep.
STEEPEST = 0.35
#: Range of depths that a course uses below the surface depth, m.
DEEPEST = 40.0


def with_depths(flight: Flight, random: np.random.Generator) -> Flight:
    """Return a flight whose course changes its depth; it begins level, at the course's first depth.

    Args:
        flight: along a planar course, of a vehicle with stern planes.
        random: where the numbers come from.
    """
    c = flight.scenario
    spatial = drawn_dive(c.path, c.vehicle, random)
    x, y, z, _, chi = spatial.start_pose
    start = body_at(x, y, z, 0.0, 0.0, chi, c.vehicle.speed_at(c.thrust))
    return flight._replace(scenario=dataclasses.replace(c, spatial=spatial, initial=start))


def drawn_dive(path: CompositePath, vehicle: Vehicle, random: np.random.Generator) -> SpatialPath:
    """Draw depths along a planar course: in turn a level and a ramp, up or down.

    Args:
        path: the plan.
        vehicle: whose range of depth and largest pitch hold.
        random: where the numbers come from.
    """
    length = math.fsum(segment.length for segment in path.segments)
    shallow = max(vehicle.depth.surface, vehicle.shallowest)
    deep = min(vehicle.depth.max, shallow + DEEPEST)
    slope = STEEPEST * math.tan(vehicle.depth.max_pitch)
    way, depth = 0.0, random.uniform(shallow, deep)
    knots = [(way, depth)]
    is_level = True
    while length - way > LONGEST * vehicle.length:
        further = vehicle.length * random.uniform(SHORTEST, LONGEST)
        way += further
        if not is_level:
            most = slope * further
            depth = min(max(depth + random.uniform(-most, most), shallow), deep)
        is_level = not is_level
        knots.append((way, depth))
    if length - way < 1e-6 * length:
        knots.pop()
    return SpatialPath(path.segments, DepthProfile([*knots, (length, depth)], "smooth"))
