"""What is known of a vehicle before its identification: limits, length, and a hull to begin with."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeVar

import numpy as np
import pydantic
from pydantic_core import PydanticCustomError

from auv_msgs_py.settings.explanations import readable
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle as vehicle_file
from auv_path_following.abilities import LONGEST_DEAD_TIME, DepthRange, Rudder
from auv_path_following.vehicle import Hull, Vehicle
from auv_path_following.vertical_hull import VerticalHull, check_planes
from auv_sim.own_vehicle.identify.combinations import (
    REFERENCE,
    Combinations,
    Numbers,
    hull_with,
    scaled_hull,
)
from auv_sim.own_vehicle.identify.dive.dive_combinations import DiveCombinations, vertical_with

#: Shares of the largest thrust at which a thrust table is written.
_SHARES = (0.2, 0.4, 0.6, 0.8, 1.0)


def known_hull(vehicle: Vehicle) -> Hull:
    """Return the vehicle's own hull, or a similar one of its length."""
    if vehicle.hull is not None:
        return vehicle.hull
    reference = vehicle_file.load(REFERENCE)
    return scaled_hull(reference.coefficients, vehicle.length / reference.length)


def forces(vehicle: Vehicle, hull: Hull, commands: Numbers) -> Numbers:
    """Return thrust commands as forces, N.

    Commands in another unit than N follow the file's table. Without one they follow the measured speeds:
    each force is then the drag of the hull at that speed, right but for a factor.

    Args:
        vehicle: with the unit.
        hull: with the drag.
        commands: in the vehicle's unit.
    """
    if vehicle.thrust_unit == "N":
        return commands
    values, places = np.unique(commands, return_inverse=True)
    if vehicle.thrust_table:
        found = [vehicle.newtons(float(value)) for value in values]
    else:
        found = [-hull.Xuu * vehicle.speed_at(float(value)) ** 2 for value in values]
    return np.array(found)[places]


def in_plane(vehicle: Vehicle, hull: Hull) -> Vehicle:
    """Return the vehicle in the plane, by coefficients alone and with its thrust in N."""
    largest = float(forces(vehicle, hull, np.array([vehicle.thrust_max]))[0])
    return dataclasses.replace(
        vehicle, thrust_unit="N", thrust_table=(), thrust_max=largest, sternplanes=None, pitching=None,
        cruise=None, turning=None, params=None, simulated_as=None,
        hull=dataclasses.replace(hull, vertical=None),
    )  # fmt: skip


def identified_vehicle(
    vehicle: Vehicle,
    hull: Hull,
    c: Combinations,
    rate_deg_s: float,
    dead_time: float,
    dive: DiveCombinations | None = None,
    planes: tuple[float, float] | None = None,
) -> Vehicle:
    """Return the vehicle with identified coefficients; it moves by them with the masses of `hull`.

    Where the thrust has no newtons, the mass ahead is assumed too, and the file gets a table of newtons.
    Identified numbers are rounded to the digits of the file. `depth.minimum_speed` rises to the lowest speed
    at which the identified planes hold a depth.

    Args:
        vehicle: what is known.
        hull: the source of the masses.
        c: identified combinations, for forces by `forces`.
        rate_deg_s, dead_time: of the rudder, deg/s and s.
        dive: identified combinations of heave and pitch.
        planes: identified rate (deg/s) and dead time (s) of the stern planes.

    Raises:
        ConfigurationError: no vehicle file can hold what was identified.
    """
    table, c = _with_newtons(vehicle, hull, c)
    try:
        found, depth = _rounded_hull(hull_with(c, hull), hull, 5), vehicle.depth
        if dive is not None and hull.vertical is not None:
            vertical = _rounded_hull(vertical_with(dive, hull.m, hull.vertical), hull.vertical, 6)
            found, depth = dataclasses.replace(found, vertical=vertical), held_depth(vehicle, vertical)
        rudder, sternplanes = _fin(vehicle.rudder, rate_deg_s, dead_time), _planes(vehicle, planes)
        return dataclasses.replace(
            vehicle, hull=found, rudder=rudder, sternplanes=sternplanes, depth=depth, turning=None,
            params=None, thrust_table=table, assumed_within=1.0, simulated_as=None,
            cruise=None if vehicle.pitching is None else vehicle.cruise,
        )  # fmt: skip
    except pydantic.ValidationError as error:
        raise readable(error, f"{vehicle.name}: as identified", Vehicle) from None


def _fin(fin: Rudder, rate_deg_s: float, dead_time: float) -> Rudder:
    """Return a fin with an identified rate (deg/s) and dead time (s)."""
    late = round(float(min(max(dead_time, 0.0), LONGEST_DEAD_TIME)), 3)
    return dataclasses.replace(fin, max_rate_deg_s=rounded(rate_deg_s, 4), dead_time=late)


def _planes(vehicle: Vehicle, planes: tuple[float, float] | None) -> Rudder | None:
    """Return the stern planes with an identified rate (deg/s) and dead time (s), if they were identified."""
    if planes is None or vehicle.sternplanes is None:
        return vehicle.sternplanes
    return _fin(vehicle.sternplanes, *planes)


def _with_newtons(
    vehicle: Vehicle, hull: Hull, c: Combinations
) -> tuple[tuple[tuple[float, float], ...], Combinations]:
    """Return the table of newtons, and the combinations for it."""
    if vehicle.thrust_unit == "N" or vehicle.thrust_table:
        return vehicle.thrust_table, c
    mass = hull.m - hull.Xud
    thrusts = [rounded(share * vehicle.thrust_max, 6) for share in _SHARES[:-1]] + [vehicle.thrust_max]
    newtons = forces(vehicle, hull, np.array(thrusts)) * c.X1 * mass
    rows = ((a, rounded(float(b), 4)) for a, b in zip(thrusts, newtons, strict=True))
    return tuple(rows), c._replace(X1=1.0 / mass)


def rounded(value: float, digits: int) -> float:
    """Return a number rounded to significant digits."""
    return float(f"{value:.{digits}g}")


T = TypeVar("T", Hull, VerticalHull)


def _rounded_hull(found: T, known: T, digits: int) -> T:
    """Return coefficients, those that differ from the known ones rounded."""
    values: dict[str, Any] = {}
    for field in dataclasses.fields(found):
        value = getattr(found, field.name)
        if isinstance(value, float) and value != getattr(known, field.name):
            values[field.name] = rounded(value, digits)
    return dataclasses.replace(found, **values)


def held_depth(vehicle: Vehicle, vertical: VerticalHull) -> DepthRange:
    """Return the vehicle's range of depth with a speed at which planes hold an identified hull.

    Raises:
        ConfigurationError: they do at no speed up to full thrust, or the hull sinks.
    """
    assert vehicle.sternplanes is not None
    depth, fastest = vehicle.depth, vehicle.top_speed
    while True:
        try:
            check_planes(vertical, vehicle.sternplanes.max_angle_deg, depth)
        except PydanticCustomError as error:
            slowest = round(1.02 * depth.minimum_speed + 0.005, 2)
            if slowest > fastest:
                found, expected = (str((error.context or {})[key]) for key in ("found", "expected"))
                raise ConfigurationError(f"{vehicle.name}: as identified", found, expected) from None
            depth = dataclasses.replace(depth, minimum_speed=slowest)
        else:
            return depth
