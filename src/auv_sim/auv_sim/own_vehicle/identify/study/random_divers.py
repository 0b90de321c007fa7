"""Vehicles with stern planes and random hulls of 1 to 5 m, from seeds."""

from __future__ import annotations

import dataclasses
import itertools
from typing import Any

import numpy as np
import pydantic
from pydantic_core import PydanticCustomError

from auv_path_following import vehicle as vehicle_file
from auv_path_following.abilities import DepthRange
from auv_path_following.vehicle import Hull, Rudder, Vehicle
from auv_path_following.vertical_hull import VerticalHull, check_planes
from auv_sim.own_vehicle.identify.combinations import scaled_hull
from auv_sim.own_vehicle.identify.dive.dive_combinations import (
    DIVING_REFERENCE,
    dive_combinations_of,
    scaled_vertical,
)

#: Lengths, m; speeds at full thrust, m/s; buoyancy less the weight, N.
LENGTHS, SPEEDS, BUOYANCIES = (1.0, 5.0), (1.3, 2.2), (-3.0, 6.0)
#: Coefficients that are drawn, each by a factor between 1/2 and 2, and inertia, between 0.7 and 1.4.
_DRAWN = ("Zww", "Zqq", "Zuw", "Zuq", "Zuud", "Mww", "Mqq", "Muw", "Muq", "Muud", "Zwd", "Zqd", "Mqd", "zg")
#: A drawn hull that pitches or heaves away faster than this with its planes held is drawn again, 1/s.
_FASTEST = 1.0


def random_diver(seed: int) -> Vehicle:
    """Return a vehicle that dives, its shape round that of REMUS 100.

    Every coefficient of heave and pitch is multiplied by a factor between 1/2 and 2; the rates of the fins
    too. Dead times are between 0 and 0.15 s. Couplings follow from the added masses.

    Args:
        seed: of the draws.
    """
    for attempt in itertools.count():
        generator = np.random.default_rng((17, seed, attempt))
        vehicle = _drawn(seed, generator)
        if vehicle is not None and _is_held(vehicle):
            return vehicle
    raise AssertionError


def known_diver(length: float) -> Hull:
    """Return what is known of a hull beforehand: REMUS 100, scaled to its length and trimmed."""
    base = vehicle_file.load(DIVING_REFERENCE)
    assert base.coefficients.vertical is not None
    ratio = length / base.length
    vertical = scaled_vertical(base.coefficients.vertical, ratio)
    trimmed = dataclasses.replace(vertical, B=vertical.W)
    return dataclasses.replace(scaled_hull(base.coefficients, ratio), vertical=trimmed)


def _drawn(seed: int, generator: np.random.Generator) -> Vehicle | None:
    base = vehicle_file.load(DIVING_REFERENCE)
    assert base.sternplanes is not None and base.coefficients.vertical is not None
    length = float(LENGTHS[0] * (LENGTHS[1] / LENGTHS[0]) ** generator.uniform())
    ratio, speed = length / base.length, float(generator.uniform(*SPEEDS))
    hull = scaled_hull(base.coefficients, ratio)
    rates = base.rudder.max_rate_deg_s * 2.0 ** generator.uniform(-1.0, 1.0, 2)
    late = generator.uniform(0.0, 0.15, 2)
    try:
        vertical = _vertical(base.coefficients.vertical, ratio, generator)
        return dataclasses.replace(
            base,
            name=f"random diver {seed}",
            length=length,
            thrust_max=-hull.Xuu * speed * speed,
            rudder=_fin(base.rudder, rates[0], late[0]),
            sternplanes=_fin(base.sternplanes, rates[1], late[1]),
            depth=DepthRange(minimum_speed=0.6 * speed, allow_sinking=True),
            hull=dataclasses.replace(hull, vertical=vertical, **_of_revolution(vertical)),
            params=None,
        )
    except (pydantic.ValidationError, PydanticCustomError):
        return None


def _fin(fin: Rudder, rate: float, late: float) -> Rudder:
    return dataclasses.replace(fin, max_rate_deg_s=float(rate), dead_time=float(late))


def _vertical(base: VerticalHull, ratio: float, generator: np.random.Generator) -> VerticalHull:
    c = scaled_vertical(base, ratio)
    values = {name: getattr(c, name) * 2.0 ** float(generator.uniform(-1.0, 1.0)) for name in _DRAWN}
    values["Iyy"] = c.Iyy * 2.0 ** float(generator.uniform(-0.5, 0.5))
    values["B"] = c.W + float(generator.uniform(*BUOYANCIES))
    heave, arm, pitch = values["Zwd"], values["Zqd"], values["Mqd"]
    # By the definitions of added mass on a body of revolution.
    values |= {"Mwd": arm, "Xwq": heave, "Xqq": arm, "Zvp": heave, "Zrp": -arm, "Mvp": arm}
    values |= {"Mrp": c.Kpd - pitch, "Ywp": -heave, "Ypq": -arm, "Nwp": arm, "Npq": pitch - c.Kpd}
    return dataclasses.replace(c, **values)


def _of_revolution(vertical: VerticalHull) -> dict[str, Any]:
    """Return inertia and added masses of sway and yaw: on a body of revolution, those of heave and pitch."""
    c = vertical
    return {
        "Izz": c.Iyy, "Yvd": c.Zwd, "Yrd": -c.Zqd, "Nvd": -c.Mwd, "Nrd": c.Mqd, "Xvr": -c.Zwd, "Xrr": c.Zqd,
    }  # fmt: skip


def _is_held(vehicle: Vehicle) -> bool:
    """Return whether planes hold the hull at the program's lowest speed, and the hull does not pitch away."""
    vertical, planes = vehicle.coefficients.vertical, vehicle.sternplanes
    assert vertical is not None and planes is not None
    try:
        check_planes(vertical, 0.5 * planes.max_angle_deg, vehicle.depth)
    except PydanticCustomError:
        return False
    return fastest_growth(vehicle, vehicle.top_speed) < _FASTEST


def fastest_growth(vehicle: Vehicle, speed: float) -> float:
    """Return the fastest growth of a deviation from level motion with the planes held, 1/s."""
    vertical = vehicle.coefficients.vertical
    assert vertical is not None
    c = dive_combinations_of(vehicle.coefficients.m, vertical)
    matrix = [[0.0, 0.0, 1.0], [c.Zsin, c.Zuw * speed, c.Zuq * speed], [c.Msin, c.Muw * speed, c.Muq * speed]]
    return float(np.linalg.eigvals(np.array(matrix, dtype=float)).real.max())
