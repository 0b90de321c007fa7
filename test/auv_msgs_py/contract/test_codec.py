"""The table of layouts against the serialiser of rosbags, which has the definitions of ROS 2 Jazzy."""

from __future__ import annotations

from operator import attrgetter
from typing import Any

import numpy as np
import pytest
from rosbags.typesys import Stores, get_typestore

from auv_msgs_py.contract import topics, wire
from auv_msgs_py.contract.codec import LAYOUTS, Layout

STORE = get_typestore(Stores.ROS2_JAZZY)
#: Types of the contract with parts of variable length besides frame ids, or with whole numbers.
OTHERS = {
    "nav_msgs/msg/Path",
    "std_msgs/msg/String",
    "std_msgs/msg/UInt64",
    "diagnostic_msgs/msg/DiagnosticArray",
    # Once a mission, or once a second.
    "diagnostic_msgs/msg/DiagnosticStatus",
    "geometry_msgs/msg/PolygonStamped",
    "sensor_msgs/msg/NavSatFix",
}


def random_message(type_name: str, generator: np.random.Generator) -> Any:
    """A message of the type in which no two values are equal."""
    values: list[Any] = []
    for field, (kind, what) in STORE.fielddefs[type_name][1]:
        if kind.name == "NAME":
            values.append(random_message(what, generator))
        elif kind.name == "ARRAY":
            values.append(generator.normal(size=what[1]))
        elif what[0] == "string":
            values.append(field + "/" * int(generator.integers(9)))
        elif what[0] == "float64":
            values.append(float(generator.normal()))
        else:
            values.append(int(generator.integers(10**9)))
    return STORE.types[type_name](*values)


def numbers_of(layout: Layout, message: Any) -> list[float]:
    return (
        np.hstack([attrgetter(field)(message) for field in layout.numbers]).tolist() if layout.numbers else []
    )


def test_every_type_of_the_contract_has_a_layout_or_a_reason() -> None:
    types = {topic.type for topic in (*topics.CONTRACT, *topics.RECORDING, topics.GRAPH_CLAIMS)}
    assert types == {*LAYOUTS, *OTHERS}
    assert set(wire.LIGHT) == set(LAYOUTS)


@pytest.mark.parametrize("type_name", LAYOUTS)
def test_light_messages_have_the_bytes_of_rosbags(type_name: str) -> None:
    layout, light, generator = LAYOUTS[type_name], wire.LIGHT[type_name](), np.random.default_rng(0)
    for _ in range(20):
        message = random_message(type_name, generator)
        data = bytes(STORE.serialize_cdr(message, type_name))
        light.read(data)
        if layout.stamp:
            stamp, found = attrgetter(layout.stamp)(message), attrgetter(layout.stamp)(light)
            assert (found.sec, found.nanosec) == (stamp.sec, stamp.nanosec)
        for field in layout.texts:
            assert attrgetter(field)(light) == attrgetter(field)(message)
        assert numbers_of(layout, light) == numbers_of(layout, message)
        assert light.serialized() == data


@pytest.mark.parametrize("type_name", LAYOUTS)
def test_the_table_names_every_field_in_its_place(type_name: str) -> None:
    """Every float64 of the definition, in its order, under the name by which `column` finds it."""
    layout = LAYOUTS[type_name]
    message = random_message(type_name, np.random.default_rng(1))
    data = bytes(STORE.serialize_cdr(message, type_name))
    doubles = np.frombuffer(data[len(data) - 8 * layout.doubles :], "<f8").tolist()
    assert doubles == numbers_of(layout, message)
    for field, length in layout.numbers.items():
        at = layout.column(field)
        assert doubles[at : at + length] == np.atleast_1d(attrgetter(field)(message)).tolist()
    with pytest.raises(ValueError, match="nothing"):
        layout.column("nothing")


@pytest.mark.parametrize("type_name", LAYOUTS)
def test_the_other_byte_order_is_refused(type_name: str) -> None:
    message = random_message(type_name, np.random.default_rng(2))
    data = bytes(STORE.serialize_cdr(message, type_name, little_endian=False))
    with pytest.raises(wire.ForeignLayout):
        wire.LIGHT[type_name]().read(data)
