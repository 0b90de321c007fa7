"""Claims on what the processes of this machine choose from: ROS domains and UDP ports."""

from __future__ import annotations

import socket


def claim(name: str) -> socket.socket | None:
    """Claim a name; return what holds the claim until it is closed, None if another caller holds it.

    It is a name of Linux's abstract namespace. Like UDP ports it belongs to the network namespace, and the
    kernel releases it however the process ends.
    """
    held = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    try:
        held.bind(f"\0auv_path_following/{name}")
    except OSError:
        held.close()
        return None
    return held
