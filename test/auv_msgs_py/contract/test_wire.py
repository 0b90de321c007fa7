"""The light messages against rclpy's own serialiser and deserialiser."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message

from auv_msgs_py.contract import qos, wire
from auv_msgs_py.contract.topics import CLOCK, PER_STEP

TYPES = sorted(wire.LIGHT)
NUMBERS = st.floats(allow_nan=False)
TEXTS = st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=20)


def leaves(message: Any, path: str = "") -> dict[str, Any]:
    """Every value of a ROS message by its dotted name; a covariance is one value."""
    found: dict[str, Any] = {}
    for name in message.get_fields_and_field_types():
        value, dotted = getattr(message, name), f"{path}{name}"
        if hasattr(value, "get_fields_and_field_types"):
            found |= leaves(value, f"{dotted}.")
        else:
            found[dotted] = value if isinstance(value, float | int | str) else tuple(map(float, value))
    return found


def get(message: Any, dotted: str) -> Any:
    for name in dotted.split("."):
        message = getattr(message, name)
    return message


def put(message: Any, dotted: str, value: Any) -> None:
    *parents, name = dotted.split(".")
    setattr(get(message, ".".join(parents)) if parents else message, name, value)


def values_for(dotted: str, default: Any) -> st.SearchStrategy[Any]:
    if isinstance(default, str):
        return TEXTS
    if isinstance(default, tuple):
        # Thirty-six draws for each would take longer than all the rest.
        return st.integers(0, 2**32 - 1).map(
            lambda seed: tuple(np.random.default_rng(seed).normal(size=36).tolist())
        )
    if isinstance(default, int):
        return st.integers(0, 999_999_999)
    return NUMBERS


@st.composite
def filled(draw: st.DrawFn, type_name: str) -> Any:
    message = qos.message_class(type_name)()
    for dotted, default in leaves(message).items():
        put(message, dotted, draw(values_for(dotted, default)))
    return message


def test_everything_that_is_sent_every_step_is_light() -> None:
    assert {topic.type for topic in (CLOCK, *PER_STEP)} == set(wire.LIGHT)


@pytest.mark.parametrize("type_name", TYPES)
def test_a_new_message_is_what_rclpy_makes(type_name: str) -> None:
    light, real = wire.LIGHT[type_name](), qos.message_class(type_name)()
    assert deserialize_message(light.serialized(), type(real)) == real
    for dotted, value in leaves(real).items():
        assert get(light, dotted) == value


@pytest.mark.parametrize("type_name", TYPES)
def test_bytes_and_values_are_those_of_rclpy(type_name: str) -> None:
    """One reader and one writer for all examples: frame ids change under them, as on a real topic."""
    reader, writer = wire.LIGHT[type_name](), wire.LIGHT[type_name]()

    @settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
    @given(filled(type_name))
    def check(message: Any) -> None:
        data = serialize_message(message)
        reader.read(data)
        for dotted, value in leaves(message).items():
            assert get(reader, dotted) == value, dotted
            put(writer, dotted, value)
        # Byte for byte they may differ where a number is aligned: rclpy leaves there what the memory held.
        for light in (reader, writer):
            assert len(light.serialized()) == len(data)
            assert deserialize_message(light.serialized(), type(message)) == message

    check()


@pytest.mark.parametrize("type_name", [name for name in TYPES if not name.endswith("Clock")])
def test_not_a_number_travels(type_name: str) -> None:
    """NaN means no bottom lock."""
    message = qos.message_class(type_name)()
    for dotted, default in leaves(message).items():
        if isinstance(default, float):
            put(message, dotted, float("nan"))
    light = wire.LIGHT[type_name]()
    light.read(serialize_message(message))
    assert all(math.isnan(get(light, d)) for d, v in leaves(message).items() if isinstance(v, float))


@pytest.mark.parametrize("type_name", TYPES)
def test_what_it_does_not_understand_is_left_to_rclpy(type_name: str) -> None:
    light, data = wire.LIGHT[type_name](), serialize_message(qos.message_class(type_name)())
    for foreign in (b"\x00\x00" + data[2:], data[: len(data) // 2], b""):
        with pytest.raises(wire.ForeignLayout):
            light.read(foreign)
    light.read(data)  # and it has not been harmed
    assert len(light.serialized()) == len(data)
