"""Vehicles with random hulls, stable and unstable in yaw, from seeds."""

from __future__ import annotations

import dataclasses
import itertools
import math

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle as vehicle_file
from auv_path_following.control.hull_model import HullModel
from auv_path_following.vehicle import Hull, Vehicle
from auv_sim.own_vehicle.identify.combinations import combinations_of
from auv_sim.own_vehicle.identify.hull_abilities import pole_of, speed_of

#: Bounds of a hull that is drawn: largest drift in the tightest turn (rad) and fastest growth (1/s).
_LARGEST_DRIFT, _FASTEST = math.radians(46.0), 4.0


def random_vehicle(seed: int, stable: bool) -> Vehicle:
    """Return a vehicle round REMUS 100 whose hull turns steadily.

    Every coefficient is multiplied by a factor between 1/2 and 2, masses by one between 0.7 and 1.4; the
    rudder rate too; the rudder's dead time is between 0 and 0.15 s. A stable hull has little of Nuv, which
    makes hulls diverge, and more damping.

    Args:
        seed: of the draws.
        stable: whether the hull returns to straight ahead with a neutral rudder.
    """
    base = vehicle_file.load("remus100")
    for attempt in itertools.count():
        generator = np.random.default_rng((seed, attempt, int(stable)))
        rate = base.rudder.max_rate_deg_s * 2.0 ** generator.uniform(-1.0, 1.0)
        dead_time = float(generator.uniform(0.0, 0.15))
        hull = _drawn(base.coefficients, generator, stable)
        rudder = dataclasses.replace(base.rudder, max_rate_deg_s=float(rate), dead_time=dead_time)
        vehicle = dataclasses.replace(base, name=f"random {seed}", hull=hull, rudder=rudder)
        if _turns(vehicle, stable):
            return vehicle
    raise AssertionError


def _drawn(hull: Hull, generator: np.random.Generator, stable: bool) -> Hull:
    values = {}
    for field in dataclasses.fields(hull):
        value = getattr(hull, field.name)
        if isinstance(value, float):
            largest = 0.5 if field.name in ("m", "Izz") else 1.0
            values[field.name] = value * 2.0 ** float(generator.uniform(-largest, largest))
    if stable:
        values["Nuv"] *= float(generator.uniform(-0.05, 0.15))
        values["Nur"] *= float(generator.uniform(2.0, 4.0))
        values["Yuv"] *= float(generator.uniform(1.0, 2.0))
    return dataclasses.replace(hull, **values)


def _turns(vehicle: Vehicle, stable: bool) -> bool:
    c = combinations_of(vehicle.coefficients)
    pole = pole_of(c, speed_of(c, vehicle.thrust_max))
    if pole > _FASTEST or (pole < 0.0) != stable:
        return False
    try:
        ur, vr, _ = HullModel(vehicle).steady_motion(vehicle.thrust_max, vehicle.rudder.max_angle)
    except ConfigurationError:
        return False
    return math.atan2(abs(vr), ur) < _LARGEST_DRIFT
