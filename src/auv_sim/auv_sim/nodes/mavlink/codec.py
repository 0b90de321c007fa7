"""MAVLink 2 messages into datagrams and back; each datagram is read alone. ROS-free."""

from __future__ import annotations

from typing import Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from auv_sim.nodes.mavlink.signing import Reader, keep_time, signing

#: More than an Ethernet frame holds; larger ones only cost time, bytes.
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
    """Packs our messages and reads those of others.

    Args:
        system, component: our own ids.
        key: 32 bytes: outgoing messages are signed, and incoming ones must be.
    """

    def __init__(self, system: int, component: int, key: bytes | None = None) -> None:
        self._system, self._component = system, component
        self._signing = signing(key)
        self._reader = Reader(None, system, component)
        self._reader.signing = self._signing
        self._voices: dict[int, Any] = {}

    def unpack(self, datagram: bytes) -> tuple[list[Frame], str]:
        """Read one datagram.

        Returns:
            The messages in it, and what was wrong with the rest ("": nothing). A message that fails its
            checks is skipped; where none begins, and after `_MOST_FAILURES`, the reading ends.
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
        """Make a message our next datagram.

        Args:
            message: what to say.
            component: of our system, in whose name it is said; ours if None.
            line: signatures have to rise on each line; give messages that may overtake each other one each.
        """
        component = self._component if component is None else component
        if component not in self._voices:
            self._voices[component] = mavlink.MAVLink(None, self._system, component)
            self._voices[component].signing = self._signing
        voice = self._voices[component]
        keep_time(self._signing)
        self._signing.link_id = line
        data: bytes = message.pack(voice)
        voice.seq = (voice.seq + 1) % 256
        return data


def _length(datagram: bytes, at: int) -> int:
    """Length of the message that begins there, from its header; 0 if none begins."""
    header = datagram[at : at + 3]
    if len(header) == 3 and header[0] == mavlink.PROTOCOL_MARKER_V2:
        if header[2] & ~mavlink.MAVLINK_IFLAG_SIGNED:
            return 0  # a flag that we do not understand: the specification has the message dropped
        signature = mavlink.MAVLINK_SIGNATURE_BLOCK_LEN if header[2] else 0
        return int(mavlink.HEADER_LEN_V2 + header[1] + 2 + signature)
    if len(header) == 3 and header[0] == mavlink.PROTOCOL_MARKER_V1:
        return int(mavlink.HEADER_LEN_V1 + header[1] + 2)
    return 0


def _sender(data: bytes) -> tuple[int, int, int]:
    """System, component and running number, from a message's header."""
    at = 4 if data[0] == mavlink.PROTOCOL_MARKER_V2 else 2
    return data[at + 1], data[at + 2], data[at]
