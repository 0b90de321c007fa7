"""Which sender is the vehicle: decided once, kept while it sends. ROS-free; times in s."""

from __future__ import annotations

import math
import socket
from collections.abc import Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.mavlink.transport.datagrams import Frame

Address = tuple[str, int]
#: Most other systems that are named: a forger can invent 255.
_NAMED = 5
#: Time for which a stranger is reported after its last datagram, s.
_RECENT = 5.0


class Configured:
    """A configured sender.

    Args:
        text: HOST or HOST:PORT; without a port any of that host.
        where: the parameter, for the message.

    Raises:
        ConfigurationError: another form, or a host that cannot be found.
    """

    def __init__(self, text: str, where: str) -> None:
        name, _, port = text.partition(":")
        try:
            self._host = socket.gethostbyname(name) if name else ""
            self._port = int(port) if port else None
        except (OSError, ValueError):
            self._host = ""
        if not self._host or (self._port is not None and not 0 < self._port < 65536):
            raise ConfigurationError(where, f"'{text}'", "HOST or HOST:PORT")

    def allows(self, sender: Address) -> bool:
        """Return whether a sender may be the vehicle."""
        host, port = sender
        return host == self._host and self._port in (None, port)


class Peer:
    """The address taken for the vehicle's, and counts of other senders.

    Without signatures a vehicle is recognised by its address alone. So the first sender with the id `system`
    is kept, and another one takes its place only after the first was silent for `patience`.

    Args:
        system: MAVLink id of the vehicle; None: any.
        patience: s of silence; infinite for an address that never changes.
        allowed: the only senders that may be the vehicle; None: any.
    """

    def __init__(
        self, system: int | None = None, patience: float = math.inf, allowed: Configured | None = None
    ) -> None:
        self._system, self._patience, self._allowed = system, patience, allowed
        self.address: Address | None = None
        #: How often another sender took the vehicle's place; datagrams of others; other systems heard.
        self.changes = self.strangers = 0
        self.others: set[tuple[int, int]] = set()
        self._heard_at = self._stranger_at = -math.inf
        self._stranger: Address | None = None

    def may_be(self, sender: Address, now: float) -> bool:
        """Return whether a datagram is worth reading: its sender is the vehicle, or might become it."""
        if sender == self.address:
            return True
        allowed = self._allowed is None or self._allowed.allows(sender)
        return allowed and (self.address is None or now > self._heard_at + self._patience)

    def is_vehicle(self, sender: Address, frames: Sequence[Frame], now: float) -> bool:
        """Process the messages of a sender that may be the vehicle; return whether it is."""
        ours = False
        for frame in frames:
            if self._system in (None, frame.system):
                ours = ours or frame.message is not None
            elif len(self.others) < _NAMED:
                self.others.add((frame.system, frame.component))
        if ours:
            self.changes += self.address not in (None, sender)
            self.address, self._heard_at = sender, now
        return sender == self.address

    def refuse(self, sender: Address, now: float) -> None:
        """Count a stranger's datagram."""
        if now > self._stranger_at + _RECENT:
            self._stranger = sender
        self.strangers += 1
        self._stranger_at = now

    def stranger(self, now: float) -> str:
        """Return the source of recent datagrams that are not the vehicle's, as HOST:PORT; else empty."""
        recent = self._stranger is not None and now <= self._stranger_at + _RECENT
        return text_of(self._stranger) if recent else ""


def text_of(address: Address | None) -> str:
    """Return HOST:PORT, for messages."""
    return f"{address[0]}:{address[1]}" if address is not None else "nowhere yet"
