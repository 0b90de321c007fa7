"""The settings of recorded missions, name by name, for their comparison."""

from __future__ import annotations

from typing import Any

from auv_msgs_py.settings import yaml_file
from auv_sim.bags.content.recorded_mission import (
    CONTROLLER_MODEL,
    FORMER_CONTROLLER_MODEL,
    MISSION,
    PARAMS,
    VEHICLE,
    configuration,
)
from auv_sim.bags.reading.recording import Bag

#: Files that the parameters name: their content is compared, not their place.
_FILES = (MISSION, VEHICLE, FORMER_CONTROLLER_MODEL, CONTROLLER_MODEL, "sea.yaml")
#: Parameters that are places of files.
_PLACES = ("directory", "mission", "vehicle", "sea")


def settings_of(bag: Bag) -> dict[str, str]:
    """Return every parameter and every key of the flown files: name -> value as text."""
    values: dict[str, str] = {}
    with configuration(bag) as directory:
        if (directory / PARAMS).exists():
            for node, body in _mapping(yaml_file.parse(directory / PARAMS)).items():
                parameters = dotted(_mapping(_mapping(body).get("ros__parameters")))
                name = str(node).rsplit("/", 1)[-1]
                values |= {f"{name} {k}": str(v) for k, v in parameters.items() if k not in _PLACES}
        for file in _FILES:
            if (directory / file).exists():
                content = _mapping(yaml_file.parse(directory / file))
                name = CONTROLLER_MODEL if file == FORMER_CONTROLLER_MODEL else file
                values |= {f"{name} {key}": str(value) for key, value in dotted(content).items()}
    return values


def differences(bags: list[Bag]) -> dict[str, list[str | None]]:
    """Return the settings that differ between recordings: name -> value in each, None where unset.

    Raises:
        ConfigurationError: a recorded file cannot be read.
    """
    flat = [settings_of(bag) for bag in bags]
    found = {name: [values.get(name) for values in flat] for name in sorted(set().union(*flat))}
    return {name: values for name, values in found.items() if len(set(map(_comparable, values))) > 1}


def _comparable(value: str | None) -> str | float | None:
    """Return a number for a text of one, so that 35 is 35.0."""
    try:
        return float(value or "")
    except ValueError:
        return value


def _mapping(value: Any) -> dict[str, Any]:
    """Return a recorded file's mapping; empty for any other content."""
    return value if isinstance(value, dict) else {}


def dotted(values: dict[str, Any], prefix: str = "") -> dict[str, Any]:
    """Flatten nested keys: ``{"a": {"b": 1}}`` becomes ``{"a.b": 1}``."""
    flat: dict[str, Any] = {}
    for key, value in values.items():
        flat |= dotted(value, f"{prefix}{key}.") if isinstance(value, dict) else {f"{prefix}{key}": value}
    return flat
