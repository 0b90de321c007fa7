"""MAVLink 2 over UDP: one socket, one peer, messages in and out. ROS-free."""

from __future__ import annotations

import re
import socket
import time
from collections.abc import Callable
from typing import Any

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.mavlink.transport.datagrams import LARGEST_DATAGRAM, Codec, Frame
from auv_sim.nodes.mavlink.transport.peer import Address, Peer, text_of

#: UDP port on which ground stations listen for vehicles.
STANDARD_PORT = 14550
_ADDRESS = re.compile(r"(udp|udpin|udpout):([\w.\-]+):(\d+)")
#: Receive buffer requested from the system, bytes: it holds what arrives while the process is not scheduled.
_RECEIVE_BUFFER = 4_000_000


def parse_address(text: str, where: str) -> tuple[bool, str, int]:
    """Parse `udpin:HOST:PORT` (or `udp:`), which waits for the vehicle, or `udpout:`, which sends to it.

    Returns:
        (whether to wait, host, port).

    Raises:
        ConfigurationError: another form, or an invalid port.
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
        where: the parameter or option, for the message.
        peer: decides which sender is the vehicle; any sender and system if None.
        key: of signatures, see `Codec`.
        clock: wall time, s.

    Raises:
        ConfigurationError: the address cannot be used.
    """

    def __init__(
        self,
        address: str,
        system: int,
        component: int,
        where: str = "address",
        peer: Peer | None = None,
        key: bytes | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        waits, host, port = parse_address(address, where)
        self.peer = peer if peer is not None else Peer()
        self._clock = clock
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, _RECEIVE_BUFFER)
        try:
            if waits:
                self._socket.bind((host, port))
            else:  # a connected socket receives from this peer alone
                self._socket.connect((host, port))
                self.peer.address = self._socket.getpeername()
        except OSError as error:
            self._socket.close()
            raise ConfigurationError(
                where, f"'{address}' ({error.strerror})", "an address that is free"
            ) from None
        self._waits = waits
        self._sender: Address = ("", 0)
        self._codec = Codec(system, component, key)
        self._numbers: dict[tuple[int, int], int] = {}
        self._peer_address: Address | None = None
        #: Lost messages of the peer, by the gaps in their numbering; datagrams that could not be read to the
        #: end, and the reason for the last of them.
        self.lost = self.damaged = 0
        self.damage = ""

    def receive(self, timeout: float) -> bytes | None:
        """Return one datagram, which may be empty; None when none arrives within `timeout` s."""
        try:
            self._socket.settimeout(timeout)
            data, self._sender = self._socket.recvfrom(LARGEST_DATAGRAM + 1)
        except OSError:  # timeout, or an ICMP error: no socket at the other end yet
            return None
        return data

    def messages(self, datagram: bytes) -> list[Any]:
        """Return the peer's messages in the datagram last received; count what cannot be read."""
        sender, now = self._sender, self._clock()
        if not self.peer.may_be(sender, now):
            self.peer.refuse(sender, now)
            return []
        frames, damage = self._codec.unpack(datagram)
        if damage:
            self.damaged += 1
            self.damage = f"{damage}, from {text_of(sender)}"
        if not self.peer.is_vehicle(sender, frames, now):
            self.peer.refuse(sender, now)
            return []
        if sender != self._peer_address:
            self._peer_address = sender
            self._numbers.clear()
        self._count(frames)
        return [frame.message for frame in frames if frame.message is not None]

    def _count(self, frames: list[Frame]) -> None:
        """Count the gaps in the numbering of each component."""
        for frame in frames:
            source = frame.system, frame.component
            missing = (frame.number - self._numbers.get(source, frame.number - 1) - 1) % 256
            if missing < 128:  # otherwise it was overtaken
                self.lost += missing
                self._numbers[source] = frame.number

    def pack(self, message: Any, component: int | None = None, line: int = 0) -> bytes:
        """Pack a message into our next datagram, see `Codec.pack`."""
        return self._codec.pack(message, component, line)

    def send(self, message: Any) -> None:
        """Send a message; it is discarded before the vehicle has been heard."""
        self.send_bytes(self.pack(message))

    def send_bytes(self, data: bytes) -> None:
        """Send a datagram of `pack`; like UDP, without any guarantee."""
        if self.peer.address is None:
            return
        try:
            if self._waits:
                self._socket.sendto(data, self.peer.address)
            else:
                self._socket.send(data)
        except OSError:
            return  # no socket there, or the network is down: the peer notices the silence

    def close(self) -> None:
        """Close the socket."""
        self._socket.close()
