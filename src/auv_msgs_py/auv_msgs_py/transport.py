"""Light messages (see `wire`) through rclpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.publisher import Publisher
from rclpy.serialization import deserialize_message

from auv_msgs_py import qos, wire


class WirePublisher(Publisher):  # type: ignore[misc]
    """Sends light messages as the bytes that they are, and generated ones as ever."""

    def __init__(self, *arguments: Any, **named: Any) -> None:
        super().__init__(*arguments, **named)
        # What `Publisher.publish` ends with for bytes; its checks before cost as much again.
        self._send = self.handle.publish_raw

    def publish(self, message: Any) -> None:
        if isinstance(message, wire.Message):
            self._send(message.serialized())
        else:
            super().publish(message)


def reader(type_name: str) -> Callable[[bytes], Any] | None:
    """Turns what a raw subscription delivers into a message; None for a type that has no light class.

    The message is the same object each time. Bytes that `wire` does not understand become a generated one.
    """
    if type_name not in wire.LIGHT:
        return None
    light: wire.Message = wire.LIGHT[type_name]()
    kind = qos.message_class(type_name)

    def read(data: bytes) -> Any:
        try:
            light.read(data)
        except wire.ForeignLayout:
            return deserialize_message(data, kind)
        return light

    return read
