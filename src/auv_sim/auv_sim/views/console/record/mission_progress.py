"""State, reason and figures of a mission under way, from what guidance reports."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from auv_msgs_py.contract.mission_word import UNDER_WAY, number_in
from auv_sim.views.console.record.history import History
from auv_sim.views.console.record.track_columns import PLACE

#: Speed over the path is the mean of this last time, s of mission time.
_WINDOW = 30.0
#: A slower vehicle makes no way, m/s.
_SLOWEST = 0.02
#: Most rows of the window.
_MOST_ROWS = 600


class MissionProgress:
    """What guidance reported last.

    Attributes:
        state: of `mission_state`; empty before it was heard.
        status: of `mission_status`: key -> value.
        to_go: length of path left, m.
    """

    def __init__(self) -> None:
        self.state = ""
        self.status: dict[str, str] = {}
        self.to_go = math.nan
        self._time: float | None = None

    @property
    def reason(self) -> str:
        """Why the mission is in its state; empty while only the state itself was heard."""
        return self.status.get("reason", "") if self.status.get("state") == self.state else ""

    @property
    def length(self) -> float:
        """Length of the path, m; NaN before it was heard."""
        return number_in(self.status, "length [m]")

    @property
    def mission_time(self) -> float | None:
        """Time since the mission's first odometry, s; it stops with the mission. None before."""
        return self._time

    def at(self, stamp: float) -> float | None:
        """Update and return the mission time; `stamp` of the newest odometry, s."""
        begun = number_in(self.status, "begun at [s]")
        if math.isnan(begun):
            self._time = None
        elif self.state in UNDER_WAY and math.isfinite(stamp):
            self._time = max(stamp - begun, 0.0)
        return self._time

    def figures(self, stamp: float, history: History, course: Mapping[str, Any] | None) -> dict[str, Any]:
        """Return the part of a tick about the mission.

        Args:
            stamp: of the newest odometry, s.
            history: of the vehicle.
            course: with the joints, if they are known.
        """
        share, length = number_in(self.status, "flown share"), self.length
        is_under_way = self.state in UNDER_WAY
        speed = _speed(history) if is_under_way else math.nan
        time_to_go = self.to_go / speed if is_under_way else math.nan
        place = length - self.to_go
        return {
            "state": self.state,
            "reason": self.reason,
            "mission_time": self.at(stamp),
            "length": length,
            "flown": share * length,
            "share": share,
            "time_to_go": time_to_go,
            "next_joint": _next_joint(course, place, speed) if is_under_way else None,
        }


def _speed(history: History) -> float:
    """Return the mean speed over ground of the last `_WINDOW` s, m/s; NaN for a vehicle that makes no way."""
    rows = history.rows[-_MOST_ROWS:]
    if len(rows) < 2:
        return math.nan
    t = rows[:, PLACE["t"]]
    rows = rows[t >= t[-1] - _WINDOW]
    t, x, y, z = (rows[:, PLACE[name]].astype(float) for name in ("t", "x", "y", "z"))
    if len(t) < 2 or t[-1] <= t[0]:
        return math.nan
    way = float(np.sqrt(np.diff(x) ** 2 + np.diff(y) ** 2 + np.diff(z) ** 2).sum())
    speed = way / float(t[-1] - t[0])
    return speed if speed > _SLOWEST else math.nan


def _next_joint(course: Mapping[str, Any] | None, place: float, speed: float) -> dict[str, Any] | None:
    """Return kind, distance (m) and time (s) of the joint ahead of a place along the path, m."""
    if course is None or math.isnan(place):
        return None
    for joint in course.get("joints", ()):
        distance = joint["s"] - place
        if distance > 0.0:
            return {"kind": joint["kind"], "distance": distance, "time": distance / speed}
    return None
