"""Parameter files in ROS 2's own format, checked against the nodes' settings classes.

The same file serves `ros2 run ... --params-file`, the launcher and `closed_loop`:

    /**/heading_autopilot:
      ros__parameters:
        nism: {k1: 0.8}
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from auv_msgs_py.settings import yaml_file
from auv_msgs_py.settings.schema import flattened, leaves, nested, validated
from auv_msgs_py.values.errors import ConfigurationError, joined, printable

#: Every ROS node's own parameters, by the beginning of their names; the process that starts a node sets them.
BUILT_IN = ("use_sim_time", "start_type_description_service", "qos_overrides")


def load(
    path: Path,
    classes: Mapping[str, type[Any]],
    namespace: str | None = None,
    notices: list[str] | None = None,
) -> dict[str, Any]:
    """Read a parameter file.

    Args:
        path: the YAML file.
        classes: node name -> settings class that holds all of its parameters.
        namespace: that of the nodes, where it is known: blocks for another one are passed over, as a node
            does. Where it is not, a block counts whatever its namespace.
        notices: gets a line for names of a block for all nodes that none of these nodes has.

    Returns:
        node name -> settings object; nodes the file does not mention have their defaults. A block for
        ``/**`` is for all of them, and each takes from it what it has.

    Raises:
        ConfigurationError: naming file and key, what was found and what was expected; also for two blocks
            for one node, and for blocks of which none is for this namespace.
    """
    data = yaml_file.parse(path)
    if not isinstance(data, dict):
        raise ConfigurationError(str(path), repr(data), "a mapping of node names to ros__parameters")
    values: dict[str, dict[str, Any]] = {name: {} for name in classes}
    taken: dict[str, str] = {}
    passed_over: dict[str, str] = {}
    for key, body in data.items():
        pattern = str(key)
        name = pattern.rpartition("/")[2]
        told = _told(path, pattern, body, classes)
        if namespace is not None and not _covers(pattern, namespace):
            if name in classes:
                validated(classes[name], nested(told), f"{path}: {pattern}")
            passed_over[name] = pattern
            continue
        if name in taken:
            found = f"a second block for {name}, after {taken[name]}"
            raise ConfigurationError(f"{path}: {pattern}", found, "one block for each node")
        taken[name] = pattern
        if name in classes:
            values[name] |= told
            continue
        parts = {node: {k: v for k, v in told.items() if _has(cls, k)} for node, cls in classes.items()}
        for node, part in parts.items():
            values[node] |= part
        ignored = told.keys() - set().union(*parts.values())
        if ignored and notices is not None:
            listed = ", ".join(sorted(ignored))
            notices.append(printable(f"{path}: {pattern}: no node here has {listed}: ignored"))
    for name in passed_over.keys() - taken.keys():
        here = "/".join(["", *_parts(namespace or "")])
        found, expected = f"another namespace than {here or '/'}", f"/**/{name} or {here}/{name}"
        raise ConfigurationError(f"{path}: {passed_over[name]}", found, expected)
    loaded: dict[str, Any] = {}
    errors: list[ConfigurationError] = []
    for name, cls in classes.items():
        try:
            loaded[name] = validated(cls, nested(values[name]), f"{path}: {name}")
        except ConfigurationError as error:
            errors.append(error)
    if errors:
        raise joined(errors, str(path))
    return loaded


def _told(path: Path, pattern: str, body: Any, classes: Mapping[str, type[Any]]) -> dict[str, Any]:
    """What one block says, with dotted names."""
    name = pattern.rpartition("/")[2]
    if name not in classes and not is_shared(pattern):
        known = ", ".join(f"/**/{known}" for known in classes)
        raise ConfigurationError(f"{path}: {pattern}", "an unknown node", f"one of {known}")
    if not isinstance(body, dict) or set(body) != {"ros__parameters"}:
        raise ConfigurationError(f"{path}: {pattern}", repr(body), "one key, ros__parameters")
    parameters = body["ros__parameters"]
    if not isinstance(parameters, dict):
        raise ConfigurationError(f"{path}: {pattern}.ros__parameters", repr(parameters), "a mapping")
    return {
        parameter: value
        for parameter, value in undotted(parameters).items()
        if not parameter.startswith(BUILT_IN)
    }


def is_shared(pattern: str) -> bool:
    """Whether a block is for several nodes (``/**``) and names none."""
    return pattern.rpartition("/")[2] in ("*", "**")


def _has(cls: type[Any], name: str) -> bool:
    """Whether a settings class has a parameter, or a group, of this name, or one above it."""
    return any(
        f"{leaf.name}.".startswith(f"{name}.") or name.startswith(f"{leaf.name}.") for leaf in leaves(cls)
    )


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def _covers(pattern: str, namespace: str) -> bool:
    """Whether a block is for nodes of a namespace: ``*`` stands for one part of it, ``**`` for any number.

    A name alone is a node's in any namespace.
    """
    *parts, name = _parts(pattern)
    if not parts:
        return True
    wild = {"*": "/[^/]+", "**": "(/[^/]+)*"}
    expected = [wild.get(part, f"/{re.escape(part)}") for part in (*parts, *["**"] * (name == "**"))]
    return re.fullmatch("".join(expected), "".join(f"/{part}" for part in _parts(namespace))) is not None


def undotted(parameters: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Flatten nested parameters to dotted names: ROS takes `a.b: 1` and `a: {b: 1}` alike."""
    flat: dict[str, Any] = {}
    for key, value in parameters.items():
        if isinstance(value, dict):
            flat |= undotted(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def as_ros(configurations: Mapping[str, Any]) -> dict[str, Any]:
    """Settings objects as the contents of a parameter file: every value spelled out."""
    return {
        f"/**/{name}": {"ros__parameters": {key: _plain(value) for key, value in flattened(cfg).items()}}
        for name, cfg in configurations.items()
    }


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
