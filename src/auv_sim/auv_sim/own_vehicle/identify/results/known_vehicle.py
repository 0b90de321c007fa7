"""What is known of a vehicle before its identification: limits, length, and a hull to begin with."""

from __future__ import annotations

import dataclasses

import numpy as np

from auv_path_following import vehicle as vehicle_file
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.own_vehicle.identify.combinations import Combinations, Numbers, hull_with, scaled_hull
from auv_sim.own_vehicle.identify.dive.dive_combinations import DiveCombinations, vertical_with

#: Where a vehicle's file has no coefficients, they are those of this vehicle, scaled to its length.
_REFERENCE = "remus100"
#: Shares of the largest thrust at which a thrust table is written.
_SHARES = (0.2, 0.4, 0.6, 0.8, 1.0)


def known_hull(vehicle: Vehicle) -> Hull:
    """Return the vehicle's own hull, or a similar one of its length."""
    if vehicle.hull is not None:
        return vehicle.hull
    reference = vehicle_file.load(_REFERENCE)
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
) -> Vehicle:
    """Return the vehicle with identified coefficients; it moves by them with the masses of `hull`.

    Where the thrust has no newtons, the mass ahead is assumed too, and the file gets a table of newtons.

    Args:
        vehicle: what is known.
        hull: the source of the masses.
        c: identified combinations, for forces by `forces`.
        rate_deg_s, dead_time: of the rudder, deg/s and s.
        dive: identified combinations of heave and pitch.
    """
    table = vehicle.thrust_table
    if vehicle.thrust_unit != "N" and not table:
        mass = hull.m - hull.Xud
        thrusts = vehicle.thrust_max * np.array(_SHARES)
        newtons = forces(vehicle, hull, thrusts) * c.X1 * mass
        table = tuple((float(a), float(b)) for a, b in zip(thrusts, newtons, strict=True))
        c = c._replace(X1=1.0 / mass)
    found = hull_with(c, hull)
    if dive is not None and found.vertical is not None:
        found = dataclasses.replace(found, vertical=vertical_with(dive, hull.m, found.vertical))
    rudder = dataclasses.replace(
        vehicle.rudder, max_rate_deg_s=rate_deg_s, dead_time=min(max(dead_time, 0.0), 2.0)
    )
    spatial = found.vertical is not None and vehicle.sternplanes is not None
    return dataclasses.replace(
        vehicle, hull=found if spatial else dataclasses.replace(found, vertical=None), rudder=rudder,
        thrust_table=table, cruise=None, turning=None, params=None, simulated_as=None,
        sternplanes=vehicle.sternplanes if spatial else None, pitching=vehicle.pitching if spatial else None,
    )  # fmt: skip
