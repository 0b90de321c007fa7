"""Pydantic's errors as one line for the user: the key, what was found and what was expected."""

from __future__ import annotations

import dataclasses
import difflib
import typing
from collections.abc import Iterator, Sequence
from typing import Any

import pydantic

from auv_msgs_py.values.errors import ConfigurationError, joined

_ABSENT = ("missing", "missing_keyword_only_argument", "missing_argument")
_UNKNOWN = ("unexpected_keyword_argument", "extra_forbidden")
#: Longest finding, characters.
_LONGEST = 60
#: Kind of error -> what was expected, filled in from the error's context.
_EXPECTED = {
    "finite_number": "a finite number",
    "greater_than": "a number greater than {gt:g}",
    "greater_than_equal": "a number of at least {ge:g}",
    "less_than": "a number less than {lt:g}",
    "less_than_equal": "a number of at most {le:g}",
    **dict.fromkeys(("float_type", "float_parsing"), "a number"),
    **dict.fromkeys(("int_type", "int_from_float"), "a whole number"),
    "string_type": "a text",
    "bool_type": "true or false",
    "too_short": "at least {min_length} item(s)",
    "too_long": "at most {max_length} item(s)",
    **dict.fromkeys(("dataclass_type", "dict_type", "model_type"), "a mapping of keys to values"),
    **dict.fromkeys(("list_type", "tuple_type"), "a list"),
}


def readable(error: pydantic.ValidationError, where: str, cls: Any = None) -> ConfigurationError:
    """Return the error that names all keys at fault.

    Args:
        error: of pydantic.
        where: the file.
        cls: the settings class that was to be built, for the keys that could have been meant.
    """
    errors = error.errors(include_url=False)
    # A misspelt key is missing under one name and unknown under another: first what stands in the file.
    errors.sort(key=lambda item: item["type"] in _ABSENT)
    found = []
    for item in errors:
        place = key_path(item["loc"])
        found.append(ConfigurationError(f"{where}: {place}" if place else where, *_explain(dict(item), cls)))
    return joined(found, where)


def key_path(location: tuple[int | str, ...]) -> str:
    """`("segments", 2, "line")` -> ``segments[2].line``; pydantic's own tags are left out."""
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        elif "[" not in part and "(" not in part:
            text += f".{part}" if text else part
    return text


def _meant(location: Sequence[int | str], cls: Any) -> str:
    """Return a question for the key that was probably meant."""
    holders = [cls]
    for part in location[:-1]:
        if isinstance(part, str) and "[" not in part and "(" not in part:
            holders = [inner for holder in holders for inner in _classes(_fields(holder).get(part))]
    key, allowed = str(location[-1]), sorted({name for holder in holders for name in _fields(holder)})
    close = difflib.get_close_matches(key, allowed, n=1)
    return f"did you mean {close[0]}?" if close else "is it misspelt?"


def _fields(cls: Any) -> dict[str, Any]:
    """Return the type of each field of a settings class; none of any other."""
    fields = getattr(cls, "__pydantic_fields__", {})
    return {name: field.annotation for name, field in fields.items()}


def _classes(annotation: Any) -> Iterator[Any]:
    """Yield the classes with fields that a type consists of."""
    if isinstance(annotation, type) and dataclasses.is_dataclass(annotation):
        yield annotation
    for part in typing.get_args(annotation):
        yield from _classes(part)


def _explain(item: dict[str, Any], cls: Any) -> tuple[str, str]:
    """Return what was found and what was expected in a file that is read into a class."""
    kind = item["type"]
    context: dict[str, Any] = item.get("ctx", {})
    if kind in _ABSENT:
        is_item = bool(item["loc"]) and isinstance(item["loc"][-1], int)
        return "nothing", "one more item" if is_item else "this key (it has no default)"
    if kind in _UNKNOWN:
        return "an unknown key", f"only the documented keys ({_meant(item['loc'], cls)})"
    if kind == "unfit":  # raised by a class's own check of keys that must fit together
        return str(context["found"]), str(context["expected"])
    found = "an empty value" if item.get("input") is None else repr(item["input"])
    if len(found) > _LONGEST:
        found = found[: _LONGEST - 3] + "..."
    if kind == "literal_error":
        allowed = str(context["expected"])
        return found, f"one of {allowed}" if " or " in allowed else allowed
    if kind == "value_error":
        return found, str(context.get("error", item["msg"]))
    expected = _EXPECTED.get(kind)
    return found, expected.format(**context) if expected else str(item["msg"])
