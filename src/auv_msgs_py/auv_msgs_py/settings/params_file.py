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

#: Prefixes of the parameters that every ROS node has; the process that starts a node sets them.
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
        namespace: of the nodes; blocks for another one are passed over, as a node does. If None, blocks
            count whatever their namespace.
        notices: receives a line for names in a block for all nodes that none of these nodes has.

    Returns:
        node name -> settings object; a node that the file does not mention has its defaults. A block for
        ``/**`` is for all nodes; each takes the parameters that it has.

    Raises:
        ConfigurationError: a value does not fit, a node has two blocks, or no block of a node is for this
            namespace; names file and key, what was found and what was expected.
    """
    data = yaml_file.parse(path)
    if not isinstance(data, dict):
        raise ConfigurationError(str(path), repr(data), "a mapping of node names to ros__parameters")
    values = _collected(path, data, classes, namespace, notices if notices is not None else [])
    return _all_validated(path, classes, values)


def _collected(
    path: Path,
    data: Mapping[Any, Any],
    classes: Mapping[str, type[Any]],
    namespace: str | None,
    notices: list[str],
) -> dict[str, dict[str, Any]]:
    """Return the parameters of each node from all blocks, with dotted names; arguments as of `load`."""
    values: dict[str, dict[str, Any]] = {name: {} for name in classes}
    taken: dict[str, str] = {}
    passed_over: dict[str, str] = {}
    for key, body in data.items():
        pattern = str(key)
        name = _node_of(pattern)
        block = _block(path, pattern, body, classes)
        if namespace is not None and not _covers(pattern, namespace):
            if name in classes:
                validated(classes[name], nested(block), f"{path}: {pattern}")
            passed_over[name] = pattern
            continue
        if name in taken:
            found = f"a second block for {name}, after {taken[name]}"
            raise ConfigurationError(f"{path}: {pattern}", found, "one block for each node")
        taken[name] = pattern
        ignored = _add(values, name, block, classes)
        if ignored:
            listed = ", ".join(sorted(ignored))
            notices.append(printable(f"{path}: {pattern}: no node here has {listed}: ignored"))
    for name in passed_over.keys() - taken.keys():
        raise _other_namespace(f"{path}: {passed_over[name]}", name, namespace or "")
    return values


def _node_of(pattern: str) -> str:
    """``/**/heading_autopilot`` -> ``heading_autopilot``."""
    return pattern.rpartition("/")[2]


def _block(path: Path, pattern: str, body: Any, classes: Mapping[str, type[Any]]) -> dict[str, Any]:
    """Return the parameters of one block, with dotted names."""
    if _node_of(pattern) not in classes and not is_shared(pattern):
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


def _add(
    values: dict[str, dict[str, Any]], name: str, block: dict[str, Any], classes: Mapping[str, type[Any]]
) -> set[str]:
    """Add a block to the values of its node, or of all nodes; return the names that none of them has."""
    if name in classes:
        values[name] |= block
        return set()
    parts = {node: {k: v for k, v in block.items() if _has(cls, k)} for node, cls in classes.items()}
    for node, part in parts.items():
        values[node] |= part
    return block.keys() - set().union(*parts.values())


def _other_namespace(where: str, name: str, namespace: str) -> ConfigurationError:
    here = "/".join(["", *_parts(namespace)])
    return ConfigurationError(where, f"another namespace than {here or '/'}", f"/**/{name} or {here}/{name}")


def _all_validated(
    path: Path, classes: Mapping[str, type[Any]], values: Mapping[str, dict[str, Any]]
) -> dict[str, Any]:
    """Build the settings of every node; one error names all that is wrong."""
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


def is_shared(pattern: str) -> bool:
    """Return whether a block is for all nodes (``/**``) and names none."""
    return _node_of(pattern) in ("*", "**")


def _has(cls: type[Any], name: str) -> bool:
    """Return whether a settings class has a parameter or group of this name, or a group above it."""
    return any(
        f"{leaf.name}.".startswith(f"{name}.") or name.startswith(f"{leaf.name}.") for leaf in leaves(cls)
    )


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def _covers(pattern: str, namespace: str) -> bool:
    """Return whether a block is for nodes of a namespace: ``*`` matches one part of it, ``**`` any number.

    A name without slashes matches a node of any namespace.
    """
    *parts, name = _parts(pattern)
    if not parts:
        return True
    wild = {"*": "/[^/]+", "**": "(/[^/]+)*"}
    expected = [wild.get(part, f"/{re.escape(part)}") for part in (*parts, *["**"] * (name == "**"))]
    return re.fullmatch("".join(expected), "".join(f"/{part}" for part in _parts(namespace))) is not None


def undotted(parameters: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Flatten nested parameters to dotted names: for ROS `a.b: 1` and `a: {b: 1}` are the same."""
    flat: dict[str, Any] = {}
    for key, value in parameters.items():
        if isinstance(value, dict):
            flat |= undotted(value, f"{prefix}{key}.")
        else:
            flat[f"{prefix}{key}"] = value
    return flat


def as_ros(configurations: Mapping[str, Any]) -> dict[str, Any]:
    """Return settings objects as the contents of a parameter file, every value spelled out."""
    return {
        f"/**/{name}": {"ros__parameters": {key: _plain(value) for key, value in flattened(cfg).items()}}
        for name, cfg in configurations.items()
    }


def _plain(value: Any) -> Any:
    return list(value) if isinstance(value, tuple) else value
