"""The hulls that a vehicle may be: its coefficients, rudder and delay within their uncertainty."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.abilities import LONGEST_DEAD_TIME
from auv_path_following.control.pitch_plane import pitch_plane_of
from auv_path_following.control.rule.fin_response import response_of
from auv_path_following.vehicle import Hull, Rudder, Vehicle

#: Coefficients of the planar motion; the mass is weighed.
UNCERTAIN = (
    "Xuu", "Xud", "Xvr", "Xrr", "Yvv", "Yvd", "Yrr", "Yrd", "Yur", "Yuv", "Yuud",
    "Nvv", "Nvd", "Nrr", "Nrd", "Nur", "Nuv", "Nuud",
)  # fmt: skip
#: Coefficients of heave and pitch, of a hull that dives; weight and buoyancy are weighed.
UNCERTAIN_DIVING = (
    "Zww", "Zqq", "Zuw", "Zuq", "Zwd", "Zqd", "Zuud", "Mww", "Mqq", "Muw", "Muq", "Mwd", "Mqd", "Muud",
)  # fmt: skip
#: Settings of a fin that vary with them; those of the stern planes by names of their own.
RUDDER = ("max_rate_deg_s", "dead_time")
PLANES = {name: f"sternplanes.{name}" for name in RUDDER}
#: Comments of a number that is unknown in its size, and the factor within which it then may be wrong.
_UNKNOWN, _UNKNOWN_FACTOR = ("not known from these data", "stable and unstable hulls exist"), 2.0
#: Draws in a row without a hull that can exist and turns steadily, after which a spread is refused.
_MOST_DRAWS = 200
#: Largest factor of a stated uncertainty, either way.
_MOST_FACTOR = 10.0
#: Smallest and largest factor of a number.
Factors = tuple[float, float]


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


def check_delay(hulls: Iterable[Vehicle], delay: float, later: float) -> None:
    """Check that the simulator can delay the fins of all hulls.

    Args:
        hulls: with the dead times of their fins.
        delay: further delay of their commands, s.
        later: share by which the sum of both may be longer.

    Raises:
        ConfigurationError: it cannot.
    """
    most = LONGEST_DEAD_TIME / (1.0 + later)
    for hull in hulls:
        for fin in (hull.rudder, hull.sternplanes):
            if fin is not None and delay + fin.dead_time > most:
                found = f"{delay:g} s, with a dead time of {fin.dead_time:.2g} s"
                raise ConfigurationError("--delay", found, f"at most {most:.2f} s together")


def factors_of(share: float) -> Factors:
    """Return the factors of an uncertainty with a half width (a share)."""
    return 1.0 / (1.0 + share), 1.0 + share


def spread_of_file(file: Path) -> dict[str, Factors]:
    """Return the uncertainty that the comments of a vehicle file state, as factors.

    `(x2)` is a factor of 2 either way, `(12 %)` a share, `+- 0.3` a half width in the number's own unit,
    `assumed: 0.02 to 0.3` a range, as `vehicle.py new` and `identify` write them. A coefficient of which a
    comment states only that it is unknown has a factor of 2.

    Returns:
        Coefficients by name, the rudder's `max_rate_deg_s` and `dead_time`, and those of the planes as
        `sternplanes.max_rate_deg_s` and `sternplanes.dead_time`.

    Raises:
        ConfigurationError: a comment states an uncertainty within which no number can be drawn.
    """
    found: dict[str, Factors] = {}
    section = ""
    known = {"hull": (*UNCERTAIN, *UNCERTAIN_DIVING), "rudder": RUDDER, "sternplanes": RUDDER}
    for line in file.read_text(encoding="utf-8").splitlines():
        key = re.match(r"(\w+):", line)
        section = key[1] if key else section
        if section == "hull" and (all_of := re.match(r"\s+vertical: *#.*\ball assumed \(x([0-9.]+)\)", line)):
            found |= dict.fromkeys(UNCERTAIN_DIVING, factors_of(float(all_of[1]) - 1.0))
        number = re.match(r"\s+(\w+): *([-+0-9.eE]+) +#(.*)", line)
        if number and number[1] in known.get(section, ()):
            factors = _checked(f"{file}: {section}.{number[1]}", number[2], number[3])
            if factors is not None:
                found[PLANES[number[1]] if section == "sternplanes" else number[1]] = factors
    return found


def _checked(where: str, value: str, comment: str) -> Factors | None:
    """Return what a comment states, as `_stated`, if numbers can be drawn within it.

    Raises:
        ConfigurationError: they cannot.
    """
    try:
        factors = _stated(float(value), comment)
        is_possible = factors is None or 1.0 / _MOST_FACTOR <= factors[0] <= factors[1] <= _MOST_FACTOR
    except (ValueError, ZeroDivisionError):
        is_possible = False
    if not is_possible:
        expected = f"an uncertainty of a factor from 1 to {_MOST_FACTOR:g}, or a range of one sign"
        raise ConfigurationError(where, f"the comment '{comment.strip()}'", expected)
    return factors


def _stated(value: float, comment: str) -> Factors | None:
    """Return the factors that a comment states for a value; None where it states none."""
    if match := re.search(r"\((?:x([0-9.]+)|([0-9.]+) %)\)", comment):
        return factors_of(float(match[1]) - 1.0 if match[1] else 0.01 * float(match[2]))
    if any(words in comment for words in _UNKNOWN):
        return factors_of(_UNKNOWN_FACTOR - 1.0)
    if value and (match := re.search(r"assumed: (-?[0-9.]+) to (-?[0-9.]+)", comment)):
        low, high = sorted(float(end) / value for end in match.groups())
        return low, high
    if value and (match := re.search(r"\+- ([0-9.]+(?:e[-+]?[0-9]+)?)", comment)):
        return factors_of(float(match[1]) / abs(value))
    return None


def ensemble(
    vehicle: Vehicle, members: int, spread: float, random: np.random.Generator,
    own: Mapping[str, Factors] | None = None,
) -> list[Vehicle]:  # fmt: skip
    """Return the vehicle itself and further hulls that it may be: `members` with it; see `drawn_hulls`."""
    return [vehicle, *drawn_hulls(vehicle, members - 1, spread, random, own)]


def drawn_hulls(
    vehicle: Vehicle, number: int, spread: float, random: np.random.Generator,
    own: Mapping[str, Factors] | None = None,
) -> list[Vehicle]:  # fmt: skip
    """Draw hulls that a vehicle may be, independent of each other.

    Args:
        vehicle: as its file has it.
        number: how many.
        spread: half width of the uncertainty of every coefficient, of a fin's rate and of its dead time, a
            share: from 1/(1 + spread) to 1 + spread times, drawn evenly in its logarithm.
        random: where the numbers come from.
        own: factors of single numbers, as of `spread_of_file`, in place of `spread`.

    Raises:
        ConfigurationError: a spread for a hull without coefficients, or one within which no hull turns.
    """
    if number > 0 and vehicle.hull is None and (spread > 0.0 or own):
        found = "a hull that the simulator has as a program"
        raise ConfigurationError(f"{vehicle.name}: --spread", found, "coefficients to vary, or no spread")
    hulls: list[Vehicle] = []
    failed = 0
    while len(hulls) < number:
        drawn = _drawn(vehicle, spread, random, own or {})
        if drawn is not None:
            hulls.append(drawn)
        failed = failed + 1 if drawn is None else 0
        if failed >= _MOST_DRAWS:
            width = "that of the file" if own else f"{100 * spread:g} %"
            raise ConfigurationError(f"{vehicle.name}: --spread", width, "one within which hulls turn")
    return hulls


def _drawn(
    vehicle: Vehicle, spread: float, random: np.random.Generator, own: Mapping[str, Factors]
) -> Vehicle | None:
    hull = vehicle.coefficients

    def factor(name: str) -> float:
        low, high = map(math.log, own.get(name, factors_of(spread)))
        return math.exp(random.uniform(low, high))

    changes: dict[str, Any] = {name: getattr(hull, name) * factor(name) for name in UNCERTAIN}
    rudder, vertical = list(map(factor, RUDDER)), dict[str, float]()
    planes: list[float] = []
    if hull.vertical is not None and vehicle.sternplanes is not None:
        vertical = {name: getattr(hull.vertical, name) * factor(name) for name in UNCERTAIN_DIVING}
        planes = list(map(factor, PLANES.values()))
    try:
        fins: dict[str, Any] = {"rudder": _other(vehicle.rudder, *rudder)}
        if planes and vehicle.sternplanes is not None:
            fins["sternplanes"] = _other(vehicle.sternplanes, *planes)
        if vertical and hull.vertical is not None:
            changes["vertical"] = dataclasses.replace(hull.vertical, **vertical)
        other: Hull = dataclasses.replace(hull, **changes)
        drawn = dataclasses.replace(vehicle, hull=other, **fins)
        response_of(drawn)
        if vertical:
            response_of(pitch_plane_of(drawn))
    except (ConfigurationError, ValueError):
        return None
    return drawn


def _other(fin: Rudder, rate: float, late: float) -> Rudder:
    return dataclasses.replace(fin, max_rate_deg_s=fin.max_rate_deg_s * rate, dead_time=fin.dead_time * late)
