"""Definitions of message types: the text that a bag carries, and the type's hash."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from auv_msgs_py.values.errors import ConfigurationError

_EXPECTED = "a message type of ROS 2 Jazzy or of an installed package"


class Definition(NamedTuple):
    """The definition of a type with everything it contains, in ROS 2's own notation, and its RIHS01 hash."""

    text: str
    type_hash: str


@cache
def typestore() -> Typestore:
    """Return the message definitions of ROS 2 Jazzy; loaded once, in a tenth of a second."""
    return get_typestore(Stores.ROS2_JAZZY)


@cache
def definition(type_name: str) -> Definition:
    """Look a type up among ROS 2 Jazzy's own, else in the installed packages.

    Raises:
        ConfigurationError: the type is unknown.
    """
    store = typestore()
    if type_name not in store.fielddefs:
        _learn(type_name)
    text, _ = store.generate_msgdef(type_name, ros_version=2)
    return Definition(text, store.hash_rihs01(type_name))


def _learn(type_name: str) -> None:
    """Add an installed package's type, and those it is made of, to the store."""
    from ament_index_python.packages import PackageNotFoundError, get_package_share_directory

    store = typestore()
    pending: list[str] = [type_name]
    found: dict[str, Any] = {}
    while pending:
        name = pending.pop()
        if name in store.fielddefs or name in found:
            continue
        try:
            package, kind, message = name.split("/")
            text = (Path(get_package_share_directory(package)) / kind / f"{message}.msg").read_text("utf-8")
        except (PackageNotFoundError, OSError, ValueError):
            raise ConfigurationError(type_name, "no definition", _EXPECTED) from None
        parsed = get_types_from_msg(text, name)
        found |= parsed
        pending += [used for _, fields in parsed.values() for _, field in fields for used in _names(field)]
    store.register(found)


def _names(field: object) -> list[str]:
    """The type names inside a field's description, however deeply nested in arrays."""
    if isinstance(field, str):
        return [field] if "/msg/" in field else []
    if isinstance(field, tuple):
        return [name for part in field for name in _names(part)]
    return []
