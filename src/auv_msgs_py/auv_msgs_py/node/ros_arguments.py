"""A process's ROS arguments, read without ROS."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from auv_msgs_py.settings import params_file, yaml_file

_FILE = "--params-file"
_PARAMETER = ("-p", "--param")


def parameter_files(arguments: Sequence[str]) -> list[Path]:
    """List the parameter files that ROS arguments name."""
    return [Path(after) for option, after in itertools.pairwise(arguments) if option == _FILE]


def check_parameter_files(arguments: Sequence[str]) -> None:
    """Read the parameter files that ROS arguments name: ROS would report an error in many lines.

    Raises:
        ConfigurationError: one of them is missing or is not YAML.
    """
    for file in parameter_files(arguments):
        yaml_file.parse(file)


def shared_names(arguments: Sequence[str], node: str) -> set[str]:
    """Return the parameters that only blocks for several nodes set (``/**``), dotted.

    Args:
        arguments: of the process.
        node: the node's name; its own blocks and ``-p`` name a parameter for this node.

    Raises:
        ConfigurationError: a file cannot be read.
    """
    shared: set[str] = set()
    own: set[str] = set()
    for file in parameter_files(arguments):
        for pattern, body in _blocks(yaml_file.parse(file)):
            if params_file.is_shared(pattern):
                shared |= body.keys()
            elif pattern.rpartition("/")[2] == node:
                own |= body.keys()
    for option, after in itertools.pairwise(arguments):
        if option in _PARAMETER:
            own.add(after.partition(":=")[0].rpartition(":")[2])
    return shared - own


def _blocks(data: Any) -> list[tuple[str, dict[str, Any]]]:
    """Return pattern and dotted parameters of each well-formed block; other checks report the rest."""
    found = []
    for pattern, body in data.items() if isinstance(data, dict) else ():
        parameters = body.get("ros__parameters") if isinstance(body, dict) else None
        if isinstance(parameters, dict):
            found.append((str(pattern), params_file.undotted(parameters)))
    return found
