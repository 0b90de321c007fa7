"""The missions that were flown, as `mission_status` reports them. ROS-free."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from auv_msgs_py.contract.mission_word import UNDER_WAY, MissionState, number_in


@dataclass
class FlownMission:
    """One mission.

    Attributes:
        name, digest: of the mission.
        length: of its path, m.
        begun, ended: stamps of its first and of its last odometry, s.
        state, reason: as they were reported last.
        share: of the path that was flown, from 0 to 1.
        wall: steady times of its first and of its last report, s.
    """

    name: str
    digest: str
    length: float
    begun: float
    ended: float
    state: str = ""
    reason: str = ""
    share: float = 0.0
    wall: tuple[float, float] = (0.0, 0.0)

    @property
    def is_under_way(self) -> bool:
        """Whether it runs or holds."""
        return self.state in UNDER_WAY

    @property
    def duration(self) -> float:
        """Mission time, s."""
        return max(self.ended - self.begun, 0.0)

    @property
    def wall_time(self) -> float:
        """Wall time, s."""
        return self.wall[1] - self.wall[0]

    @property
    def line(self) -> str:
        """Name, state, reason, flown share and duration."""
        why = f" ({self.reason})" if self.reason and self.state != MissionState.COMPLETE else ""
        share = f"{100.0 * self.share:.1f} % of {self.length:.1f} m"
        return f"{self.name}: {self.state}{why}, flown {share} in {self.duration:.1f} s"


class FlownMissions:
    """Collects the missions.

    Attributes:
        chosen: the mission that guidance has now, as it was last reported; empty before the first report.
        flown: every mission that began, in order.
    """

    def __init__(self) -> None:
        self.chosen: dict[str, str] = {}
        self.flown: list[FlownMission] = []

    @property
    def last(self) -> FlownMission | None:
        """The mission that began last."""
        return self.flown[-1] if self.flown else None

    def hear(self, values: Mapping[str, str], stamp: float, now: float) -> None:
        """Take a report.

        Args:
            values: of the message `mission_status`; one without usable numbers is left out.
            stamp: of the newest odometry, s.
            now: steady time, s.
        """
        begun, share = number_in(values, "begun at [s]"), number_in(values, "flown share")
        length = number_in(values, "length [m]")
        if math.isnan(length) or not values.get("state"):
            return
        self.chosen = dict(values)
        if math.isnan(begun) or math.isnan(share):  # set, but not begun
            return
        state, last = values["state"], self.last
        if last is None or last.begun != begun or (state in UNDER_WAY and not last.is_under_way):
            if last is not None and last.is_under_way:
                last.state, last.reason = "ended", "another mission took its place"
            last = FlownMission(values.get("mission", ""), values.get("digest", ""), length, begun, stamp)
            last.wall = now, now
            self.flown.append(last)
        elif last.is_under_way:
            last.ended, last.wall = max(last.ended, stamp), (last.wall[0], now)
        last.state, last.reason, last.share = state, values.get("reason", ""), share

    def interrupt(self, reason: str) -> None:
        """Mark the last mission as interrupted."""
        if self.last is not None:
            self.last.state, self.last.reason = "interrupted", reason
