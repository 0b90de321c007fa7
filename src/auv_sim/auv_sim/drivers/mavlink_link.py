"""MAVLink 2 over UDP: one socket, one pair of ids, messages in and out. ROS-free."""

from __future__ import annotations

import re
import socket
from collections.abc import Iterator
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from auv_msgs_py.errors import ConfigurationError

#: Where ground stations listen for vehicles.
STANDARD_PORT = 14550
_ADDRESS = re.compile(r"(udp|udpin|udpout):([\w.\-]+):(\d+)")
_LARGEST_DATAGRAM = 65535


def parse_address(text: str, where: str) -> tuple[bool, str, int]:
    """`udpin:HOST:PORT` waits there for the vehicle, `udpout:HOST:PORT` talks to it; `udp` is `udpin`.

    Returns:
        (whether to wait, host, port).

    Raises:
        ConfigurationError: another form, or a port that there is not.
    """
    match = _ADDRESS.fullmatch(text)
    if match is None or not 0 < int(match[3]) < 65536:
        raise ConfigurationError(
            where, f"'{text}'", f"udpin:0.0.0.0:{STANDARD_PORT} to wait for the vehicle, or udpout:HOST:PORT"
        )
    return match[1] != "udpout", match[2], int(match[3])


class MavlinkLink:
    """Sends and receives MAVLink messages.

    Args:
        address: as `parse_address` reads it.
        system, component: our own ids.
        where: what to name when the address cannot be used.
        peer_system: who waits speaks to where this system's last message came from; None: any system's.

    Raises:
        ConfigurationError: the address cannot be used.
    """

    def __init__(
        self,
        address: str,
        system: int,
        component: int,
        where: str = "address",
        peer_system: int | None = None,
    ) -> None:
        waits, host, port = parse_address(address, where)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            if waits:
                self._socket.bind((host, port))
                self._peer: tuple[str, int] | None = None
            else:
                self._socket.connect((host, port))
                self._peer = (host, port)
        except OSError as error:
            self._socket.close()
            raise ConfigurationError(
                where, f"'{address}' ({error.strerror})", "an address that is free"
            ) from None
        self._waits, self._peer_system = waits, peer_system
        self._sender: tuple[str, int] | None = None
        self._codec = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
        self._codec.robust_parsing = True
        self._voices = {component: self._codec}
        self._sequence: dict[tuple[int, int], int] = {}
        #: Messages that never came, by the gaps in the sender's numbering; bytes that were no message.
        self.lost = self.damaged = 0

    def receive(self, timeout: float) -> bytes:
        """One datagram, empty when none came within `timeout` s."""
        try:
            self._socket.settimeout(timeout)
            data, self._sender = self._socket.recvfrom(_LARGEST_DATAGRAM)
        except OSError:  # nothing came, or nobody listens there yet
            return b""
        return data

    def messages(self, datagram: bytes) -> Iterator[Any]:
        """The messages of the datagram last received; damaged ones are counted and left out."""
        for message in self._codec.parse_buffer(datagram) or ():
            if message.get_type() == "BAD_DATA":
                self.damaged += 1
                continue
            if self._waits and self._peer_system in (None, message.get_srcSystem()):
                self._peer = self._sender
            sender = message.get_srcSystem(), message.get_srcComponent()
            number = message.get_seq()
            missing = (number - self._sequence.get(sender, number - 1) - 1) % 256
            if missing < 128:  # otherwise it was overtaken
                self.lost += missing
                self._sequence[sender] = number
            yield message

    def pack(self, message: Any, component: int | None = None) -> bytes:
        """A message as our next datagram, or as that of another component of our system."""
        component = self._codec.srcComponent if component is None else component
        if component not in self._voices:
            self._voices[component] = mavlink.MAVLink(None, self._codec.srcSystem, component)
        codec = self._voices[component]
        data: bytes = message.pack(codec)
        codec.seq = (codec.seq + 1) % 256
        return data

    def send(self, message: Any) -> None:
        """Send a message; before the vehicle has been heard there is nobody to send to."""
        self.send_bytes(self.pack(message))

    def send_bytes(self, data: bytes) -> None:
        """Send what `pack` made. UDP promises nothing, so neither does this."""
        if self._peer is None:
            return
        try:
            if self._waits:
                self._socket.sendto(data, self._peer)
            else:
                self._socket.send(data)
        except OSError:
            return  # nobody listens there, or the network is down: silence is what the other side notices

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()
