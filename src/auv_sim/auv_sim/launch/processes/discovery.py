"""How the processes of a mission find each other soon, and how long it takes to see those of others.

A participant of Fast DDS announces itself 5 times within 0.5 s and then every 3 s. Another one that hears the
first announcement answers it at once, and once only. About every second time the answer comes too early: the
new participant is still being made and drops it. Then the two meet with the next announcement of the other
one, up to 3 s later. So the processes of a mission go on announcing for 6 s (`discovery.xml`), within which
all of them come up; and where participants of others may exist, looking for them takes longer than 3 s.
"""

from __future__ import annotations

import os
from pathlib import Path

from auv_sim.launch.processes.domains import has_participants

_PROFILES, _RANGE = "FASTRTPS_DEFAULT_PROFILES_FILE", "ROS_AUTOMATIC_DISCOVERY_RANGE"
#: How long the graph is looked at, s of wall time: where nothing else can be in it, and otherwise.
LOOK_ALONE, LOOK = 0.5, 3.5


def variables() -> dict[str, str]:
    """Return environment variables for a mission's processes; none where the user has a profile file."""
    if _PROFILES in os.environ:
        return {}
    return {_PROFILES: str(Path(__file__).with_suffix(".xml"))}


def look_for(domain: int) -> float:
    """Return how long to look for participants of others in a ROS domain, s.

    Args:
        domain: in which this process has no participant yet.
    """
    is_local = os.environ.get(_RANGE) == "LOCALHOST" and not os.environ.get("ROS_STATIC_PEERS")
    return LOOK_ALONE if is_local and not has_participants(domain) else LOOK
