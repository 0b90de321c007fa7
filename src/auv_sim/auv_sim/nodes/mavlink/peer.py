"""Which sender is the vehicle: decided once, kept while it speaks. ROS-free; times in s."""

from __future__ import annotations

import math
import socket
from collections.abc import Sequence

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.nodes.mavlink.codec import Frame

Address = tuple[str, int]
#: Other systems that are named, at most: a forger can invent 255.
_NAMED = 5
#: A stranger is reported for this long after its last datagram, s.
_RECENT = 5.0


class Configured:
    """A sender that was named beforehand.

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
        """Whether a sender may be the vehicle."""
        host, port = sender
        return host == self._host and self._port in (None, port)


class Peer:
    """The one address that is taken for the vehicle, and what came from others.

    Without signatures a vehicle is recognised by its address alone. So the first sender that speaks as
    `system` is kept, and another one takes its place only after the first was silent for `patience`.

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
        """Whether a datagram is worth reading: its sender is the vehicle, or might become it."""
        if sender == self.address:
            return True
        allowed = self._allowed is None or self._allowed.allows(sender)
        return allowed and (self.address is None or now > self._heard_at + self._patience)

    def is_vehicle(self, sender: Address, frames: Sequence[Frame], now: float) -> bool:
        """Take in what a datagram of a sender that may be the vehicle held; whether it is."""
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
        """Count a stranger's datagram, whatever it says."""
        if now > self._stranger_at + _RECENT:
            self._stranger = sender
        self.strangers += 1
        self._stranger_at = now

    def stranger(self, now: float) -> str:
        """Where datagrams come from that are not the vehicle's, as HOST:PORT; empty if none came lately."""
        recent = self._stranger is not None and now <= self._stranger_at + _RECENT
        return text_of(self._stranger) if recent else ""


def text_of(address: Address | None) -> str:
    """HOST:PORT, for people."""
    return f"{address[0]}:{address[1]}" if address is not None else "nowhere yet"
