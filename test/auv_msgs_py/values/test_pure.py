"""Pure functions: settings as numbers, and a step chosen by the type of its configuration."""

from __future__ import annotations

import pickle
from typing import Any, Literal, NamedTuple

import pytest

from auv_msgs_py.settings.schema import setting, settings
from auv_msgs_py.values.pure import DISPATCHED, PURE, dispatched, numbers, numbers_of, pure


@numbers
@settings
class Inner:
    gain: float = setting(2.0)
    enabled: bool = setting(True)


@numbers
@settings
class Outer:
    mode: Literal["off", "on"] = setting("on")
    inner: Inner = setting(factory=Inner)


def test_settings_become_numbers_of_the_same_names() -> None:
    made = numbers_of(Outer(inner=Inner(gain=3)))
    assert (made.mode, made.inner.gain, made.inner.enabled) == (1, 3.0, True)
    assert [type(value) for value in made.inner] == [float, bool]


def test_numbers_can_be_pickled_as_the_cache_of_compiled_code_does() -> None:
    made = numbers_of(Outer())
    assert pickle.loads(pickle.dumps(made)) == made  # noqa: S301


def test_a_pure_function_is_unchanged_and_listed() -> None:
    def double(x: float) -> float:
        return 2.0 * x

    try:
        assert pure(double) is double
        assert PURE[-1] is double
    finally:
        PURE.remove(double)


class One(NamedTuple):
    gain: float


class Two(NamedTuple):
    gain: float


def test_a_step_is_chosen_by_the_type_of_its_configuration() -> None:
    def one(config: Any, state: Any, inputs: Any, dt: float) -> tuple[Any, Any]:
        return state, config.gain * inputs

    def two(config: Any, state: Any, inputs: Any, dt: float) -> tuple[Any, Any]:
        return state + dt, -config.gain * inputs

    step = dispatched({One: one, Two: two})
    try:
        assert step(One(2.0), 0.0, 3.0, 0.1) == (0.0, 6.0)
        assert step(Two(2.0), 0.0, 3.0, 0.1) == (0.1, -6.0)
        with pytest.raises(KeyError):
            step((2.0,), 0.0, 3.0, 0.1)
    finally:
        DISPATCHED.pop()
