"""Settings objects with single values replaced or multiplied, by dotted names."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeVar

from auv_msgs_py.settings.schema import flattened, nested, validated
from auv_msgs_py.values.errors import ConfigurationError

T = TypeVar("T")


def changed(config: T, values: Mapping[str, Any], where: str) -> T:
    """Return a settings object with dotted names replaced: ``{"nism.k1": 0.4}``.

    Args:
        config: the object.
        values: dotted name -> new value.
        where: what an error names as its place.

    Raises:
        ConfigurationError: a name that it does not have, a value that it does not take.
    """
    if not values:
        return config
    return validated(type(config), nested(written_flat(config) | dict(values)), where)


def multiplied(config: Any, name: str, factor: float, where: str) -> float:
    """Return what a settings object has under a dotted name, times a factor.

    Raises:
        ConfigurationError: it has no number there.
    """
    value = written_flat(config).get(name)
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ConfigurationError(where, f"no number under {name}", "the name of a number, to multiply")
    return float(value * factor)


def written_flat(config: Any) -> dict[str, Any]:
    """Return the object as it would stand in a file, flat; what is not given there is left out."""
    return {name: value for name, value in flattened(config).items() if value is not None}
