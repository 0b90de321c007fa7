"""Writes docs/parameters.md: every parameter and every key of a file, from the settings classes.

In the environment: `python3 -m auv_sim.reference > docs/parameters.md`. A test compares the page with what
this module writes.
"""

from __future__ import annotations

import dataclasses
import enum
import types
import typing
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from auv_msgs_py.contract import topics
from auv_path_following.missions.mission_spec import MissionSpec
from auv_path_following.parameters import NavigationParameters, NodeParameters
from auv_path_following.vehicle import Vehicle
from auv_sim.launch.fleet.fleet_file import Fleet
from auv_sim.own_vehicle.manoeuvres.manoeuvre_parameters import ManoeuvresParameters
from auv_sim.own_vehicle.manoeuvres.program_file import Program
from auv_sim.sim_parameters import SUITE, FaultRelayParameters, FleetClockParameters
from auv_sim.studies.campaign.study_file import Study
from auv_sim.vehicle.sea import Sea

_HEAD = """# Parameters and keys

All parameters of the nodes and all keys of the files, with unit, range, default and meaning. This page is
written by `python3 -m auv_sim.reference > docs/parameters.md` from the settings classes, and a test compares
the two.

## Parameters of the nodes

As `ros2 param describe NODE NAME` shows them. In a parameter file a dot is a level:
`guidance.ailos.lookahead` is `guidance: {ailos: {lookahead: 5.2}}`. A parameter marked *live* can be changed
while the vehicle moves; the others are read when the node starts."""
_FILES = """## Keys of the files

A key whose default is a dash has to be given. `[]` stands for each item of a list."""
_GROUP = "mapping"
_KINDS = {float: "number", int: "whole number", bool: "true or false", str: "text"}


class KeyRow(NamedTuple):
    """One key of a settings class."""

    name: str
    kind: str
    allowed: str
    default: str
    doc: str


def page() -> str:
    """Return the whole page, in Markdown."""
    parts = [_HEAD]
    every, navigating = (_names(cls) for cls in (NodeParameters, NavigationParameters))
    parts += _section("Every node", _parameters(NodeParameters, set()))
    parts += _section(
        "Every node that reads the vehicle's navigation", _parameters(NavigationParameters, every)
    )
    others = {
        "fault_relay": FaultRelayParameters, topics.FLEET_CLOCK: FleetClockParameters,
        topics.MANOEUVRES: ManoeuvresParameters,
    }  # fmt: skip
    for name, cls in (SUITE | others).items():
        above = navigating if issubclass(cls, NavigationParameters) else every
        parts += _section(f"`{name}`", _parameters(cls, above))
    parts.append(_FILES)
    for title, cls in (
        ("Mission file", MissionSpec), ("Vehicle file", Vehicle), ("Sea file", Sea), ("Study", Study),
        ("Fleet", Fleet), ("Program of manoeuvres", Program),
    ):  # fmt: skip
        parts += _section(title, keys(cls))
    return "\n\n".join(parts) + "\n"


def _section(title: str, rows: Iterable[KeyRow]) -> list[str]:
    table = ["| name | value | range | default | meaning |", "|---|---|---|---|---|"]
    table += ["| " + " | ".join((f"`{row.name}`", *map(_cell, row[1:]))) + " |" for row in rows]
    return [f"### {title}", "\n".join(table)]


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


def _parameters(cls: type[Any], above: set[str]) -> list[KeyRow]:
    """Return the rows of a node without those of its base class, which have their own section."""
    return [row for row in keys(cls) if row.name not in above and row.kind != _GROUP]


def _names(cls: type[Any]) -> set[str]:
    return {row.name for row in keys(cls)}


def keys(cls: type[Any], prefix: str = "") -> Iterator[KeyRow]:
    """Yield every key of a settings class, followed by those of nested classes.

    Args:
        cls: a settings class.
        prefix: text in front of its keys.
    """
    hints = typing.get_type_hints(cls)
    for name, info in cls.__pydantic_fields__.items():
        extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
        doc = f"{info.description} *(live)*" if extra.get("live") else info.description or ""
        default = "-" if info.is_required() else _default(info.get_default(call_default_factory=True))
        below, listed = _nested(hints[name])
        if below is None:
            kind = ", ".join(filter(None, (_kind(hints[name]), str(extra.get("unit", "")))))
            yield KeyRow(prefix + name, kind, _range(info.metadata), default, doc)
        else:
            yield KeyRow(prefix + name, f"list of {_GROUP}s" if listed else _GROUP, "", default, doc)
            yield from keys(below, f"{prefix}{name}{'[]' * listed}.")


def _nested(hint: Any) -> tuple[type[Any] | None, bool]:
    """Return the settings class in an annotation, and whether it is in a list or a mapping."""
    if isinstance(hint, type) and dataclasses.is_dataclass(hint):
        return hint, False
    for part in typing.get_args(hint):
        found, listed = _nested(part)
        if found is not None:
            return found, listed or typing.get_origin(hint) not in (typing.Union, types.UnionType)
    return None, False


def _kind(hint: Any) -> str:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is typing.Literal:
        return "one of " + ", ".join(f"`{word}`" for word in arguments)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(dict.fromkeys(_kind(part) for part in arguments if part is not type(None)))
    if isinstance(hint, type) and issubclass(hint, enum.Enum):
        return "one of " + ", ".join(f"`{word.value}`" for word in hint)
    if origin is tuple and Ellipsis not in arguments:
        return f"{len(arguments)} numbers"
    if origin in (tuple, list):
        item = _kind(arguments[0])
        return f"list of {item if item.endswith('s') else item + 's'}"
    return _KINDS.get(hint, "mapping" if origin is dict else "value")


def _range(bounds: Iterable[Any]) -> str:
    words = {"gt": "above", "ge": "from", "lt": "below", "le": "to"}
    found = {
        word: getattr(bound, key) for bound in bounds for key, word in words.items() if hasattr(bound, key)
    }
    return " ".join(f"{word} {found[word]:g}" for word in words.values() if word in found)


def _default(value: Any) -> str:
    if isinstance(value, bool) or value is None:
        return str(value).lower()
    if isinstance(value, (int, float)):
        return f"{value:g}"
    if dataclasses.is_dataclass(value):
        return ""
    if isinstance(value, (tuple, list, dict)):
        return ", ".join(f"`{item}`" for item in value) or "empty"
    return f"`{value.value if isinstance(value, enum.Enum) else value}`" if str(value) else "empty"


if __name__ == "__main__":
    print(page(), end="")
