from __future__ import annotations

from operator import attrgetter
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from auv_msgs_py.contract.codec import LAYOUTS
from auv_sim.bags.reading.columns import decode, decode_at_once, decode_one_by_one
from auv_sim.bags.writing.bag_writer import typestore

FRAME = st.text(alphabet="abcdefgh_/", max_size=12)


def message(type_name: str, generator: np.random.Generator, frame: str, child: str) -> Any:
    """A message of the type, filled with random numbers."""
    store = typestore()

    def filled(name: str) -> Any:
        values = []
        for field, (kind, what) in store.fielddefs[name][1]:
            if field == "frame_id":
                values.append(frame)
            elif field == "child_frame_id":
                values.append(child)
            elif what[0] == "int32":
                values.append(int(generator.integers(0, 2**31)))
            elif what[0] == "uint32":
                values.append(int(generator.integers(0, 10**9)))
            elif kind.name == "NAME":
                values.append(filled(what))
            elif kind.name == "ARRAY":
                values.append(generator.normal(size=what[1]))
            else:
                values.append(float(generator.normal()))
        return store.types[name](*values)

    return filled(type_name)


@pytest.mark.parametrize("type_name", LAYOUTS)
@settings(max_examples=20)
@given(frame=FRAME, child=FRAME, seed=st.integers(0, 2**32 - 1), n=st.integers(0, 4))
def test_vectorised_decoding_equals_rosbags(
    type_name: str, frame: str, child: str, seed: int, n: int
) -> None:
    generator = np.random.default_rng(seed)
    store = typestore()
    raw = [
        bytes(store.serialize_cdr(message(type_name, generator, frame, child), type_name)) for _ in range(n)
    ]
    fast, slow = decode_at_once(type_name, raw), decode_one_by_one(type_name, raw)
    assert fast is not None
    assert fast.values.shape == (n, LAYOUTS[type_name].doubles)
    np.testing.assert_array_equal(fast.values, slow.values)
    np.testing.assert_array_equal(fast.stamp_ns, slow.stamp_ns)
    assert fast.frames == slow.frames


@pytest.mark.parametrize("type_name", LAYOUTS)
def test_the_byte_order_makes_no_difference(type_name: str) -> None:
    generator = np.random.default_rng(3)
    messages = [message(type_name, generator, "map", "base_link") for _ in range(3)]
    little, big = (
        decode(type_name, [bytes(typestore().serialize_cdr(m, type_name, little_endian=o)) for m in messages])
        for o in (True, False)
    )
    np.testing.assert_array_equal(little.values, big.values)
    np.testing.assert_array_equal(little.stamp_ns, big.stamp_ns)
    assert little.frames == big.frames


def test_columns_of_an_odometry_are_where_they_are_said_to_be() -> None:
    name = "nav_msgs/msg/Odometry"
    odometry = message(name, np.random.default_rng(1), "map", "base_link")
    columns = decode(name, [bytes(typestore().serialize_cdr(odometry, name))])
    row = columns.values[0]
    orientation = odometry.pose.pose.orientation
    assert (row[0], row[1]) == (odometry.pose.pose.position.x, odometry.pose.pose.position.y)
    assert list(row[3:7]) == [orientation.x, orientation.y, orientation.z, orientation.w]
    assert row[48] == odometry.twist.twist.angular.z
    for field in columns.layout.numbers:
        assert columns.column(field)[0] == np.atleast_1d(attrgetter(field)(odometry))[0]
    assert columns.frames == (("map", "base_link"),)
    stamp = odometry.header.stamp
    assert columns.stamp_ns[0] == stamp.sec * 10**9 + stamp.nanosec


def test_unlike_messages_are_decoded_one_by_one() -> None:
    name = "geometry_msgs/msg/Vector3Stamped"
    generator = np.random.default_rng(2)
    store = typestore()
    messages = [message(name, generator, frame, "") for frame in ("map", "pam", "map", "a_longer_name")]
    for picked in ([0, 1], [0, 3], [0, 1, 2, 3]):
        raw = [bytes(store.serialize_cdr(messages[k], name)) for k in picked]
        assert decode_at_once(name, raw) is None
        columns = decode(name, raw)
        np.testing.assert_array_equal(columns.values[:, 1], [messages[k].vector.y for k in picked])
        assert columns.frames == tuple(dict.fromkeys((messages[k].header.frame_id,) for k in picked))
    big_endian = [bytes(store.serialize_cdr(messages[k], name, little_endian=False)) for k in (0, 2)]
    assert decode_at_once(name, big_endian) is None
    np.testing.assert_array_equal(
        decode(name, big_endian).values[:, 0], [messages[k].vector.x for k in (0, 2)]
    )
