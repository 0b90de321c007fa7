"""Publish and receive light messages (see `wire`) through rclpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message

from auv_msgs_py.contract import qos, wire
from auv_msgs_py.contract.codec import LITTLE_ENDIAN
from auv_msgs_py.contract.topics import Topic
from auv_msgs_py.node.private_rclpy import raw_sender
from auv_msgs_py.values.errors import MessageRefused

#: The encapsulation identifiers of DDS end here (DDS-XTypes 1.3, table 60).
_LAST_ENCODING = b"\x0b"


class WirePublisher(Publisher):  # type: ignore[misc]
    """Publish light messages as their bytes, and generated ones as rclpy does."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        self._send = raw_sender(self)

    def publish(self, message: Any) -> None:
        if isinstance(message, wire.Message):
            self._send(message.serialized())
        else:
            super().publish(message)


def decoder(topic: Topic) -> Callable[[bytes], Any]:
    """Return the function that turns the bytes of a raw subscription into a message.

    A type of `wire` is returned as its light class, the same object each time; any other type, and bytes in
    another byte order, as the generated class. Subscriptions are raw because the middleware drops bytes that
    it cannot decode without counting them. The function raises `MessageRefused` for those.
    """
    generated = generated_decoder(topic)
    if topic.type not in wire.LIGHT:
        return generated
    light: wire.Message = wire.LIGHT[topic.type]()

    def decode(data: bytes) -> Any:
        try:
            light.read(data)
        except wire.ForeignLayout:
            if data[:2] == LITTLE_ENDIAN:
                raise _refused(topic, data) from None
            return generated(data)
        return light

    return decode


def generated_decoder(topic: Topic) -> Callable[[bytes], Any]:
    """Return a function as `decoder` does, which always makes a new message of the generated class."""
    kind = qos.message_class(topic.type)

    def decode(data: bytes) -> Any:
        # The deserialiser writes ten lines to stderr for each failure: refuse unknown encodings before.
        if data[:1] != b"\0" or data[1:2] > _LAST_ENCODING:
            raise _refused(topic, data)
        try:
            return deserialize_message(data, kind)
        except Exception:  # of a type that depends on the middleware
            raise _refused(topic, data) from None

    return decode


def _refused(topic: Topic, data: bytes) -> MessageRefused:
    return MessageRefused(topic.name, f"{len(data)} bytes that do not decode", topic.type)
