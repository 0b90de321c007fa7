"""Laws as pure functions, and their settings as numbers: Python that a compiler accepts unchanged.

A law is `step(config, state, inputs, dt) -> (state, output)` over named tuples of numbers. Nodes, the closed
loop and a replay call it directly. A compiler, where one is installed, compiles the same source; `PURE` lists
all functions of the laws, helpers included.

A step may write into a ring, a table or a counter that it receives, and changes nothing else.
"""

from __future__ import annotations

import dataclasses
import typing
from collections import namedtuple
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeVar

F = TypeVar("F", bound=Callable[..., Any])
T = TypeVar("T")
Step = Callable[..., Any]


class Dispatched(NamedTuple):
    """A step, chosen by the type of the configuration, and the steps that it chooses from."""

    step: Step
    steps: Mapping[type[Any], Step]


#: All pure functions, in the order of their definition.
PURE: list[Callable[..., Any]] = []
#: All steps made by `dispatched`.
DISPATCHED: list[Dispatched] = []


def pure(function: F) -> F:
    """Mark a pure function; return it unchanged."""
    PURE.append(function)
    return function


@pure
def bounded(value: float, limit: float) -> float:
    """Return a value held within +-limit; NaN stays NaN. Faster than `min` and `max`."""
    return limit if value > limit else -limit if value < -limit else value


def squared(x: float) -> float:
    """Return x ** 2, in compiled code to the same last bit.

    Python's power is not always x * x, which compilers substitute; over a flight that grows to centimetres.
    """
    return x**2


def modulus(z: complex) -> float:
    """Return abs(z), in compiled code to the same last bit: `math.hypot` may differ in it."""
    return abs(z)


def dispatched(steps: Mapping[type[Any], Step]) -> Step:
    """Return a step that calls the one of `steps` for the type of the configuration.

    Args:
        steps: configuration class -> step. The signatures are equal, and begin with the configuration.
    """

    def step(config: Any, state: Any, inputs: Any, dt: float) -> Any:
        return steps[type(config)](config, state, inputs, dt)

    def any_step(config: Any, *inputs: Any) -> Any:
        return steps[type(config)](config, *inputs)

    # Arguments by name are passed in half the time.
    is_law = all(one.__code__.co_argcount == 4 for one in steps.values())
    chosen = step if is_law else any_step
    DISPATCHED.append(Dispatched(chosen, steps))
    return chosen


def numbers(cls: type[T]) -> type[T]:
    """Give a settings class its `Numbers`: a named tuple class with the same field names.

    Optional fields are left out: None is no number.

    Code that only reads `config.k1` accepts either. The tuple compiles; the settings object does not.
    """
    hints = typing.get_type_hints(cls)
    fields = dataclasses.fields(cls)  # type: ignore[arg-type]
    names = [field.name for field in fields if type(None) not in typing.get_args(hints[field.name])]
    made: Any = namedtuple("Numbers", names)  # type: ignore[misc]
    made.__module__, made.__qualname__ = cls.__module__, f"{cls.__qualname__}.Numbers"
    cls.Numbers = made  # type: ignore[attr-defined]
    return cls


def numbers_class(cls: type[Any]) -> type[Any]:
    """Return the named tuple class of a settings class decorated with `numbers`."""
    return cls.Numbers  # type: ignore[no-any-return]


def numbers_of(settings: Any) -> Any:
    """Return a settings object as plain numbers, nested ones included.

    Booleans stay booleans; a word becomes its index among the allowed ones.

    Args:
        settings: an object of a class decorated with `numbers`.
    """
    cls = type(settings)
    hints: dict[str, Any] = {}
    values = []
    for name in cls.Numbers._fields:
        value = getattr(settings, name)
        if dataclasses.is_dataclass(value):
            value = numbers_of(value)
        elif isinstance(value, str):
            hints = hints or typing.get_type_hints(cls)
            value = typing.get_args(hints[name]).index(value)
        elif not isinstance(value, bool):
            value = float(value)
        values.append(value)
    return cls.Numbers(*values)
