"""Detect a vehicle that sinks while no thrust is requested. No ROS, no clock."""

from __future__ import annotations

import math

from auv_path_following.guidance.failsafe.watchdogs import DiveLimitsConfig, judge_hold
from auv_path_following.missions.mission_state import NO_REASON


class DescentWatch:
    """Compare the depth with that at which the thrust went to 0, while holding and after the mission."""

    def __init__(self) -> None:
        self._held = (math.nan, math.nan)
        self._has_driven = False

    def update(self, config: DiveLimitsConfig, z: float, thrust: float) -> str:
        """Return a line about a vehicle that sinks, else an empty text.

        Args:
            config: `hold_sink` bounds the increase of the depth.
            z: depth, m.
            thrust: requested, N.
        """
        self._has_driven = self._has_driven or thrust > 0.0
        rests = self._has_driven and not thrust > 0.0
        self._held, reason = judge_hold(config, self._held, z, rests)
        if reason == NO_REASON:
            return ""
        return f"the vehicle sinks with thrust 0: more than {config.hold_sink:g} m"
