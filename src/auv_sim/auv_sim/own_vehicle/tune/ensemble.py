"""The hulls that a vehicle may be: its coefficients, rudder and delay within their uncertainty."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.vehicle import Hull, Rudder, Vehicle

#: Coefficients of the planar motion; the mass is weighed.
UNCERTAIN = (
    "Xuu", "Xud", "Xvr", "Xrr", "Yvv", "Yvd", "Yrr", "Yrd", "Yur", "Yuv", "Yuud",
    "Nvv", "Nvd", "Nrr", "Nrd", "Nur", "Nuv", "Nuud",
)  # fmt: skip
#: Draws after which a spread is refused that leaves no hull that can exist and turns steadily.
_MOST_DRAWS = 200


def planar(vehicle: Vehicle) -> Vehicle:
    """Return a vehicle's part in the horizontal plane where its file has coefficients, else the vehicle."""
    if vehicle.hull is None or not vehicle.dives:
        return vehicle
    hull = dataclasses.replace(vehicle.hull, vertical=None)
    return dataclasses.replace(vehicle, hull=hull, sternplanes=None, pitching=None)


def is_simulated(vehicle: Vehicle) -> bool:
    """Return whether the simulator can fly a vehicle."""
    return vehicle.hull is not None or vehicle.simulated_as is not None


def check_simulated(vehicle: Vehicle) -> None:
    """Check that the simulator can fly a vehicle.

    Raises:
        ConfigurationError: its file has neither coefficients nor a hull that the simulator has.
    """
    if not is_simulated(vehicle):
        expected = "coefficients: `vehicle.py new` writes them from length, speed and turning radius"
        raise ConfigurationError(f"{vehicle.name}: hull", "nothing", expected)


def ensemble(
    vehicle: Vehicle, members: int, spread: float, random: np.random.Generator,
    own: Mapping[str, float] | None = None,
) -> list[Vehicle]:  # fmt: skip
    """Return the vehicle itself and further hulls that it may be.

    Args:
        vehicle: as its file has it.
        members: how many, the vehicle included.
        spread: half width of the uncertainty of every coefficient, of the rudder's rate and of its dead time,
            a share; drawn evenly.
        random: where the numbers come from.
        own: half widths of single coefficients, shares, in place of `spread`.

    Raises:
        ConfigurationError: a spread for a hull without coefficients, or one within which no hull turns.
    """
    if members > 1 and vehicle.hull is None and (spread > 0.0 or own):
        found = "a hull that the simulator has as a program"
        raise ConfigurationError(f"{vehicle.name}: --spread", found, "coefficients to vary, or --members 1")
    hulls = [vehicle]
    for _ in range(_MOST_DRAWS):
        if len(hulls) >= members:
            return hulls
        drawn = _drawn(vehicle, spread, random, own or {})
        if drawn is not None:
            hulls.append(drawn)
    raise ConfigurationError(
        f"{vehicle.name}: --spread", f"{100 * spread:g} %", "one within which hulls turn"
    )


def _drawn(
    vehicle: Vehicle, spread: float, random: np.random.Generator, own: Mapping[str, float]
) -> Vehicle | None:
    hull = vehicle.coefficients
    factors = {name: 1.0 + own.get(name, spread) * random.uniform(-1.0, 1.0) for name in UNCERTAIN}
    rate, late = (1.0 + spread * random.uniform(-1.0, 1.0) for _ in range(2))
    try:
        other: Hull = dataclasses.replace(
            hull, **{name: getattr(hull, name) * factor for name, factor in factors.items()}
        )
        drawn = dataclasses.replace(vehicle, hull=other, rudder=_other(vehicle.rudder, rate, late))
        response_of(drawn)
    except (ConfigurationError, ValueError):
        return None
    return drawn


def _other(rudder: Rudder, rate: float, late: float) -> Rudder:
    return dataclasses.replace(
        rudder, max_rate_deg_s=rudder.max_rate_deg_s * rate, dead_time=rudder.dead_time * late
    )
