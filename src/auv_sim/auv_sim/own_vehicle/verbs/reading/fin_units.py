"""Units and signs of recorded fins: `--unit NAME=UNIT`."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping, Sequence

import numpy as np

from auv_msgs_py.contract import topics
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following.vehicle import Vehicle
from auv_sim.bags.content.recorded_commands import TimedCommands
from auv_sim.bags.content.recorded_manoeuvres import Manoeuvring
from auv_sim.own_vehicle.identify.results.rudder_plausibility import EXCEEDING

_FINS = (topics.RUDDER_CMD.name, topics.STERNPLANE_CMD.name)
#: Units, and the largest number that each has.
_LARGEST = {"rad": 0.5 * math.pi, "deg": 90.0, "percent": 105.0, "share": 1.05}


def add_unit_argument(parser: argparse.ArgumentParser) -> None:
    """Add `--unit`."""
    parser.add_argument(
        "--unit", action="append", default=[], metavar="NAME=UNIT",
        help=f"unit of a fin's commands; NAME is {' or '.join(_FINS)}, UNIT one of {', '.join(_LARGEST)} "
        "(the last two of its largest angle; default: rad), with a minus where the sign is reversed",
    )  # fmt: skip


def units_of(given: Sequence[str]) -> dict[str, str]:
    """Return the units that are given: name of the topic -> unit, with a minus where the sign is reversed.

    Raises:
        ConfigurationError: a text that is not NAME=UNIT, or a name that is given twice.
    """
    units: dict[str, str] = {}
    for text in given:
        name, equals, unit = text.partition("=")
        if name not in _FINS or not equals or unit.removeprefix("-") not in _LARGEST:
            expected = (
                f"NAME=UNIT with NAME {' or '.join(_FINS)}, UNIT one of {', '.join(_LARGEST)} or -rad, ..."
            )
            raise ConfigurationError("--unit", text, expected)
        if name in units:
            raise ConfigurationError(f"--unit {name}", f"{units[name]} and {unit}", "one unit")
        units[name] = unit
    return units


def check_effect(units: Mapping[str, str], vehicle: Vehicle, with_planes: bool) -> None:
    """Check that each unit has commands that it counts for.

    Args:
        units: as given.
        vehicle: that was recorded.
        with_planes: whether any recording has commands of stern planes.

    Raises:
        ConfigurationError: a unit of stern planes without stern planes.
    """
    name = topics.STERNPLANE_CMD.name
    if name not in units:
        return
    if vehicle.sternplanes is None:
        raise ConfigurationError(f"--unit {name}", units[name], "a vehicle with stern planes")
    if not with_planes:
        raise ConfigurationError(f"--unit {name}", units[name], f"a recording with {name}")


def in_radians(recorded: Manoeuvring, units: Mapping[str, str], vehicle: Vehicle, where: str) -> Manoeuvring:
    """Return a recording with the angles of its fins in radians and with the signs of the wire contract.

    Raises:
        ConfigurationError: commands beyond what the unit can be.
    """
    name, planes_name = _FINS
    rudder = _turned(recorded.rudder, units.get(name), vehicle.rudder.max_angle, f"{where}: {name}")
    planes, limits = recorded.sternplanes, vehicle.sternplanes
    if planes is not None and limits is not None:
        planes = _turned(planes, units.get(planes_name), limits.max_angle, f"{where}: {planes_name}")
    return recorded._replace(rudder=rudder, sternplanes=planes)


def _turned(commands: TimedCommands, given: str | None, largest: float, where: str) -> TimedCommands:
    """Return commands in radians; unchanged if no unit was given."""
    if given is None:
        return commands
    unit, sign = given.removeprefix("-"), -1.0 if given.startswith("-") else 1.0
    _check_range(commands, unit, where)
    factors = {"rad": 1.0, "deg": math.pi / 180.0, "percent": 0.01 * largest, "share": largest}
    return TimedCommands(commands.t, sign * factors[unit] * commands.value)


def _check_range(commands: TimedCommands, unit: str, where: str) -> None:
    beyond = np.abs(commands.value) > _LARGEST[unit]
    if beyond.size and np.mean(beyond) > EXCEEDING:
        found = f"commands up to {np.max(np.abs(commands.value)):.3g}"
        raise ConfigurationError(where, found, f"at most {_LARGEST[unit]:.3g} for --unit {unit}")
