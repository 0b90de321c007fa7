"""Coefficients of heave, roll and pitch of a hull of which little is given, by similarity."""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import pydantic_core

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import vehicle
from auv_path_following.abilities import DepthRange
from auv_path_following.hull_coefficients import GRAVITY, Hull
from auv_path_following.vertical_hull import VerticalHull, check_planes
from auv_sim.own_vehicle.new.assumed_hull import Assumed
from auv_sim.own_vehicle.new.owner_facts import OwnerFacts

#: Buoyancy over weight, from the usual one down to one that slow vehicles can hold.
_BUOYANCIES = (1.011, 1.006, 1.003, 1.001)
#: Centre of gravity below that of buoyancy, in diameters, and the least lift of the planes over the rudder's.
_STABILITIES, _LEAST_LIFT = (0.005, 0.15), 0.15
#: Depths of the range: largest (m), and the shallowest in diameters.
_DEEPEST, _SURFACE = 100.0, 2.6
#: Powers of (mass, length, diameter) with which coefficients grow.
_POWERS: dict[tuple[float, float, float], tuple[str, ...]] = {
    (1.0, 0.0, 0.0): ("Xwq", "Ywp", "Zuq", "Zvp", "Zwd", "Mww", "Muw", "Muud"),
    (1.0, 1.0, 0.0): ("Xqq", "Ypq", "Zqq", "Zrp", "Zqd", "Muq", "Mvp", "Mwd", "Nwp"),
    (1.0, 2.0, 0.0): ("Iyy", "Mqq", "Mrp", "Mqd", "Npq"),
    (1.0, -1.0, 0.0): ("Zww", "Zuw", "Zuud"),
    (1.0, 0.0, 2.0): ("Ixx", "Kpd", "Kpp"),
    (1.0, -1.0, 2.0): ("Kup",),
    (0.0, 0.0, 1.0): ("Kprop", "diameter"),
}


class AssumedDiver(NamedTuple):
    """Result: the hull with its vertical coefficients, and the range of depth in which its planes hold it."""

    hull: Hull
    depth: DepthRange


def assumed_diver(assumed: Assumed, facts: OwnerFacts) -> AssumedDiver:
    """Return the hull of a vehicle with stern planes.

    Raises:
        ConfigurationError: the planes cannot dive the hull like this, or hold it at no speed.
    """
    assert facts.planes_deg is not None
    reference = vehicle.load("remus100_6dof_corrected").coefficients.vertical
    assert reference is not None
    mu, size = assumed.mass_ratio, assumed.length_ratio
    stout = size if facts.diameter is None else facts.diameter / reference.diameter
    changes = {
        name: getattr(reference, name) * mu**mass * size**length * stout**diameter
        for (mass, length, diameter), names in _POWERS.items()
        for name in names
    }
    # The planes have the rudder's lift: the hull is one of revolution.
    hull = assumed.hull
    changes |= {"Zuud": -hull.Yuud, "Muud": hull.Nuud, "Iyy": hull.Izz}
    weight = hull.m * GRAVITY
    vertical = dataclasses.replace(
        reference, **changes, W=weight, B=_BUOYANCIES[0] * weight, zg=reference.zg * stout
    )
    vertical = _diving(vertical, facts)
    vertical, slowest = _held(vertical, facts)
    surface = round(_SURFACE * vertical.diameter, 2)
    depth = DepthRange(max=_DEEPEST, surface=surface, minimum_speed=slowest)
    return AssumedDiver(dataclasses.replace(hull, vertical=vertical), depth)


def _diving(vertical: VerticalHull, facts: OwnerFacts) -> VerticalHull:
    """Return the hull with the given dive rate: in a steady dive the moments of planes and weight balance.

    Its centre of gravity is moved; where it would have to be too low, the planes are smaller than the rudder.
    """
    least, most = (share * vertical.diameter for share in _STABILITIES)
    if facts.dive_rate is None:
        return dataclasses.replace(vertical, zg=min(max(vertical.zg, least), most))
    moment = abs(vertical.Muud) * facts.speed**2 * math.radians(facts.planes_deg or 0.0)
    zg = moment * facts.speed / (vertical.W * facts.dive_rate)
    lift = min(1.0, most / zg)
    if zg < least or lift < _LEAST_LIFT:
        slow, fast = (moment * facts.speed / (vertical.W * arm) for arm in (most / _LEAST_LIFT, least))
        raise ConfigurationError(
            "--dive-rate",
            f"{facts.dive_rate:g} m/s with {facts.planes_deg:g} deg of planes at {facts.speed:g} m/s",
            f"{slow:.2g} to {min(fast, 0.95 * facts.speed):.2g} m/s for a hull of this size",
        )
    return dataclasses.replace(vertical, zg=lift * zg, Muud=lift * vertical.Muud, Zuud=lift * vertical.Zuud)


def _held(vertical: VerticalHull, facts: OwnerFacts) -> tuple[VerticalHull, float]:
    """Return the hull with a buoyancy that its planes hold, and the speed from which they do, m/s."""
    for buoyancy in _BUOYANCIES:
        hull = dataclasses.replace(vertical, B=buoyancy * vertical.W)
        for step in range(6, 15):
            speed = round(0.05 * step * facts.speed, 2)
            try:
                check_planes(hull, facts.planes_deg or 0.0, DepthRange(minimum_speed=speed))
            except pydantic_core.PydanticCustomError:
                continue
            return hull, speed
    raise ConfigurationError(
        "--planes", f"{facts.planes_deg:g} deg", f"planes that hold a depth at {0.7 * facts.speed:.2g} m/s"
    )
