"""A fleet's file: its keys, and the options of each vehicle's mission."""

from __future__ import annotations

import argparse
import dataclasses
from pathlib import Path
from typing import Annotated, Literal

import pydantic

from auv_msgs_py.contract.topics import MOST_RECORDED
from auv_msgs_py.settings import user_files, yaml_file
from auv_msgs_py.settings.schema import Pair, setting, settings
from auv_msgs_py.settings.validators import no_boolean
from auv_msgs_py.values.errors import ConfigurationError
from auv_path_following import config_files
from auv_path_following import vehicle as vehicle_file
from auv_path_following.curves.switching_modes import LISTED, SwitchingMode
from auv_sim.bags.texts import label_of
from auv_sim.command_line import ros_namespace
from auv_sim.launch.options import DEFAULT_VEHICLE, Options

#: Keys of a vehicle that name a file -> kind of file.
_FILES: dict[str, config_files.Kind] = {
    "mission": "missions", "vehicle": "vehicles", "controller_model": "vehicles", "params": "params",
}  # fmt: skip


@settings
class FleetVehicle:
    """One vehicle of a fleet; what its mission's command line would name."""

    namespace: str = setting(doc="namespace of its nodes, different from all others")
    mission: str = setting(doc="mission file, or the name of a shipped one")
    vehicle: str = setting(DEFAULT_VEHICLE, "vehicle file, or the name of a shipped one")
    controller_model: str | None = setting(None, "vehicle file that the nodes use, if it differs")
    params: str | None = setting(None, "parameter file, or rule; by default what the vehicle's file names")
    initial: tuple[float, float, float] | None = setting(
        None, "start: north, east (m), heading (deg); by default the path's start"
    )
    depth: float | None = setting(None, "start level at this depth", unit="m", ge=0.0)
    seed: int | None = setting(
        None, "seed of the sea; by default from the fleet's and the place in the file", ge=0
    )
    switching: SwitchingMode | None = setting(None, f"joints with a circle: {LISTED}")


@settings
class Fleet:
    """A whole fleet file."""

    version: Annotated[Literal[1], pydantic.BeforeValidator(no_boolean)] = setting(
        doc="version of this format"
    )
    name: str = setting(doc="name of the fleet")
    description: str = setting("", "description")
    current: Pair | None = setting(None, "constant current, towards north and east", unit="m/s")
    upwelling: float | None = setting(None, "constant current upwards, for vehicles that dive", unit="m/s")
    sea: str | None = setting(None, "sea file, or the name of a shipped one")
    seed: int = setting(0, "seed of the sea", ge=0)
    bags: Literal["each", "one"] = setting("each", "each: a bag for each vehicle; one: one bag for all")
    vehicles: tuple[FleetVehicle, ...] = setting(doc="the vehicles")


def load(name_or_path: str) -> tuple[Path, Fleet]:
    """Read a fleet file.

    Args:
        name_or_path: a path, or a shipped name such as ``two``.

    Returns:
        The file, and its content with namespaces that begin with a slash.

    Raises:
        ConfigurationError: one line with file and key, what was found and what was expected.
    """
    file = config_files.find("fleets", name_or_path).absolute()
    fleet = yaml_file.load(file, Fleet)
    if len(fleet.vehicles) < 2:
        raise ConfigurationError(f"{file}: vehicles", f"{len(fleet.vehicles)} of them", "two or more")
    if fleet.bags == "one" and len(fleet.vehicles) > MOST_RECORDED:
        expected = f"each: one bag has at most {MOST_RECORDED} vehicles"
        raise ConfigurationError(f"{file}: bags", f"one, with {len(fleet.vehicles)} vehicles", expected)
    vehicles: list[FleetVehicle] = []
    for place, vehicle in places(file, fleet):
        try:
            namespace = ros_namespace(vehicle.namespace)
        except argparse.ArgumentTypeError:
            namespace = "/"
        if namespace == "/":
            raise ConfigurationError(f"{place}.namespace", repr(vehicle.namespace), "one such as /auv1")
        taken = {label_of(other.namespace) for other in vehicles}
        if label_of(namespace) in taken:
            expected = "another one: each vehicle has its own"
            raise ConfigurationError(f"{place}.namespace", f"{namespace} a second time", expected)
        vehicles.append(dataclasses.replace(vehicle, namespace=namespace))
    return file, dataclasses.replace(fleet, vehicles=tuple(vehicles))


def places(file: Path, fleet: Fleet) -> list[tuple[str, FleetVehicle]]:
    """Return each vehicle with its place in the file, for messages."""
    return [(f"{file}: vehicles[{k}]", vehicle) for k, vehicle in enumerate(fleet.vehicles)]


def options_of(file: Path, fleet: Fleet, common: Options) -> list[Options]:
    """Return the options with which `mission.py` flies each vehicle alone.

    A file is looked for beside the fleet's file, then as on the command line.

    Args:
        file, fleet: as `load` returns them.
        common: the command line of the fleet.

    Raises:
        ConfigurationError: a file does not exist.
    """
    options = []
    for number, (place, vehicle) in enumerate(places(file, fleet)):
        files = {key: _found(file, place, key, getattr(vehicle, key)) for key in _FILES}
        sea = _found(file, str(file), "sea", fleet.sea, "seas")
        seed = fleet.seed + number if vehicle.seed is None else vehicle.seed
        options.append(
            dataclasses.replace(
                common,
                mission=files["mission"] or vehicle.mission,
                vehicle=files["vehicle"] or vehicle.vehicle,
                sea=sea,
                controller_model=files["controller_model"],
                params=files["params"],
                namespace=vehicle.namespace,
                current=fleet.current,
                upwelling=fleet.upwelling if _dives(files["vehicle"]) else None,
                initial=vehicle.initial,
                depth=vehicle.depth,
                seed=seed if sea is not None else vehicle.seed,
                switching=vehicle.switching,
            )
        )
    return options


def _dives(file: str | None) -> bool:
    """Return whether the vehicle of a file has stern planes."""
    return vehicle_file.load(file or DEFAULT_VEHICLE).dives


def _found(
    file: Path, place: str, key: str, name: str | None, kind: config_files.Kind | None = None
) -> str | None:
    """Return the file that a key names; `rule` and the names of shipped files as they are."""
    if name is None or (key == "params" and name == "rule"):
        return name
    beside = file.parent / user_files.from_home(name)
    if user_files.is_file(beside):
        return str(beside)
    try:
        config_files.find(kind or _FILES[key], name)
    except ConfigurationError as error:
        where = f"{place}.{key}" if place != str(file) else f"{file}: {key}"
        raise ConfigurationError(where, f"'{name}', {error.found}", error.expected) from None
    return name
