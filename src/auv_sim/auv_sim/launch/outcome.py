"""How a mission ends."""

from __future__ import annotations

import math
from dataclasses import dataclass

from auv_msgs_py.values.errors import SuiteError


class MissionFailed(SuiteError):
    """The mission ended before the end of the path."""


@dataclass(frozen=True)
class Outcome:
    """How the mission ended.

    Attributes:
        state: complete, aborted, interrupted, or idle where none was started;
            `mission_results.conclude` turns complete into incomplete where too little of the path was flown.
        reason: one line; empty when complete.
        wall_time: seconds between start and end of the mission.
        mission_time: the same in the mission's own time.
        since: stamp at which it began, s; the recording may begin earlier.
        other: name of the mission, where it was not the planned one.
    """

    state: str
    reason: str
    wall_time: float
    mission_time: float
    since: float = -math.inf
    other: str = ""
