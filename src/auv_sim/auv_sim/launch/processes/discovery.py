"""Fast discovery between the processes of a mission, and the time it takes to see others.

A participant of Fast DDS announces itself 5 times within 0.5 s and then every 3 s. Another one that receives
the first announcement answers at once, and only once. About every second time the answer arrives too early:
the new participant is still being constructed and drops it. The two then match with the next announcement of
the other one, up to 3 s later. So the processes of a mission announce themselves for 6 s (`discovery.xml`),
within which all of them start; and where other participants may exist, looking for them takes longer than 3
s.
"""

from __future__ import annotations

import os
from pathlib import Path

from auv_sim.launch.processes.domains import has_participants

_PROFILES, _RANGE = "FASTRTPS_DEFAULT_PROFILES_FILE", "ROS_AUTOMATIC_DISCOVERY_RANGE"
#: Time for which the graph is observed, s of wall time: where nothing else can be in it, and otherwise.
LOOK_ALONE, LOOK = 0.5, 3.5


def variables() -> dict[str, str]:
    """Return environment variables for a mission's processes; none where the user has a profile file."""
    if _PROFILES in os.environ:
        return {}
    return {_PROFILES: str(Path(__file__).with_suffix(".xml"))}


def look_for(domain: int) -> float:
    """Return how long to look for other participants in a ROS domain, s.

    Args:
        domain: in which this process has no participant yet.
    """
    is_local = os.environ.get(_RANGE) == "LOCALHOST" and not os.environ.get("ROS_STATIC_PEERS")
    return LOOK_ALONE if is_local and not has_participants(domain) else LOOK
