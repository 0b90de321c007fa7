"""Registered laws, and the settings and the step derived from a list of them.

A new law is one file with its `LAW`, one entry in the list of its kind and one test. Parameters, allowed
names, a change of gains in flight, the compiled dispatch and the rows of docs/parameters.md follow.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Sequence
from typing import Any, Literal, NamedTuple, TypeVar, dataclass_transform

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import Step, dispatched, numbers_of

T = TypeVar("T")


def only_numbers(gains: Any, _: Any) -> Any:
    """Return the settings as plain numbers: the configuration of a law that needs nothing of the vehicle."""
    return numbers_of(gains)


class Law(NamedTuple):
    """One law.

    Attributes:
        name: in parameter files and on the command line.
        doc: name in the documentation.
        Settings: its gains, a settings class.
        Config: class of its configuration, a named tuple of numbers.
        initial: its state at the beginning, a named tuple of numbers.
        step: `step(config, state, inputs, dt) -> (state, output)`.
        prepare: makes the configuration of settings and vehicle; raises `ConfigurationError`.
    """

    name: str
    doc: str
    Settings: type[Any]
    Config: type[Any]
    initial: Any
    step: Step
    prepare: Callable[[Any, Any], Any] = only_numbers


def law_of(laws: Sequence[Law], name: str) -> Law:
    """Return the law of that name."""
    return next(law for law in laws if law.name == name)


def chosen_step(laws: Sequence[Law]) -> Step:
    """Return the step that calls the law of its configuration."""
    return dispatched({law.Config: law.step for law in laws})


@dataclass_transform(frozen_default=True, kw_only_default=True)
def law_settings(key: str, doc: str, laws: Sequence[Law]) -> Callable[[type[T]], type[T]]:
    """Decorate a settings class with a choice among laws: adds the choice and the gains of each law.

    Args:
        key: name of the choice; the first law is the default.
        doc: what is chosen.
        laws: to choose from.
    """
    names = [law.name for law in laws]
    listed = " or ".join([", ".join(names[:-1]), names[-1]])

    def decorate(cls: type[T]) -> type[T]:
        own = inspect.get_annotations(cls)
        cls.__annotations__ = {key: Literal[tuple(names)]} | {law.name: law.Settings for law in laws} | own
        setattr(cls, key, setting(names[0], f"{doc}: {listed}"))
        for law in laws:
            setattr(cls, law.name, setting(factory=law.Settings, doc=law.doc))
        return settings(cls)

    return decorate
