"""Whose line a message of a shared topic is, from its bytes."""

from __future__ import annotations

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from hypothesis import given, settings
from hypothesis import strategies as st
from rcl_interfaces.msg import Log, ParameterEvent
from rclpy.serialization import serialize_message

from auv_sim.bags import line_owner

WORDS = st.text("abcdefghij_0123456789", min_size=1, max_size=12)


@settings(max_examples=25)
@given(st.lists(WORDS, min_size=1, max_size=3), WORDS, st.text(max_size=9), st.integers(0, 2**31 - 1))
def test_the_node_is_the_one_that_the_message_names(
    spaces: list[str], node: str, frame: str, second: int
) -> None:
    full = "/" + "/".join([*spaces, node])
    array = DiagnosticArray(status=[DiagnosticStatus(name=full, message="/other/node: odom")])
    array.header.stamp.sec, array.header.frame_id = second, frame.replace("\0", "")
    log = Log(name=full[1:].replace("/", "."), msg="/other/node", level=20)
    event = ParameterEvent(node=full)
    for topic, message in (("/diagnostics", array), ("/rosout", log), ("/parameter_events", event)):
        assert line_owner.node_of(topic, serialize_message(message)) == full


@pytest.mark.parametrize("topic", line_owner.SHARED)
@given(data=st.binary(max_size=60))
def test_bytes_of_no_message_are_of_no_vehicle(topic: str, data: bytes) -> None:
    assert isinstance(line_owner.node_of(topic, data), str)
    keeps = line_owner.without(topic, ["/auv1"])
    assert keeps is not None
    assert keeps(b"\0\1\0\0")
    assert not line_owner.only(topic, "/auv1")(b"\0\1\0\0")  # type: ignore[misc]


def test_a_namespace_is_not_another_that_begins_like_it() -> None:
    assert line_owner.is_within("/auv1/odom", "/auv1")
    assert line_owner.is_within("/auv1/odom", "auv1")
    assert line_owner.is_within("/odom", "/")
    assert not line_owner.is_within("/auv10/odom", "/auv1")
    array = DiagnosticArray(status=[DiagnosticStatus(name="/auv10/recorder")])
    keeps = line_owner.without("/diagnostics", ["/auv1"])
    assert keeps is not None
    assert keeps(serialize_message(array))
    assert line_owner.without("/auv1/odom", ["/auv1"]) is None
    assert line_owner.only("/auv1/odom", "/auv2") is None
