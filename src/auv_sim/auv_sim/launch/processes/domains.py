"""ROS domains, by the UDP ports that their participants take on this machine."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext

from auv_msgs_py.values.errors import ConfigurationError
from auv_sim.launch.processes.claims import claim

#: Higher domains use ports that Linux assigns to others; 0 is the default of every program.
LAST = 101
#: Participants for which a domain has ports on one machine.
_PARTICIPANTS = 120


def domain_for(asked: int | None) -> AbstractContextManager[int]:
    """Return a context of the ROS domain that is asked for; if None, of a free one, claimed until it ends."""
    return free_domain() if asked is None else nullcontext(asked)


def variables_of(domain: int) -> dict[str, str]:
    """Return the environment variables of processes in a ROS domain that no other machine reaches."""
    return {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


@contextmanager
def free_domain(skip: int = 0) -> Iterator[int]:
    """Claim a ROS domain without participants on this machine; the claim ends with the block or the process.

    A domain has no participants until the caller's first node is up: looking alone could give two callers the
    same one. The claim excludes every other caller of this function from the start.

    Args:
        skip: number of domains to pass over. Successive callers of one process that use different numbers do
            not meet participants that are still leaving.

    Yields:
        The number of the domain.

    Raises:
        ConfigurationError: every domain is in use.
    """
    begin = os.getpid() + skip
    for number in (1 + (begin + k) % LAST for k in range(LAST)):
        held = _claim(number)
        if held is None:
            continue
        with held:
            if has_participants(number):
                continue
            yield number
            return
    raise ConfigurationError("ROS domain", f"1 to {LAST} all in use", "a free one, or --domain with a number")


def has_participants(domain: int) -> bool:
    """Return whether any participant of this machine is in a ROS domain."""
    return any(_is_taken(domain, participant) for participant in range(_PARTICIPANTS))


def _claim(domain: int) -> socket.socket | None:
    """Return what holds a claim on a domain until it is closed, None if another caller holds it."""
    return claim(f"ros_domain/{domain}")


def _is_taken(domain: int, participant: int) -> bool:
    """Return whether the discovery port of a domain's n-th participant is taken (DDSI-RTPS 2.2, 9.6.1)."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("127.0.0.1", 7410 + 250 * domain + 2 * participant))
        except (OSError, OverflowError):
            return True
    return False
