"""Pydantic's errors as one line for the user: the key, what was found and what was expected."""

from __future__ import annotations

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


def readable(error: pydantic.ValidationError, where: str) -> ConfigurationError:
    """Return the error that names all keys at fault.

    Args:
        error: of pydantic.
        where: the file.
    """
    errors = error.errors(include_url=False)
    # A misspelt key is missing under one name and unknown under another: first what stands in the file.
    errors.sort(key=lambda item: item["type"] in _ABSENT)
    found = []
    for item in errors:
        place = key_path(item["loc"])
        found.append(ConfigurationError(f"{where}: {place}" if place else where, *_explain(dict(item))))
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


def _explain(item: dict[str, Any]) -> tuple[str, str]:
    """Return what was found and what was expected."""
    kind = item["type"]
    context: dict[str, Any] = item.get("ctx", {})
    if kind in _ABSENT:
        is_item = bool(item["loc"]) and isinstance(item["loc"][-1], int)
        return "nothing", "one more item" if is_item else "this key (it has no default)"
    if kind in _UNKNOWN:
        return "an unknown key", "only the documented keys (is it misspelt?)"
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
