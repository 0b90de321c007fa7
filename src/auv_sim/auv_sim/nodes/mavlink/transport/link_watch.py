"""The state of the link for /diagnostics: strangers, damage, another address, another system. ROS-free."""

from __future__ import annotations

import math

from auv_sim.nodes.mavlink.transport.link import MavlinkLink
from auv_sim.nodes.mavlink.transport.peer import text_of

#: Time for which damage is reported after it was last seen, s of wall time.
_RECENT = 5.0


class LinkWatch:
    """Turns the counts of a link into conditions.

    Args:
        link: the watched link.
        system: MAVLink id of the vehicle.
    """

    def __init__(self, link: MavlinkLink, system: int) -> None:
        self._link, self._system = link, system
        self._damaged, self._damaged_at = 0, -math.inf
        self._changes = 0

    def values(self) -> dict[str, object]:
        """Return the counts, for /diagnostics."""
        link, peer = self._link, self._link.peer
        return {
            "vehicle at": text_of(peer.address),
            "messages lost": link.lost,
            "datagrams damaged": link.damaged,
            "datagrams of strangers": peer.strangers,
            "changes of address": peer.changes,
        }

    def moved(self) -> str:
        """Return the vehicle's new address, once after each change; else empty."""
        peer = self._link.peer
        changed, self._changes = peer.changes > self._changes, peer.changes
        return f"the vehicle now speaks from {text_of(peer.address)}" if changed else ""

    def conditions(self, now: float, heard: bool) -> dict[str, str]:
        """Return the name of each condition -> its text, empty where it does not hold.

        Args:
            now: wall time, s.
            heard: whether the vehicle has been heard.
        """
        link, peer = self._link, self._link.peer
        stranger = peer.stranger(now)
        vehicle = f"is at {text_of(peer.address)}" if peer.address else "has not been heard yet"
        refused = f"datagrams from {stranger} are refused: the vehicle {vehicle}"
        if link.damaged > self._damaged:
            self._damaged, self._damaged_at = link.damaged, now
        others = ", ".join(f"{system} (component {component})" for system, component in sorted(peer.others))
        return {
            "strangers": refused if stranger else "",
            "damage": f"damaged datagrams: {link.damage}" if now < self._damaged_at + _RECENT else "",
            "system": ""
            if heard or not others
            else f"no vehicle with system id {self._system}, but {others}",
        }
