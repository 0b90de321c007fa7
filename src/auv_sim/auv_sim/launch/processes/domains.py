"""ROS domains, by the UDP ports that their participants take on this machine."""

from __future__ import annotations

import os
import socket

#: Higher domains use ports that Linux assigns to others; 0 is the default of every program.
LAST = 101
#: Participants for which a domain has ports on one machine.
_PARTICIPANTS = 120


def free_domain(skip: int = 0) -> int:
    """Return a ROS domain in which no participant of this machine is found.

    Args:
        skip: number of domains to leave out, for a caller that needs several before it uses any.
    """
    # The first candidate depends on the process, so that two simultaneous callers get different domains.
    begin = os.getpid() + skip
    numbers = [1 + (begin + k) % LAST for k in range(LAST)]
    return next((number for number in numbers if not _is_taken(number, 0)), numbers[0])


def has_participants(domain: int) -> bool:
    """Return whether any participant of this machine is in a ROS domain."""
    return any(_is_taken(domain, participant) for participant in range(_PARTICIPANTS))


def _is_taken(domain: int, participant: int) -> bool:
    """Return whether the discovery port of a domain's n-th participant is taken (DDSI-RTPS 2.2, 9.6.1)."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("127.0.0.1", 7410 + 250 * domain + 2 * participant))
        except (OSError, OverflowError):
            return True
    return False
