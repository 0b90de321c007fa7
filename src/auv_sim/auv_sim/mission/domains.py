"""ROS domains that nobody on this machine uses."""

from __future__ import annotations

import os
import socket

#: Domains above reach into the ports that Linux hands out by itself; 0 is everybody's default.
LAST = 101


def free_domain(skip: int = 0) -> int:
    """A ROS domain in which no participant of this machine is found.

    Args:
        skip: how many domains to leave out, for who needs several before he uses any.
    """
    # Where to begin depends on the process, so that two that ask at the same moment do not meet.
    begin = os.getpid() + skip
    numbers = [1 + (begin + k) % LAST for k in range(LAST)]
    return next((number for number in numbers if not _used(number)), numbers[0])


def _used(number: int) -> bool:
    """Whether the port of a domain's first participant is taken (DDSI-RTPS: 7410 + 250 d)."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("127.0.0.1", 7410 + 250 * number))
        except OSError:
            return True
    return False
