"""Configurations as rows of numbers, so that many flights are one compiled call.

A configuration is a named tuple of numbers and of further such tuples. `flat` writes its numbers into a row,
`unpack` restores it in compiled code. Booleans and whole numbers travel as floats and come back as they were.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from auv_sim.flight.batch.compiled import overloads


def flat(config: Any) -> list[float]:
    """Return the numbers of a configuration in the order of its fields, nested ones in place."""
    return list(_numbers(config))


def _numbers(config: Any) -> Iterator[float]:
    for value in config:
        if isinstance(value, tuple):
            yield from _numbers(value)
        else:
            yield float(value)


def layout_of(config: Any) -> Any:
    """Return the type of a configuration in compiled code: its classes and kinds of numbers."""
    if not isinstance(config, tuple):
        return type(config)
    return type(config), *[layout_of(value) for value in config]


def unpack(example: Any, row: Any) -> Any:
    """Return the configuration whose numbers are in a row.

    Args:
        example: any configuration of the same layout.
        row: numbers as from `flat`.
    """
    return _restored(example, iter(row))


def _restored(example: Any, numbers: Iterator[float]) -> Any:
    if not isinstance(example, tuple):
        return type(example)(next(numbers))
    values = [_restored(value, numbers) for value in example]
    return type(example)(*values) if hasattr(example, "_fields") else tuple(values)


@overloads(unpack)
def _compiled_unpack(example: Any, row: Any) -> Any:
    """Return `unpack` for a layout, written out number by number."""
    classes: dict[str, Any] = {}
    count = 0

    def expression(kind: Any) -> str:
        nonlocal count
        members = getattr(kind, "types", None)
        if members is None:
            count += 1
            name = str(kind)
            cast = "bool" if name.startswith("bool") else "int" if name.startswith(("int", "Literal")) else ""
            return f"{cast}(row[{count - 1}])"
        parts = "".join(f"{expression(member)}, " for member in members)
        if (cls := getattr(kind, "instance_class", None)) is None:
            return f"({parts})"
        name = f"C{len(classes)}"
        classes[name] = cls
        return f"{name}({parts})"

    source = f"def restore(example, row):\n    return {expression(example)}\n"
    exec(source, classes)  # noqa: S102 - of class names and numbers only
    return classes["restore"]
