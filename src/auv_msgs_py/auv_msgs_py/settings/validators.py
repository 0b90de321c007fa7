"""Checks that several settings classes share; pydantic runs them and `explanations` puts them into words."""

from __future__ import annotations

import itertools
from typing import Any

from pydantic_core import PydanticCustomError


def unfit(found: str, expected: str) -> PydanticCustomError:
    """Return the error of keys that do not fit together, for a class's own validator to raise."""
    return PydanticCustomError("unfit", "keys that do not fit", {"found": found, "expected": expected})


def exactly_one(spec: Any, names: tuple[str, ...], what: str) -> str:
    """Return the one of these fields that is given.

    Args:
        spec: a settings object, whose absent fields are None.
        names: of the fields.
        what: what they are, for the error: `kinds of route`.

    Raises:
        PydanticCustomError: none is given, or several are.
    """
    given = [name for name in names if getattr(spec, name) is not None]
    if len(given) != 1:
        listed = f" ({', '.join(given)})" if given else ""
        raise unfit(f"{len(given)} {what}{listed}", f"exactly one of {', '.join(names)}")
    return given[0]


def no_boolean(value: Any) -> Any:
    """Return the value of a literal number, unless it is a boolean: Python takes True for 1.

    Raises:
        PydanticCustomError: it is a boolean.
    """
    if isinstance(value, bool):
        raise PydanticCustomError("int_type", "a whole number")
    return value


def increasing(rows: tuple[tuple[float, ...], ...]) -> tuple[tuple[float, ...], ...]:
    """Return the rows of a table whose first numbers increase.

    Raises:
        PydanticCustomError: a first number is not greater than the one before.
    """
    for before, after in itertools.pairwise(rows):
        if not after[0] > before[0]:
            raise unfit(f"{after[0]:g} after {before[0]:g}", "first numbers of the rows that increase")
    return rows
