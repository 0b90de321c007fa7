"""Validated, frozen, self-describing settings.

A settings class is the only place of a default, a unit, a range and a description. YAML files and ROS
parameters are read through it (`yaml_file`, `params_file`, `params`) and only override it.

    @settings
    class NismConfig:
        k1: float = setting(0.8, "fastest decay of the heading error", unit="rad/s", gt=0.0, live=True)
"""

from __future__ import annotations

import dataclasses
import enum
import json
from collections.abc import Mapping
from typing import Annotated, Any, TypeVar, dataclass_transform

import pydantic
from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass as _pydantic_dataclass

from auv_msgs_py.settings.explanations import readable
from auv_msgs_py.values.errors import ConfigurationError

T = TypeVar("T")

#: A pair of numbers in a file, e.g. ``[north, east]`` in metres.
Pair = tuple[float, float]

#: A number for which a file may say `auto`: 0, which means that the value is computed.
_AUTO = pydantic.BeforeValidator(lambda value: 0.0 if value == "auto" else value)
Auto = Annotated[float, _AUTO]

_POLICY = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, validate_default=True)
_MISSING: Any = dataclasses.MISSING


def setting(
    default: Any = _MISSING,
    doc: str = "",
    *,
    unit: str = "",
    gt: float | None = None,
    ge: float | None = None,
    lt: float | None = None,
    le: float | None = None,
    live: bool = False,
    factory: Any = None,
) -> Any:
    """Declare one field of a settings class.

    Args:
        default: the default, given only here; leave out for a required key.
        doc: one line of description, shown by `ros2 param describe`.
        unit: SI unit, empty for a pure number.
        gt, ge, lt, le: bounds, also offered as the ROS parameter's range.
        live: whether it is safe to change while the vehicle moves.
        factory: makes the default of a nested settings class.
    """
    extra = {"unit": unit, "live": live}
    bounds = {"gt": gt, "ge": ge, "lt": lt, "le": le}
    given = {name: bound for name, bound in bounds.items() if bound is not None}
    if factory is not None:
        return Field(default_factory=factory, description=doc, json_schema_extra=extra, **given)  # type: ignore[call-overload]
    if default is _MISSING:
        return Field(description=doc, json_schema_extra=extra, **given)  # type: ignore[call-overload]
    return Field(default=default, description=doc, json_schema_extra=extra, **given)  # type: ignore[call-overload]


# Without field_specifiers a type checker takes every `setting(...)` for a default, which is what positional
# defaults need; a missing required key is found at run time.
@dataclass_transform(frozen_default=True, kw_only_default=True)
def settings(cls: type[T]) -> type[T]:
    """Make a class frozen, keyword-only and checked on construction; unknown keys and NaN are refused."""
    return _pydantic_dataclass(frozen=True, kw_only=True, config=_POLICY)(cls)  # type: ignore[return-value]


def validated(cls: type[T], data: object, where: str) -> T:
    """Build `cls` from parsed YAML.

    Args:
        cls: a settings class (or any type pydantic understands).
        data: what the YAML parser returned (text, numbers, lists, mappings).
        where: the file, for the error.

    Raises:
        ConfigurationError: naming file and key, what was found and what was expected.
    """
    try:
        # JSON mode: strict about numbers and text, yet a mapping is a settings object and a list is a pair.
        text = json.dumps(data)
    except (TypeError, ValueError, RecursionError) as error:
        raise ConfigurationError(
            where, f"a value of an unsupported type ({error})", "text, numbers, lists, mappings"
        ) from None
    try:
        return pydantic.TypeAdapter(cls).validate_json(text)
    except pydantic.ValidationError as error:
        raise readable(error, where, cls) from None


@dataclasses.dataclass(frozen=True)
class SettingInfo:
    """One leaf of a settings class, flattened: ``nism.k1`` with its default, unit, range and description."""

    name: str
    default: Any
    doc: str
    unit: str
    live: bool
    minimum: float | None
    maximum: float | None
    auto: bool


def leaves(cls: type[Any], prefix: str = "") -> list[SettingInfo]:
    """List every plain field of a settings class, nested classes flattened with dots.

    Raises:
        TypeError: a field has no default (a ROS parameter must have one).
    """
    found: list[SettingInfo] = []
    for name, info in cls.__pydantic_fields__.items():
        default = info.get_default(call_default_factory=True)
        if dataclasses.is_dataclass(default) and not isinstance(default, type):
            found += leaves(type(default), f"{prefix}{name}.")
            continue
        if info.is_required():
            raise TypeError(f"{cls.__name__}.{name} has no default")
        extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
        bounds = {
            key: getattr(m, key) for m in info.metadata for key in ("gt", "ge", "lt", "le") if hasattr(m, key)
        }
        found.append(
            SettingInfo(
                name=prefix + name,
                default=default.value if isinstance(default, enum.Enum) else default,
                doc=info.description or "",
                unit=str(extra.get("unit", "")),
                live=bool(extra.get("live", False)),
                minimum=bounds.get("ge", bounds.get("gt")),
                maximum=bounds.get("le", bounds.get("lt")),
                auto=_AUTO in info.metadata,
            )
        )
    return found


def nested(flat: Mapping[str, Any]) -> dict[str, Any]:
    """`{"nism.k1": 0.8}` -> ``{"nism": {"k1": 0.8}}``.

    Where one name is both a value and a group, the value stays and the names below it keep their dots:
    `validated` refuses them, because the class has only one of the two.
    """
    tree: dict[str, Any] = {}
    for name, value in flat.items():
        parts = name.split(".")
        branch = tree
        for depth in range(1, len(parts)):
            if ".".join(parts[:depth]) in flat:
                branch[".".join(parts[depth - 1 :])] = value
                break
            branch = branch.setdefault(parts[depth - 1], {})
        else:
            branch[parts[-1]] = value
    return tree


def flattened(instance: Any, prefix: str = "") -> dict[str, Any]:
    """Return the values of a settings object with dotted names: the inverse of `nested`."""
    flat: dict[str, Any] = {}
    for field in dataclasses.fields(instance):
        value = getattr(instance, field.name)
        if dataclasses.is_dataclass(value):
            flat |= flattened(value, f"{prefix}{field.name}.")
        else:
            flat[prefix + field.name] = value
    return flat
