"""The hulls that a vehicle may be: its coefficients, rudder and delay within their uncertainty."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from pathlib import Path

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


def spread_of_file(file: Path) -> dict[str, float]:
    """Return the uncertainty that the comments of a vehicle file give its coefficients, as shares.

    `(x2)` is a factor of 2 either way, `(12 %)` a share, as `vehicle.py new` and `identify` write them.
    """
    found = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        match = re.match(r"\s+(\w+): *\S+ +#.*\((?:x([0-9.]+)|([0-9.]+) %)\)", line)
        if match and match[1] in UNCERTAIN:
            found[match[1]] = float(match[2]) - 1.0 if match[2] else 0.01 * float(match[3])
    return found


def ensemble(
    vehicle: Vehicle, members: int, spread: float, random: np.random.Generator,
    own: Mapping[str, float] | None = None,
) -> list[Vehicle]:  # fmt: skip
    """Return the vehicle itself and further hulls that it may be.

    Args:
        vehicle: as its file has it.
        members: how many, the vehicle included.
        spread: half width of the uncertainty of every coefficient, of the rudder's rate and of its dead time,
            a share: from 1/(1 + spread) to 1 + spread times, drawn evenly in its logarithm.
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

    def factor(width: float) -> float:
        return math.exp(math.log1p(width) * random.uniform(-1.0, 1.0))

    factors = {name: factor(own.get(name, spread)) for name in UNCERTAIN}
    rate, late = factor(spread), factor(spread)
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
