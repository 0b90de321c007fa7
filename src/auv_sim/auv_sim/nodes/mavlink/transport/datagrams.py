"""MAVLink 2 messages into datagrams and back; each datagram is read alone. ROS-free."""

from __future__ import annotations

from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from auv_sim.nodes.mavlink.transport.signing import Reader, keep_time, signing

#: Largest datagram that is read, bytes: more than an Ethernet frame holds.
LARGEST_DATAGRAM = 2048
#: Messages of one datagram that may fail their checks before the rest is left unread: each costs time.
_MOST_FAILURES = 4


class Frame(NamedTuple):
    """One message: the system and component that sent it, and the sender's running number (0 to 255).

    `message` is None where the dialect does not have it: its number counts, its content cannot be read.
    """

    system: int
    component: int
    number: int
    message: Any


class Codec:
    """Packs our messages and unpacks received ones.

    Args:
        system, component: our own ids.
        key: 32 bytes: outgoing messages are signed, and incoming ones must be.
    """

    def __init__(self, system: int, component: int, key: bytes | None = None) -> None:
        self._system, self._component = system, component
        self._signing = signing(key)
        self._reader = Reader(None, system, component)
        self._reader.signing = self._signing
        self._packers: dict[int, Any] = {}

    def unpack(self, datagram: bytes) -> tuple[list[Frame], str]:
        """Read one datagram.

        Returns:
            The messages in it, and what is wrong with the rest ("": nothing). A message that fails its
            checks is skipped; reading ends where none begins, and after `_MOST_FAILURES`.
        """
        if not 0 < len(datagram) <= LARGEST_DATAGRAM:
            return [], "too large a datagram" if datagram else "an empty datagram"
        keep_time(self._signing)
        frames: list[Frame] = []
        at, failures, damage = 0, 0, ""
        while at < len(datagram) and failures < _MOST_FAILURES:
            end = at + _length(datagram, at)
            if not at < end <= len(datagram):
                return frames, "no MAVLink" if end == at else "a message cut short"
            data = datagram[at:end]
            try:
                message = self._reader.decode(bytearray(data))
            except mavlink.MAVError as error:
                failures, damage = failures + 1, str(error.message)
            else:
                known = not isinstance(message, mavlink.MAVLink_unknown)
                frames.append(Frame(*_sender(data), message if known else None))
            at = end
        return frames, damage

    def pack(self, message: Any, component: int | None = None, line: int = 0) -> bytes:
        """Pack a message into our next datagram.

        Args:
            message: a MAVLink message.
            component: the sender within our system; our own if None.
            line: link id of the signature. Signatures must rise on each link: messages that may overtake each
            other need separate ones.
        """
        component = self._component if component is None else component
        if component not in self._packers:
            self._packers[component] = mavlink.MAVLink(None, self._system, component)
            self._packers[component].signing = self._signing
        packer = self._packers[component]
        keep_time(self._signing)
        self._signing.link_id = line
        data: bytes = message.pack(packer)
        packer.seq = (packer.seq + 1) % 256
        return data


def _length(datagram: bytes, at: int) -> int:
    """Return the length of the message that begins at `at`, from its header; 0 if none begins."""
    header = datagram[at : at + 3]
    if len(header) == 3 and header[0] == mavlink.PROTOCOL_MARKER_V2:
        if header[2] & ~mavlink.MAVLINK_IFLAG_SIGNED:
            return 0  # an unknown flag: by the specification the message is dropped
        signature = mavlink.MAVLINK_SIGNATURE_BLOCK_LEN if header[2] else 0
        return int(mavlink.HEADER_LEN_V2 + header[1] + 2 + signature)
    if len(header) == 3 and header[0] == mavlink.PROTOCOL_MARKER_V1:
        return int(mavlink.HEADER_LEN_V1 + header[1] + 2)
    return 0


def _sender(data: bytes) -> tuple[int, int, int]:
    """Return system, component and sequence number from a message's header."""
    at = 4 if data[0] == mavlink.PROTOCOL_MARKER_V2 else 2
    return data[at + 1], data[at + 2], data[at]
